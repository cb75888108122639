#include "store/build/plan.h"

#include <fmt/format.h>

#include "roam/error.h"
#include "store/authentic.h"
#include "store/build/layout.h"
#include "store/files.h"

namespace roam::store {
namespace {

/// The version of the builder. Must increase with every change of the tiles that it makes of the same triangles.
constexpr int builder_version = 1;

Json json_of(const Stretch& s) {
  Json cells = Json::array();
  for (const CurveCell& cell : s.cells) cells.push_back({key_text(cell.key), cell.bits});
  return {{"cells", std::move(cells)}, {"skip", s.skip}, {"triangles", s.triangles}};
}

}  // namespace

std::vector<std::size_t> Plan::to_build() const {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < shards.size(); ++i) {
    if (!shards[i].in_force) numbers.push_back(i);
  }
  return numbers;
}

std::vector<std::size_t> Plan::to_build(std::uint64_t task) const {
  std::vector<std::size_t> numbers = to_build();
  std::erase_if(numbers, [&](std::size_t i) { return shards[i].task != task; });
  return numbers;
}

std::string key_of(const Stretch& stretch, const Plan& plan) {
  Json parts = Json::array();
  for (const std::uint32_t p : stretch.parts) {
    const PartInfo& info = plan.parts[p].info;
    parts.push_back({info.name, info.fingerprint, info.file});
  }
  const std::string text = Json{{"format", format_version}, {"builder", builder_version},  {"lossless", plan.lossless},
                                {"options", plan.options},  {"stretch", json_of(stretch)}, {"parts", std::move(parts)}}
                               .dump();
  return sha256(std::as_bytes(std::span(text)));
}

void write_plan(const Work& work, const Plan& plan) {
  Json parts = Json::array(), shards = Json::array();
  for (const PartRecord& record : plan.parts) {
    Json json = json_of(record);
    json["has_runs"] = record.has_runs;
    parts.push_back(std::move(json));
  }
  for (const PlannedShard& shard : plan.shards) {
    Json json = json_of(shard.stretch);
    json["parts"] = shard.stretch.parts;
    json["key"] = shard.key;
    json["there"] = shard.in_force;
    json["task"] = shard.task;
    shards.push_back(std::move(json));
  }
  const Json json = {{"scratch_version", scratch_version}, {"options", plan.options},
                     {"lossless", plan.lossless},          {"tasks", plan.tasks},
                     {"parts", std::move(parts)},          {"shards", std::move(shards)}};
  write_coded(work.store, plan_file, json.dump(1) + "\n", work.options.key);
}

Plan read_plan(const Work& work) {
  const Folder& store = work.store;
  const std::uint64_t memory = work.options.memory;
  const std::optional<std::uint64_t> bytes = size_of(store, plan_file);
  if (!bytes) {
    throw NothingPlanned(store.string(), "there is no plan: nothing is being built there; begin with --plan");
  }
  if (*bytes > memory / 4) throw TooLarge((store / plan_file).string(), memory / 4);
  const std::optional<std::string> text = read_coded(store, plan_file, memory / 4, work.options.key);
  if (!text) {
    throw Error::at(
        store.string(),
        fmt::format("the plan in {} was not made with your key: all who build the store need the same key file; "
                    "copy it, or plan again",
                    store.string()));
  }
  try {
    const Json json = parse_json(*text, (store / plan_file).string(), memory / 2);
    if (json.at("scratch_version").get<int>() != scratch_version) throw std::runtime_error("of another version");
    Plan plan;
    plan.options = json.at("options").get<std::string>();
    plan.lossless = json.at("lossless").get<bool>();
    plan.tasks = json.at("tasks").get<std::uint64_t>();
    for (const Json& part : json.at("parts")) {
      PartRecord& record = plan.parts.emplace_back(record_of(part));
      record.has_runs = part.at("has_runs").get<bool>();
    }
    for (const Json& item : json.at("shards")) {
      PlannedShard shard;
      for (const Json& cell : item.at("cells")) {
        shard.stretch.cells.push_back({parse_key(cell.at(0).get<std::string>()), cell.at(1).get<int>()});
      }
      shard.stretch.skip = item.at("skip").get<std::uint64_t>();
      shard.stretch.triangles = item.at("triangles").get<std::uint64_t>();
      shard.stretch.parts = item.at("parts").get<std::vector<std::uint32_t>>();
      shard.key = item.at("key").get<std::string>();
      shard.in_force = item.at("there").get<bool>();
      shard.task = item.at("task").get<std::uint64_t>();
      if (shard.stretch.triangles > ShardLimits{}.shard) throw std::runtime_error("a shard is too large");
      for (const std::uint32_t p : shard.stretch.parts) {
        if (p >= plan.parts.size()) throw std::runtime_error("a part is out of range");
      }
      if (shard.key != key_of(shard.stretch, plan)) throw std::runtime_error("a key is not what it should be");
      if (!shard.in_force && shard.task >= plan.tasks) throw std::runtime_error("a task is out of range");
      plan.shards.push_back(std::move(shard));
    }
    if (plan.tasks > plan.shards.size()) throw std::runtime_error("it has more tasks than shards");
    return plan;
  } catch (const TooLarge&) {
    throw;
  } catch (const std::exception& e) {
    throw Error::at((store / plan_file).string(),
                    fmt::format("{} cannot be used ({}); plan again", (store / plan_file).string(), e.what()));
  }
}

std::optional<Manifest> manifest_in_force(const Work& work) {
  if (!is_file(work.store, current_file)) return {};
  return read_manifest(*files_of(work.store), work.store.string(), nullptr, nullptr, work.options.memory);
}

std::vector<std::vector<std::string>> notes_by_part(const Manifest& manifest) {
  std::vector<std::vector<std::string>> notes(manifest.parts.size());
  std::size_t part = 0;
  for (const std::string& note : manifest.notes) {  // in the order of the parts
    while (part < notes.size() && !note.starts_with(manifest.parts[part].name + ": ")) ++part;
    if (part == notes.size()) break;
    notes[part].push_back(note);
  }
  return notes;
}

std::optional<ShardInfo> built_shard(const Work& work, const std::string& key) {
  const Folder& store = work.store;
  const std::string file = shard_file(key);
  const std::optional<std::string> text = read_coded(store, file, Store::usual_memory, work.options.key);
  if (!text) return {};
  ShardInfo shard = parse_shard(*text, (store / file).string());
  if (shard.key != key || size_of(store, pack_file(shard.pack)) != shard.bytes) return {};
  return shard;
}

}  // namespace roam::store
