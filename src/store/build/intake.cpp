#include "store/build/intake.h"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <mutex>
#include <utility>

#include "import/report_notes.h"
#include "store/authentic.h"
#include "store/build/histogram.h"
#include "store/build/layout.h"
#include "store/build/run.h"
#include "store/files.h"

namespace roam::store {
namespace {

namespace fs = std::filesystem;
/// Bytes for what is made of the text of a record, which has a quarter of them at most. A larger record is ignored.
constexpr std::uint64_t record_memory = 64u << 20;
/// Bytes of a text of which the record fits into the memory that Work counts for each thread, together with it. Larger
/// ones are read one by one.
constexpr std::uint64_t small_record = 1u << 20;
/// Files in a record at most. Those of a part with more are hashed again by whoever takes the record.
constexpr std::size_t most_files = 20'000;
/// Names are kept in a list that grows by doubling, and then in the bytes of the part file.
constexpr std::uint64_t share_for_names = 4;

/// Collects the pieces of a part and writes runs. Sorts one run while the next one fills, if memory allows.
class Intake {
 public:
  /// As one of `readers` that run at once.
  Intake(Work& work, const ScenePart& part, std::string id, int readers)
      : work_(work),
        name_(part.name),
        id_(std::move(id)),
        sorts_beside_(work.sorts_beside_reading(readers)),
        name_bytes_left_(work.reader_memory(readers) / share_for_names) {
    filling_.triangles.reserve(run_triangles);
  }

  void add(const Mesh& piece, bool continues) {
    if (!continues || part_.objects.empty()) add_object(piece.name);
    if (filling_.triangles.size() + piece.triangles.size() > run_triangles) hand_over();
    const auto first = static_cast<std::uint32_t>(filling_.vertices.size());
    filling_.vertices.insert(filling_.vertices.end(), piece.vertices.begin(), piece.vertices.end());
    for (const auto& t : piece.triangles) {
      filling_.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    part_.triangles += piece.triangles.size();
    const std::array<std::uint64_t, 3> hashes{content_, xxh3(std::as_bytes(std::span(piece.vertices))),
                                              xxh3(std::as_bytes(std::span(piece.triangles)))};
    content_ = xxh3(std::as_bytes(std::span(hashes)));
    work_.add_triangles(piece.triangles.size());
    work_.tick();
  }

  PartFile finish() {
    hand_over();
    wait();
    histogram_.finish(part_);
    return std::move(part_);
  }
  [[nodiscard]] const std::vector<PartRecord::Run>& runs() const { return runs_; }
  [[nodiscard]] std::uint64_t content() const { return content_; }

  ~Intake() {
    if (sorting_.valid()) sorting_.wait();
  }
  Intake(const Intake&) = delete;
  Intake& operator=(const Intake&) = delete;

 private:
  void add_object(const std::string& name) {
    const std::uint64_t bytes = sizeof(PartFile::Object) + name.size();
    if (bytes > name_bytes_left_) {
      throw Error(name_,
                  fmt::format("the names of its {} objects take too much memory; allow more, or leave objects out",
                              part_.objects.size()));
    }
    name_bytes_left_ -= bytes;
    part_.objects.push_back({part_.triangles, name});
  }

  void hand_over() {
    if (filling_.triangles.empty()) return;
    wait();
    std::swap(filling_, full_);
    filling_.vertices.clear();
    filling_.triangles.clear();
    filling_.first = part_.triangles;
    if (sorts_beside_) {
      sorting_ = std::async(std::launch::async, [this] { sort(); });
    } else {
      sort();
      full_ = {};
    }
  }

  void sort() {
    work_.arena.execute([&] {
      const std::vector<RunItem> items = sort_run(full_);
      const std::uint64_t hash = write_run(work_.store, run_file(id_, runs_.size()), full_, items);
      runs_.push_back({items.front().key, items.back().key, hash});
      histogram_.add(items);
    });
  }

  void wait() {
    if (sorting_.valid()) sorting_.get();
  }

  Work& work_;
  std::string name_;  ///< of the part
  std::string id_;
  bool sorts_beside_;
  std::uint64_t name_bytes_left_;
  PartFile part_;
  std::uint64_t content_ = 0;
  RunContent filling_;
  // Used by the sorting thread:
  RunContent full_;
  std::vector<PartRecord::Run> runs_;
  Histogram histogram_;
  std::future<void> sorting_;
};

/// A note of the import that begins with the name of the part and is independent of the scene's folder.
std::string note_of(const ScenePart& part, std::string note) {
  const fs::path whole = fs::absolute(part.path).lexically_normal();
  const fs::path folder = whole.has_filename() ? whole.parent_path() : whole.parent_path().parent_path();
  for (const std::string& start : {part.path.string() + ": ", whole.string() + ": "}) {
    if (note.starts_with(start)) note.erase(0, start.size());
  }
  const std::string place = (folder / "").string();
  for (std::size_t at = 0; (at = note.find(place, at)) != std::string::npos;) note.erase(at, place.size());
  return part.name + ": " + note;
}

/// The text as valid UTF-8, as far as possible, for JSON.
std::string valid(const std::string& text) {
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

/// Reads a record file. Returns nothing if it is damaged, too large, or has another key or version.
std::optional<RecordOfFiles> published_record(Work& work, const std::string& file) {
  const std::uint64_t size = size_of(work.store, file).value_or(0);
  if (size > record_memory / 4) return {};
  std::unique_lock<std::mutex> alone(work.large_records, std::defer_lock);
  if (size > small_record) alone.lock();
  const std::optional<std::string> text = read_coded(work.store, file, record_memory, work.options.key);
  if (!text) return {};
  try {
    const Json json = parse_json(*text, file, record_memory);
    if (json.at("scratch_version").get<int>() != scratch_version) return {};
    return RecordOfFiles{record_of(json), scene_files_of(json.at("files"))};
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace

std::string key_text(CurveKey key) {
  return fmt::format("{:016x}{:016x}", static_cast<std::uint64_t>(key >> 64), static_cast<std::uint64_t>(key));
}

CurveKey parse_key(const std::string& text) {
  if (text.size() != 32) throw std::invalid_argument(text);
  return CurveKey{std::stoull(text.substr(0, 16), nullptr, 16)} << 64 | std::stoull(text.substr(16), nullptr, 16);
}

Json json_of(const PartRecord& record) {
  Json runs = Json::array();
  for (const auto& run : record.runs) runs.push_back({key_text(run.first), key_text(run.last), run.hash});
  return {{"id", record.id},
          {"name", record.info.name},
          {"fingerprint", record.info.fingerprint},
          {"file", record.info.file},
          {"bytes", record.info.bytes},
          {"triangles", record.info.triangles},
          {"objects", record.info.objects},
          {"references", record.info.references},
          {"runs", std::move(runs)},
          {"notes", record.notes}};
}

PartRecord record_of(const Json& json) {
  PartRecord record;
  record.id = json.at("id").get<std::string>();
  record.info.name = json.at("name").get<std::string>();
  record.info.fingerprint = json.at("fingerprint").get<std::string>();
  record.info.file = json.at("file").get<std::string>();
  if (!is_digits(record.info.file, 64) || !is_digits(record.id, record_digits))
    throw std::runtime_error("the name of a file is not what it should be");
  record.info.bytes = json.at("bytes").get<std::uint64_t>();
  record.info.triangles = json.at("triangles").get<std::uint64_t>();
  record.info.objects = json.at("objects").get<std::uint64_t>();
  record.info.references = json.at("references").get<std::vector<std::string>>();
  for (const Json& run : json.at("runs")) {
    record.runs.push_back({parse_key(run.at(0).get<std::string>()), parse_key(run.at(1).get<std::string>()),
                           run.at(2).get<std::uint64_t>()});
  }
  record.notes = json.at("notes").get<std::vector<std::string>>();
  return record;
}

std::string record_id(const std::string& name, const std::string& fingerprint) {
  const std::string text = name + "\n" + fingerprint;
  return sha256(std::as_bytes(std::span(text))).substr(0, record_digits);
}

void publish_record(const Work& work, const PartRecord& record, const SceneFiles& files) {
  Json json = json_of(record);
  json["scratch_version"] = scratch_version;
  json["files"] = files.size() <= most_files ? json_of(files) : Json::object();
  write_coded(work.store, record_file(record_id(record.info.name, "")),
              json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n", work.options.key);
}

std::optional<RecordOfFiles> find_record(Work& work, const std::string& name) {
  const Folder& store = work.store;
  std::optional<RecordOfFiles> found = published_record(work, record_file(record_id(name, "")));
  if (!found || found->record.info.name != name) return {};
  PartRecord& record = found->record;
  for (std::size_t i = 0; i < record.runs.size(); ++i) {
    if (!is_run(store, run_file(record.id, i), record.runs[i].hash)) return {};
  }
  const std::string part = part_file(record.info.file);
  if (size_of(store, part) != record.info.bytes || sha256_of_file(store, part) != record.info.file) return {};
  record.has_runs = true;
  return found;
}

PartRecord read_part(Work& work, const ScenePart& part, const std::string& id, int readers, LookUps& look_ups,
                     reader::SceneBudget& budget) {
  PartRecord record;
  record.info.name = part.name;
  record.id = id;
  Intake intake(work, part, record.id, readers);
  ImportOptions options = work.options.import;
  options.memory_limit = work.reader_memory(readers);
  std::uint64_t told = 0;  // bytes
  options.progress = [&](const ImportProgress& p) {
    const std::uint64_t bytes = std::clamp(p.bytes_read, told, std::max(told, part.bytes));
    work.add_bytes(bytes - std::exchange(told, bytes));
    try {
      work.tick();
    } catch (const Cancelled&) {
      return false;
    }
    return true;
  };
  const ImportReport report = stream_part(
      part, options, [&](const Mesh& piece, bool continues) { intake.add(piece, continues); },
      [&](const FileLookUp& file) { look_ups.add(file); }, &budget);
  const PartFile file = intake.finish();
  record.runs = intake.runs();
  record.has_runs = true;
  record.content = intake.content();
  record.confinement = reader::note_of_confinement(report);
  for (const std::string& note : report.notes) {
    if (note != record.confinement) record.notes.push_back(valid(note_of(part, note)));
  }
  const std::vector<std::byte> bytes = encode_part(file);
  NewFile out(work.store, part_file("new"));
  out.write(bytes);
  record.info.file = out.commit_by_hash();
  record.info.bytes = bytes.size();
  record.info.triangles = file.triangles;
  record.info.objects = file.objects.size();
  work.add_bytes(std::max(told, part.bytes) - told);
  work.tick();
  return record;
}

}  // namespace roam::store
