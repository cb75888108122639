#include "store/manifest.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <nlohmann/json.hpp>

#include "store/files.h"
#include "store/page.h"

namespace roam::store {
namespace {

using Json = nlohmann::ordered_json;

/// Bytes. More than any manifest: that of a scene of 1 TB has 10 MB.
constexpr std::uint64_t kManifestLimit = 1u << 30;
constexpr std::uint64_t kCurrentLimit = 4096;
constexpr std::string_view kCurrentStart = "roam store ";
constexpr const char* kManifestName = "the manifest";
constexpr const char* kNoCurrent = "it is none of a store";

Json numbers(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }
Json numbers(const Box& box) { return Json::array({numbers(box.lower), numbers(box.upper)}); }
std::string digits(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw Error(fmt::format("{} is damaged: {}; verify the store, and repair it from its scene", name, what));
}

/// Reads the members of objects, and says which one is wrong.
class Fields {
 public:
  Fields(const Json& json, const std::string& name, std::string what)
      : json_(json), name_(name), what_(std::move(what)) {
    if (!json.is_object()) refuse(name, what_ + " is no object");
  }

  template <class T>
  [[nodiscard]] T get(const char* key) const {
    try {
      const Json& value = json_.at(key);
      if constexpr (std::is_unsigned_v<T> && !std::is_same_v<T, bool>) {
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<T>::max()) bad(key);
      }
      return value.get<T>();
    } catch (const Json::exception&) {
      bad(key);
    }
  }
  [[nodiscard]] double number(const char* key) const {
    const auto value = get<double>(key);
    if (!std::isfinite(value)) bad(key);
    return value;
  }
  [[nodiscard]] Box box(const char* key) const {
    try {
      const Json& value = json_.at(key);
      Box box;
      for (int k = 0; k < 3; ++k) {
        box.lower[k] = value.at(0).at(static_cast<std::size_t>(k)).get<double>();
        box.upper[k] = value.at(1).at(static_cast<std::size_t>(k)).get<double>();
        if (!std::isfinite(box.lower[k]) || !std::isfinite(box.upper[k])) bad(key);
      }
      if (box.empty()) bad(key);
      return box;
    } catch (const Json::exception&) {
      bad(key);
    }
  }
  [[nodiscard]] std::string hash(const char* key) const {
    auto text = get<std::string>(key);
    if (!is_digits(text, 64)) bad(key);
    return text;
  }
  [[nodiscard]] std::uint64_t short_hash(const char* key) const {
    const auto text = get<std::string>(key);
    if (!is_digits(text, 16)) bad(key);
    return std::stoull(text, nullptr, 16);
  }
  [[nodiscard]] const Json& list(const char* key) const {
    const auto it = json_.find(key);
    if (it == json_.end() || !it->is_array()) bad(key);
    return *it;
  }
  [[noreturn]] void bad(const char* key) const {
    refuse(name_, fmt::format("'{}' of {} is missing or not what it should be", key, what_));
  }

 private:
  const Json& json_;
  const std::string& name_;
  std::string what_;
};

Json json_of(const ShardInfo& shard) {
  Json pages = Json::array();
  for (const PageRef& page : shard.pages) {
    pages.push_back({{"box", numbers(page.box)},
                     {"offset", page.offset},
                     {"bytes", page.bytes},
                     {"xxh3", digits(page.hash)},
                     {"tiles", page.tiles}});
  }
  return {{"key", shard.key},
          {"pack", shard.pack},
          {"bytes", shard.bytes},
          {"triangles", shard.triangles},
          {"tiles", shard.tiles},
          {"geometry_bytes", shard.geometry_bytes},
          {"number_bytes", shard.number_bytes},
          {"resident_bytes", shard.resident_bytes},
          {"bounds", numbers(shard.bounds)},
          {"largest_error_m", shard.largest_error},
          {"geometry_hash", digits(shard.geometry_hash)},
          {"pages", std::move(pages)}};
}

ShardInfo shard_of(const Json& json, const std::string& name) {
  const Fields fields(json, name, "a shard");
  ShardInfo shard;
  shard.key = fields.hash("key");
  shard.pack = fields.hash("pack");
  shard.bytes = fields.get<std::uint64_t>("bytes");
  shard.triangles = fields.get<std::uint64_t>("triangles");
  shard.tiles = fields.get<std::uint64_t>("tiles");
  shard.geometry_bytes = fields.get<std::uint64_t>("geometry_bytes");
  shard.number_bytes = fields.get<std::uint64_t>("number_bytes");
  shard.resident_bytes = fields.get<std::uint64_t>("resident_bytes");
  shard.bounds = fields.box("bounds");
  shard.largest_error = fields.number("largest_error_m");
  shard.geometry_hash = fields.short_hash("geometry_hash");
  std::uint64_t tiles = 0;
  for (const Json& item : fields.list("pages")) {
    const Fields page_fields(item, name, "a page");
    PageRef page;
    page.box = page_fields.box("box");
    page.offset = page_fields.get<std::uint64_t>("offset");
    page.bytes = page_fields.get<std::uint32_t>("bytes");
    page.hash = page_fields.short_hash("xxh3");
    page.tiles = page_fields.get<std::uint32_t>("tiles");
    if (page.tiles < 1 || page.tiles > page_tiles) page_fields.bad("tiles");
    if (page.offset > shard.bytes || page.bytes > shard.bytes - page.offset) page_fields.bad("offset");
    tiles += page.tiles;
    shard.pages.push_back(page);
  }
  if (tiles != shard.tiles || shard.pages.empty()) fields.bad("pages");
  return shard;
}

Json parse(const std::string& text, const std::string& name) {
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) refuse(name, "it is no JSON");
  return json;
}

void check_version(std::uint32_t version, const std::string& name) {
  if (version > format_version) {
    throw NewerFormat(
        fmt::format("{} is written in version {} of the format, and this roam reads versions up to {}: use a "
                    "newer roam",
                    name, version, format_version));
  }
}

std::string text_of(const std::vector<std::byte>& content) {
  return {reinterpret_cast<const char*>(content.data()), content.size()};
}

/// The hash in the text of CURRENT: "roam store 1\n", 64 digits, "\n".
std::string named_by(const std::string& current, const std::string& store) {
  const auto end = current.find('\n');
  std::uint32_t version = 0;
  if (!current.starts_with(kCurrentStart) || end == std::string::npos || end > kCurrentStart.size() + 9) {
    throw RootDamage(store, current_file, kNoCurrent);
  }
  for (std::size_t i = kCurrentStart.size(); i < end; ++i) {
    if (current[i] < '0' || current[i] > '9') throw RootDamage(store, current_file, kNoCurrent);
    version = 10 * version + static_cast<std::uint32_t>(current[i] - '0');
  }
  check_version(version, store);
  std::string named = current.substr(end + 1, 64);
  if (version < 1 || current[kCurrentStart.size()] == '0' || !is_digits(named, 64) ||
      current.substr(end + 65) != "\n") {
    throw RootDamage(store, current_file, kNoCurrent);
  }
  return named;
}

}  // namespace

std::string to_text(const ShardInfo& shard) { return json_of(shard).dump(1) + "\n"; }

std::string to_text(const Manifest& manifest) {
  Json parts = Json::array(), shards = Json::array();
  for (const PartInfo& part : manifest.parts) {
    parts.push_back({{"name", part.name},
                     {"fingerprint", part.fingerprint},
                     {"file", part.file},
                     {"bytes", part.bytes},
                     {"triangles", part.triangles},
                     {"objects", part.objects}});
  }
  for (const ShardInfo& shard : manifest.shards) shards.push_back(json_of(shard));
  const Json json = {{"format", manifest.format},
                     {"lossless", manifest.lossless},
                     {"options", manifest.options},
                     {"bounds", numbers(manifest.bounds)},
                     {"geometry_hash", digits(manifest.geometry_hash)},
                     {"parts", std::move(parts)},
                     {"shards", std::move(shards)},
                     {"notes", manifest.notes}};
  return json.dump(1) + "\n";
}

ShardInfo parse_shard(const std::string& text, const std::string& name) { return shard_of(parse(text, name), name); }

Manifest parse_manifest(const std::string& text, const std::string& name) {
  const Json json = parse(text, name);
  const Fields fields(json, name, "the manifest");
  Manifest manifest;
  manifest.format = fields.get<std::uint32_t>("format");
  check_version(manifest.format, name);
  manifest.lossless = fields.get<bool>("lossless");
  manifest.options = fields.get<std::string>("options");
  manifest.bounds = fields.box("bounds");
  manifest.geometry_hash = fields.short_hash("geometry_hash");
  std::uint64_t triangles = 0;
  for (const Json& item : fields.list("parts")) {
    const Fields part_fields(item, name, "a part");
    PartInfo part;
    part.name = part_fields.get<std::string>("name");
    part.fingerprint = part_fields.get<std::string>("fingerprint");
    part.file = part_fields.hash("file");
    part.bytes = part_fields.get<std::uint64_t>("bytes");
    part.triangles = part_fields.get<std::uint64_t>("triangles");
    part.objects = part_fields.get<std::uint64_t>("objects");
    triangles += part.triangles;
    manifest.parts.push_back(std::move(part));
  }
  for (const Json& item : fields.list("shards")) {
    manifest.shards.push_back(shard_of(item, name));
    triangles -= manifest.shards.back().triangles;
  }
  if (manifest.shards.empty()) fields.bad("shards");
  if (triangles != 0) refuse(name, "the shards hold more or fewer triangles than the parts of the scene");
  try {
    manifest.notes = json.at("notes").get<std::vector<std::string>>();
  } catch (const Json::exception&) {
    fields.bad("notes");
  }
  return manifest;
}

RootDamage::RootDamage(const std::string& store, std::string damaged, std::string reason)
    : Error(fmt::format("{0} is damaged: {1}: {2}; `roam build` with its scene and `-o {0}` mends it", store, damaged,
                        reason)),
      what_is_damaged(std::move(damaged)),
      why(std::move(reason)) {}

bool holds_store(const std::filesystem::path& folder) {
  std::error_code none;
  return std::filesystem::is_directory(folder / "packs", none) ||
         std::filesystem::is_directory(folder / "manifests", none);
}

void refuse_to_open(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const std::string name = folder.string();
  std::error_code none;
  if (!fs::exists(folder, none)) {
    throw Error(fmt::format("{} is not there{}; make a store with roam build", name,
                            fs::is_symlink(folder, none) ? ": it is a link that leads nowhere" : ""));
  }
  if (!holds_store(folder)) throw Error(fmt::format("{} is no store; make one with roam build", name));
  const fs::path current = folder / current_file;
  if (fs::is_symlink(current, none)) throw RootDamage(name, current_file, "it is a symbolic link, which no store has");
  if (fs::exists(current, none)) throw RootDamage(name, current_file, "it is no file");
  const bool has_manifest = !fs::is_empty(folder / "manifests", none) && !none;
  // A build that is killed just before it writes CURRENT has written its manifest, and has its plan still.
  if (fs::exists(folder / "scratch/plan.json", none) || (!has_manifest && fs::is_directory(folder / "scratch", none))) {
    throw NotComplete(fmt::format(
        "{} is a store that is not complete: `roam build` with its scene, and -o, goes on where it stopped", name));
  }
  throw RootDamage(name, current_file, "it is not there");
}

Manifest read_manifest(StoreBytes& bytes, const std::string& store, std::string* hash, std::uint64_t* text_bytes) {
  const auto whole = [&](const std::string& file, std::uint64_t limit, const char* what) {
    try {
      return bytes.whole(file, limit);
    } catch (const FileError& error) {
      // What may not be read, or only not now, is not damaged.
      if (error.number == ENOENT) throw RootDamage(store, what, file + " is not there");
      if (error.number == EFBIG) throw RootDamage(store, what, file + " is larger than any of its kind");
      if (is_foreign(error.number)) throw RootDamage(store, what, error.what());
      throw;
    }
  };
  std::string current = text_of(whole(current_file, kCurrentLimit, current_file));
  for (;;) {
    const std::string named = named_by(current, store);
    const std::string file = manifest_file(named);
    std::vector<std::byte> content;
    try {
      content = whole(file, kManifestLimit, kManifestName);
    } catch (const Error&) {
      // Another may have been published since CURRENT was read, and this one removed.
      std::string now = text_of(whole(current_file, kCurrentLimit, current_file));
      if (now == current) throw;
      current = std::move(now);
      continue;
    }
    if (sha256(content) != named)
      throw RootDamage(store, kManifestName, file + " is not what it was when it was written");
    if (hash != nullptr) *hash = named;
    if (text_bytes != nullptr) *text_bytes = content.size() + current.size();
    try {
      return parse_manifest(text_of(content), store + "/" + file);
    } catch (const NewerFormat&) {
      throw;
    } catch (const Error& error) {
      throw RootDamage(store, kManifestName, error.what());
    }
  }
}

std::string publish(const std::filesystem::path& store, const Manifest& manifest) {
  const std::string text = to_text(manifest);
  make_folder_in(store, "manifests");
  NewFile file(store, manifest_file("new"));
  file.write(std::as_bytes(std::span(text)));
  const std::string hash = file.commit_by_hash();
  write_file(store, current_file, fmt::format("{}{}\n{}\n", kCurrentStart, manifest.format, hash));
  return hash;
}

}  // namespace roam::store
