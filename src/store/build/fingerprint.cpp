#include "store/build/fingerprint.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cerrno>
#include <ctime>

#include "import/scene_scope.h"
#include "roam/error.h"
#include "store/authentic.h"
#include "store/build/layout.h"
#include "store/build/scene_file.h"
#include "store/files.h"
#include "store/manifest.h"
#include "text/printable.h"

namespace roam::store {
namespace {

namespace fs = std::filesystem;
/// Nanoseconds. Two changes of a file within the resolution of the file system's clock (2 s on FAT) have the same time,
/// but different content.
constexpr std::int64_t clock_steps = 3'000'000'000;
/// Bytes for the remembered data of files, some 100,000 of them. A larger record is ignored.
constexpr std::uint64_t sources_memory = 128u << 20;

/// The name of a file of a part, the same wherever the scene lies.
std::string name_in(const ScenePart& part, const fs::path& file) {
  const fs::path inside = file.lexically_relative(part.path);
  const bool outside = inside.empty() || inside == "." || *inside.begin() == "..";
  return outside ? file.filename().string() : inside.string();
}

}  // namespace

std::string text_of(const ImportOptions& options) {
  Json json = {{"up", nullptr}, {"metres_per_unit", metres_per(options.unit)}, {"ignore", options.ignore}};
  if (options.up) json["up"] = to_string(*options.up);
  if (!options.allow.empty()) {
    json["allow"] = Json::array();
    for (const fs::path& folder : options.allow)
      json["allow"].push_back(fs::absolute(folder).lexically_normal().string());
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

namespace {

/// The text as JSON; null if it is none, or too long.
Json options_in(const std::string& text) {
  /// Bytes. A pattern of one character takes four bytes in the text.
  constexpr std::uint64_t most = 64 * longest_options;
  if (text.size() > longest_options) return nullptr;
  try {
    return parse_json(text, "the options", most);
  } catch (const Error&) {
    return nullptr;
  }
}

Json member(const Json& json, const char* name) { return json.is_object() ? json.value(name, Json()) : Json(); }

}  // namespace

ImportOptions stated_in(const std::string& text) {
  const Json json = options_in(text);
  ImportOptions options;
  for (const char* const up : up_axis_names) {
    if (member(json, "up") == Json(up)) options.up = parse_up_axis(up);
  }
  for (const char* const unit : length_unit_names) {
    const LengthUnit length = parse_length_unit(unit);
    if (member(json, "metres_per_unit") == Json(metres_per(length))) options.unit = length;
  }
  for (const Json& pattern : member(json, "ignore")) {
    if (pattern.is_string()) options.ignore.push_back(pattern.get<std::string>());
  }
  return options;
}

// Lenient: the result is compared with the text.
void read_as(const std::string& text, ImportOptions& options) {
  const auto now = Json::parse(text_of(options));
  const Json then = options_in(text);
  const bool known = !then.is_null();
  const ImportOptions stated = stated_in(text);
  ImportOptions read = options;
  read.up = stated.up;
  read.unit = stated.unit;
  read.ignore = stated.ignore;
  // Only the user decides which folders a scene may refer to, never a store.
  if (known && member(then, "allow") != member(now, "allow")) {
    throw Error("the store was built with other folders allowed (--allow): repair it with the same");
  }
  if (!known || text_of(read) != text) {
    throw Error("the store was read in a way that this program does not know (" + printable(text, longest_sentence) +
                "): repair it with the program that built it, or build it again");
  }
  options = std::move(read);
}

Json json_of(const SceneFiles& files) {
  Json json = Json::object();
  for (const auto& [name, file] : files) json[name] = {file.size, file.changed_ns, file.hash};
  return json;
}

SceneFiles scene_files_of(const Json& json) {
  SceneFiles files;
  if (!json.is_object()) return files;
  for (const auto& [name, item] : json.items()) {
    if (!item.is_array() || item.size() != 3 || !item[0].is_number_unsigned() || !item[1].is_number_integer() ||
        !item[2].is_string()) {
      continue;
    }
    files[name] = {item[0].get<std::uint64_t>(), item[1].get<std::int64_t>(), item[2].get<std::string>()};
  }
  return files;
}

Sources::Sources(Folder store, const std::optional<StoreKey>& key, const ImportOptions& import)
    : store_(std::move(store)), key_(key), import_(import) {
  if (!size_of(store_, sources_file)) return;
  if (*size_of(store_, sources_file) > sources_memory / 4) return;
  const std::optional<std::string> text = read_coded(store_, sources_file, sources_memory / 4, key_);
  if (!text) return;
  try {
    known_ = scene_files_of(parse_json(*text, sources_file, sources_memory));
  } catch (const Error&) {  // the files are read again
  }
}

void Sources::know(SceneFiles&& files) {
  for (auto& [name, file] : files) {
    const auto [known, is_new] = known_.try_emplace(name);
    if (!is_new && known->second.changed_ns >= file.changed_ns) continue;
    known->second = std::move(file);
    is_saved_ = false;
  }
}

Sources::Seen Sources::status(const fs::path& real, Number* number) {
  const struct stat status = state_of(open_without_links(real, not_to_read), real);
  if (number != nullptr) *number = {status.st_dev, status.st_ino};
  std::timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  const auto ns = [](const std::timespec& t) { return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec; };
  // Not the time of modification, which any program may set back.
  return {{static_cast<std::uint64_t>(status.st_size), ns(status.st_ctim), {}},
          ns(now) - ns(status.st_ctim) > clock_steps};
}

const reader::SceneScope& Sources::scope(const fs::path& path) {
  const std::lock_guard lock(mutex_);
  const auto known = scopes_.find(path);
  return known != scopes_.end() ? known->second : scopes_.emplace(path, reader::scope_of(path, import_)).first->second;
}

std::optional<SourcePart> Sources::with_references(const ScenePart& part, const std::vector<std::string>& names) {
  SourcePart whole(part);
  for (const std::string& name : names) {
    const std::optional<fs::path> file = reference_file(name, scope(part.path));
    if (!file) return std::nullopt;
    whole.references.emplace(name, *file);
  }
  return whole;
}

void Sources::look(const std::vector<SourcePart>& parts, const std::function<void()>& tick) {
  struct File {
    std::string name;
    const reader::SceneScope* scope;
    bool is_reference;
    ArchiveEntry entry;
    fs::path real;
    Seen seen;
    Number number;
    bool hashed = false;
  };
  std::vector<File> files;
  std::set<std::string> taken;
  for (const SourcePart& part : parts) {
    const reader::SceneScope* const its_scope = &scope(part.path);
    const std::lock_guard lock(mutex_);
    const auto take = [&](const std::string& name, bool is_reference, const ArchiveEntry& entry) {
      if (seen_.contains(name) || !taken.insert(name).second) return;
      files.push_back({name, its_scope, is_reference, entry, {}, {}, {}});
    };
    for (std::size_t i = 0; i < part.files.size(); ++i) {
      take(fs::absolute(part.files[i]).lexically_normal().string(), false,
           part.entries.empty() ? ArchiveEntry() : part.entries.at(i));
    }
    for (const auto& [name, file] : part.references) take(file.string(), true, {});
  }
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    File& file = files[i];
    // The folder may change meanwhile, so no link is followed from here on.
    file.real = file.scope->find(file.entry == ArchiveEntry() ? fs::path(file.name) : file.scope->scene);
    if (file.real.empty() && file.is_reference) {
      file.seen.is_absent = file.hashed = true;
      return;
    }
    if (file.real.empty())
      throw Error::at(file.name, fmt::format("cannot read {}: it is no file of the scene any more", file.name));
    file.seen = status(file.real, &file.number);
    const auto known = known_.find(file.name);
    if (known != known_.end() && known->second.size == file.seen.size &&
        known->second.changed_ns == file.seen.changed_ns) {
      file.seen.hash = known->second.hash;
      file.seen.time_is_conclusive = true;
      file.hashed = true;
    }
    tick();
  });
  // A file may have many names, by links of either kind. It is read once.
  std::map<std::pair<Number, std::uint64_t>, std::size_t> first;  // with the place in an archive
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (files[i].seen.is_absent) continue;
    const auto [same, is_new] = first.emplace(std::pair(files[i].number, files[i].entry.begin), i);
    if (!is_new && files[i].hashed && !files[same->second].hashed) same->second = i;
  }
  std::vector<std::size_t> unread;
  for (const auto& [number, i] : first) {
    if (!files[i].hashed) unread.push_back(i);
  }
  tbb::parallel_for(std::size_t{0}, unread.size(), [&](std::size_t k) {
    File& file = files[unread[k]];
    if (file.is_reference && !open_without_links(file.real, O_RDONLY).is_open() && errno == EACCES) {
      file.seen.hash = "unreadable";  // to the reader, too
      return;
    }
    FileHash hash(file.real, tick);
    if (hash.number() != file.number) fail_changed(file.name);
    file.seen.hash = hash.digits(file.entry);
  });
  const std::lock_guard lock(mutex_);
  for (File& file : files) {
    if (!file.hashed) file.seen.hash = files[first.at({file.number, file.entry.begin})].seen.hash;
    if (!file.seen.is_absent && file.real != file.name) linked_.insert({file.name, file.real});
    seen_.insert({std::move(file.name), file.seen});
  }
}

std::string Sources::fingerprint(const SourcePart& part, const std::string& options) const {
  const std::lock_guard lock(mutex_);
  std::string text = fmt::format("roam part 4\n{}\n{}\n{}\n", options, part.name, part.tile);
  if (part.frame) {
    const Vec3& o = part.frame->origin;
    text += fmt::format("{} {} {} {}\n", part.frame->srs, o.x, o.y, o.z);
  }
  for (std::size_t i = 0; i < part.files.size(); ++i) {
    const fs::path& file = part.files[i];
    const Seen& seen = seen_.at(fs::absolute(file).lexically_normal().string());
    // The hash of an entry is that of its packed bytes.
    const std::string size = part.entries.empty()
                                 ? fmt::format("{}", seen.size)
                                 : fmt::format("{} method {}", part.entries[i].bytes, part.entries[i].method);
    text += fmt::format("{} {} {}\n", seen.hash, size, name_in(part, file));
  }
  for (const auto& [name, file] : part.references) {
    const Seen& seen = seen_.at(file.string());
    text += fmt::format("{} {} reference {}\n", seen.is_absent ? "absent" : seen.hash, seen.size, name);
  }
  return sha256(std::as_bytes(std::span(text)));
}

void Sources::check_unchanged(const std::string& name) const {
  const auto linked = linked_.find(name);
  const Seen before = seen_.at(name), now = status(linked == linked_.end() ? fs::path(name) : linked->second);
  if (before.size != now.size || before.changed_ns != now.changed_ns) fail_changed(name);
}

void Sources::check_unchanged(const SourcePart& part, const LookUps& look_ups) const {
  const std::lock_guard lock(mutex_);
  for (const fs::path& file : part.files) check_unchanged(fs::absolute(file).lexically_normal().string());
  for (const auto& [name, file] : part.references) {
    const Seen& seen = seen_.at(file.string());
    const FileLookUp& then = look_ups.files().at(name);
    if (seen.is_absent == then.found || seen.size != then.bytes || seen.changed_ns != then.changed_ns) {
      fail_changed(file.string());
    }
    if (then.found) check_unchanged(file.string());
  }
}

SceneFiles Sources::files(const SourcePart& part) const {
  const std::lock_guard lock(mutex_);
  SceneFiles settled;
  const auto add = [&](const std::string& name) {
    if (const Seen& seen = seen_.at(name); seen.is_settled()) settled.insert({name, seen});
  };
  for (const fs::path& file : part.files) add(fs::absolute(file).lexically_normal().string());
  for (const auto& [name, file] : part.references) add(file.string());
  return settled;
}

void Sources::save() const {
  SceneFiles settled;
  for (const auto& [name, seen] : seen_) {
    if (seen.is_settled()) settled.insert({name, seen});
  }
  if (is_saved_ && settled == known_) return;
  // The name of a path that is not UTF-8 is not found again; that file is read again.
  const std::string text = json_of(settled).dump(1, ' ', false, Json::error_handler_t::replace);
  write_coded(store_, sources_file, text + "\n", key_);
}

}  // namespace roam::store
