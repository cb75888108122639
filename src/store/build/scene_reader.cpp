#include "store/build/scene_reader.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>

#include "roam/error.h"
#include "store/build/layout.h"
#include "store/build/plan.h"
#include "store/build/tasks.h"
#include "store/files.h"

namespace roam::store {
namespace {

/// A part of no bytes takes as long to read as one of so many more bytes: each has a reader process of its own.
constexpr std::uint64_t bytes_per_part = 1u << 19;

bool is_cancelled(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const Cancelled&) {
    return true;
  } catch (...) {
    return false;
  }
}

/// Gives a part whose references cannot be recorded a fingerprint that no list of files has: it is always read again.
void forget_references(PartRecord& record) {
  const std::string text = "roam part of unknown files\n" + record.info.fingerprint;
  record.info.fingerprint = sha256(std::as_bytes(std::span(text)));
  record.info.references.clear();
}

}  // namespace

std::vector<ScenePart> listed_parts(Work& work) {
  work.begin(Work::Step::read, 0, 0);
  ImportOptions listing = work.options.import;
  listing.memory_limit = work.options.memory;
  return scene_parts(work.options.scene, listing);
}

SceneReader::SceneReader(Work& work, std::vector<ScenePart> parts, const std::set<std::string>& damaged,
                         StoreBuildReport& report, std::vector<PartRecord>& records)
    : work_(work),
      parts_(std::move(parts)),
      damaged_(damaged),
      report_(report),
      records_(records),
      options_(text_of(work.options.import)),
      sources_(work.store, work.options.key, work.options.import) {
  if (options_.size() > longest_options) {
    throw Error(fmt::format("the patterns to ignore and the allowed folders are longer than {} kB together; name fewer",
                            longest_options >> 10));
  }
  records_.resize(parts_.size());
  report_.parts = parts_.size();
}

std::vector<std::size_t> SceneReader::all() const {
  std::vector<std::size_t> numbers(parts_.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

std::vector<std::size_t> SceneReader::share(std::uint64_t i, std::uint64_t shares) const {
  std::vector<std::uint64_t> loads;
  for (const ScenePart& part : parts_) loads.push_back(part.bytes + bytes_per_part);
  const std::vector<std::uint64_t> share_of = share_out(loads, shares);
  std::vector<std::size_t> numbers = all();
  std::erase_if(numbers, [&](std::size_t part) { return share_of[part] != i; });
  return numbers;
}

std::vector<std::size_t> SceneReader::without_runs(std::vector<std::size_t> numbers) const {
  std::erase_if(numbers, [&](std::size_t part) { return records_[part].has_runs; });
  return numbers;
}

/// The earlier states of these parts, by part.
std::vector<SceneReader::Earlier> SceneReader::earlier_parts(const std::optional<Manifest>& in_force,
                                                             const std::vector<std::size_t>& numbers) {
  std::map<std::string, std::size_t> before;
  std::vector<std::vector<std::string>> notes;
  std::uint64_t references = 0;
  if (in_force) {
    for (std::size_t i = 0; i < in_force->parts.size(); ++i) before[in_force->parts[i].name] = i;
    for (const PartInfo& part : in_force->parts) references += references_cost(part.references);
    notes = notes_by_part(*in_force);
  }
  std::vector<std::optional<PartRecord>> found(numbers.size());
  std::mutex known;
  work_.arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, numbers.size(), [&](std::size_t n) {
      if (std::optional<RecordOfFiles> record = find_record(work_, parts_[numbers[n]].name)) {
        found[n] = std::move(record->record);
        const std::lock_guard lock(known);
        sources_.know(std::move(record->files));  // most files are those of many parts
      }
      work_.tick();
    });
  });
  std::vector<Earlier> earlier;
  const auto add = [&](std::size_t i, PartRecord&& record) {
    if (std::optional<SourcePart> sources = sources_.with_references(parts_[i], record.info.references)) {
      earlier.push_back({i, std::move(record), std::move(*sources)});
    }
  };
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const std::size_t i = numbers[n];
    if (found[n]) add(i, std::move(*found[n]));
    const auto old = before.find(parts_[i].name);
    if (old == before.end() || references > most_reference_bytes) continue;
    add(i, {in_force->parts[old->second], "", {}, false, notes[old->second]});
  }
  return earlier;
}

void SceneReader::take_records(const std::optional<Manifest>& in_force, const std::vector<std::size_t>& numbers) {
  std::vector<Earlier> earlier = earlier_parts(in_force, numbers);
  std::vector<SourcePart> sources;
  for (const std::size_t i : numbers) sources.emplace_back(parts_[i]);
  for (const Earlier& part : earlier) sources.push_back(part.sources);
  look(sources);
  auto next = earlier.begin();
  for (const std::size_t i : numbers) {
    // An interrupted reading and its repetition have the same id, so that the latter replaces the runs.
    const SourcePart known = next != earlier.end() && next->part == i ? next->sources : SourcePart(parts_[i]);
    PartRecord& record = records_[i];
    record.info.name = parts_[i].name;
    record.id = record_id(parts_[i].name, sources_.fingerprint(known, options_));
    bool found = false;
    for (; next != earlier.end() && next->part == i; ++next) {
      const PartInfo& info = next->record.info;
      if (found || info.fingerprint != sources_.fingerprint(next->sources, options_) || !is_there(info)) continue;
      found = true;
      if (next->record.id.empty()) next->record.id = record_id(info.name, info.fingerprint);
      record = std::move(next->record);
    }
    if (!found) unknown_.push_back(i);
  }
}

void SceneReader::look(const std::vector<SourcePart>& parts) {
  work_.arena.execute([&] { sources_.look(parts, [&] { work_.tick(); }); });
}

bool SceneReader::is_there(const PartInfo& info) const {
  return !damaged_.contains(info.file) && size_of(work_.store, part_file(info.file)) == info.bytes;
}

bool SceneReader::read(const std::vector<std::size_t>& numbers) {
  if (numbers.empty()) return false;
  std::uint64_t bytes = 0;
  for (const std::size_t i : numbers) bytes += parts_[i].bytes;
  work_.begin(Work::Step::read, bytes, 0);
  const Timer timer(report_.read_seconds);
  const int readers = work_.readers(numbers.size());
  std::vector<std::exception_ptr> failures(numbers.size());
  std::atomic<std::size_t> next{0};
  std::atomic<bool> ends{false};
  const auto read_some = [&] {
    for (std::size_t n; !ends && (n = next++) < numbers.size();) {
      try {
        read_one(numbers[n], readers);
      } catch (...) {
        failures[n] = std::current_exception();
        ends = readers == 1 || is_cancelled(failures[n]);
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    try {
      for (int t = 1; t < readers; ++t) threads.emplace_back(read_some);
    } catch (const std::exception&) {
      // Fewer threads read.
    }
    read_some();
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure && (readers == 1 || is_cancelled(failure))) std::rethrow_exception(failure);
  }
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    if (failures[n]) read_one(numbers[n], 1);  // again, with all of the memory
  }
  report_.parts_read += numbers.size();
  for (const std::size_t i : numbers) {
    const std::optional<std::string>& note = records_[i].confinement;
    if (note && std::count(report_.notes.begin(), report_.notes.end(), *note) == 0) report_.notes.push_back(*note);
  }
  return true;
}

void SceneReader::read_one(std::size_t i, int readers) {
  // A sixteenth of the memory for the names of files.
  LookUps look_ups(parts_[i], sources_.scope(parts_[i].path),
                   work_.options.memory / (16 * static_cast<std::uint64_t>(readers)));
  PartRecord record = read_part(work_, parts_[i], records_[i].id, readers, look_ups, budget_);
  SourcePart sources(parts_[i]);
  for (const auto& [name, file] : look_ups.files()) {
    record.info.references.push_back(name);
    sources.references.emplace(name, file.file);
  }
  look({sources});
  sources_.check_unchanged(sources, look_ups);
  record.info.fingerprint = sources_.fingerprint(sources, options_);
  if (!look_ups.are_all()) {
    record.info.fingerprint += fmt::format(" {:016x}", record.content);
    forget_references(record);
  }
  publish_record(work_, record, sources_.files(sources));
  records_[i] = std::move(record);
}

void SceneReader::limit_references() {
  std::uint64_t bytes = 0;
  for (PartRecord& part : records_) {
    const std::uint64_t cost = references_cost(part.info.references);
    if (cost > most_reference_bytes - bytes) {
      forget_references(part);
    } else {
      bytes += cost;
    }
  }
}

}  // namespace roam::store
