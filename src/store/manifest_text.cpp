// Conversion between manifests and text.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

#include "index/partition.h"
#include "store/json_reader.h"
#include "store/manifest.h"
#include "store/page.h"

namespace roam::store {
namespace {

Json numbers(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }
Json numbers(const Box& box) { return Json::array({numbers(box.lower), numbers(box.upper)}); }
std::string digits(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

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

/// Cost of an element of a growing list: its place, and for a moment the one before.
template <class T>
constexpr std::uint64_t element_cost = 3 * sizeof(T);

/// Reads a shard, on its own or within a manifest.
class ShardReader {
 public:
  explicit ShardReader(JsonReader& reader) : reader_(reader) {}

  /// `member`: the path relative to the shard.
  void value(ShardInfo& shard, std::string_view member, const JsonPlace& at, JsonValue* value) {
    constexpr std::string_view pages = "pages/*";
    if (member == pages) reader_.refuse("a page is no object");
    if (member.starts_with(pages)) {
      JsonMembers members(reader_, page_seen_, "a page", member.substr(pages.size() + 1), at, value);
      list(members, shard.pages.back());
      return;
    }
    JsonMembers members(reader_, seen_, "a shard", member, at, value);
    list(members, shard);
  }
  void object_begins(ShardInfo& shard, std::string_view member, const JsonPlace& at) {
    if (member.empty()) {
      seen_ = tiles_ = 0;
    } else if (member == "pages/*") {
      reader_.keep(element_cost<PageRef> + page_cost);
      shard.pages.emplace_back();
      page_seen_ = 0;
    } else {
      value(shard, member, at, nullptr);
    }
  }
  void object_ends(ShardInfo& shard, std::string_view member) {
    if (member == "pages/*") {
      PageRef& page = shard.pages.back();
      JsonMembers members(reader_, page_seen_, "a page");
      list(members, page);
      if (page.tiles < 1 || page.tiles > page_tiles) members.bad("tiles");
      if (page.bytes > most_page_bytes(page.tiles)) members.bad("bytes");
      tiles_ += page.tiles;
      return;
    }
    if (!member.empty()) return;
    JsonMembers members(reader_, seen_, "a shard");
    list(members, shard);
    std::uint64_t end = 0;
    for (const PageRef& page : shard.pages) {
      if (page.offset > shard.bytes || page.bytes > shard.bytes - page.offset)
        reader_.refuse("a page lies outside its pack");
      // Else a small pack could have any number of pages.
      if (page.offset < end) reader_.refuse("pages lie over each other in their pack");
      end = page.offset + page.bytes;
    }
    if (tiles_ != shard.tiles || shard.pages.empty()) members.bad("pages");
    if (shard.triangles > shard.tiles * index::most_tile_triangles) members.bad("triangles");
  }

 private:
  /// Also what an open store keeps for each page.
  static constexpr std::uint64_t page_cost = 96;

  static void list(JsonMembers& m, ShardInfo& shard) {
    m.digits("key", 64, shard.key);
    m.digits("pack", 64, shard.pack);
    m.whole("bytes", shard.bytes);
    m.whole("triangles", shard.triangles);
    m.whole("tiles", shard.tiles);
    m.whole("geometry_bytes", shard.geometry_bytes);
    m.whole("number_bytes", shard.number_bytes);
    m.whole("resident_bytes", shard.resident_bytes);
    m.box("bounds", shard.bounds);
    m.number("largest_error_m", shard.largest_error);
    m.hash("geometry_hash", shard.geometry_hash);
    m.list("pages");
  }
  static void list(JsonMembers& m, PageRef& page) {
    m.box("box", page.box);
    m.whole("offset", page.offset);
    m.whole("bytes", page.bytes);
    m.hash("xxh3", page.hash);
    m.whole("tiles", page.tiles);
  }

  JsonReader& reader_;
  std::uint64_t seen_ = 0, page_seen_ = 0;
  std::uint64_t tiles_ = 0;  ///< sum over the pages
};

class ShardText : public JsonReader {
 public:
  using JsonReader::JsonReader;
  void value(const JsonPlace& at, JsonValue value) override { put(at, &value); }
  void list_begins(const JsonPlace& at) override { put(at, nullptr); }
  void object_begins(const JsonPlace& at) override { reader_.object_begins(shard, at.path, at); }
  void object_ends(const JsonPlace& at) override { reader_.object_ends(shard, at.path); }

  ShardInfo shard;

 private:
  void put(const JsonPlace& at, JsonValue* value) {
    if (at.path.empty()) refuse("a shard is no object");
    reader_.value(shard, at.path, at, value);
  }
  ShardReader reader_{*this};
};

class ManifestText : public JsonReader {
 public:
  ManifestText(const std::string& name, std::uint64_t memory) : JsonReader(name, memory), manifest_name_(name) {}

  void value(const JsonPlace& at, JsonValue value) override { put(at, &value); }
  void list_begins(const JsonPlace& at) override { put(at, nullptr); }
  void object_begins(const JsonPlace& at) override {
    const std::string_view path = at.path;
    if (path == "parts/*") {
      keep(element_cost<PartInfo> + part_cost);
      manifest.parts.emplace_back();
      part_seen_ = 0;
      references_seen_ = false;
    } else if (path.starts_with(shards)) {
      if (path == shards) {
        keep(element_cost<ShardInfo> + shard_cost);
        manifest.shards.emplace_back();
      }
      shard_.object_begins(manifest.shards.back(), rest(path), at);
    } else if (!path.empty()) {
      put(at, nullptr);
    }
  }
  void object_ends(const JsonPlace& at) override {
    const std::string_view path = at.path;
    if (path == "parts/*") {
      JsonMembers members(*this, part_seen_, "a part");
      list(members, manifest.parts.back());
      add(triangles_, manifest.parts.back().triangles, "parts");
    } else if (path.starts_with(shards)) {
      shard_.object_ends(manifest.shards.back(), rest(path));
      if (path == shards) add(shard_triangles_, manifest.shards.back().triangles, "shards");
    } else if (path.empty()) {
      JsonMembers members(*this, seen_, "the manifest");
      list(members);
      std::set<std::string_view> packs;
      for (const ShardInfo& shard : manifest.shards) {
        if (!packs.insert(shard.pack).second) refuse("two shards have the same pack");
      }
      std::map<std::string_view, const PartInfo*> files;
      for (const PartInfo& part : manifest.parts) {
        const PartInfo& other = *files.emplace(part.file, &part).first->second;
        if (part.bytes != other.bytes || part.triangles != other.triangles || part.objects != other.objects) {
          refuse("two parts have the same file, but not the same counts");
        }
      }
      if (manifest.shards.empty()) members.bad("shards");
      if (triangles_ != shard_triangles_) {
        refuse("the shards hold more or fewer triangles than the parts of the scene");
      }
    }
  }

  Manifest manifest;

 private:
  static constexpr std::string_view shards = "shards/*";
  /// The digits, plus what an open store keeps for each.
  static constexpr std::uint64_t part_cost = 2 * 80 + 128, shard_cost = 2 * 80 + 128;

  /// The path relative to the shard.
  static std::string_view rest(std::string_view path) { return path.substr(std::min(path.size(), shards.size() + 1)); }
  void add(std::uint64_t& sum, std::uint64_t triangles, const char* of) const {
    if (triangles > UINT64_MAX - sum) refuse(fmt::format("the triangles of the {} are more than there can be", of));
    sum += triangles;
  }
  void put(const JsonPlace& at, JsonValue* value) {
    const std::string_view path = at.path;
    if (path.empty()) refuse("the manifest is no object");
    if (path == "parts/*") refuse("a part is no object");
    if (path == shards) refuse("a shard is no object");
    if (path == "notes/*") {
      JsonMembers members(*this, note_seen_ = 0, "the notes", "note", at, value);
      keep(element_cost<std::string>);
      members.text("note", manifest.notes.emplace_back());
    } else if (path == "parts/*/references") {
      // The only member that may be missing.
      if (value != nullptr || std::exchange(references_seen_, true)) refuse_references();
    } else if (path == "parts/*/references/*") {
      auto* const* const text = value != nullptr ? std::get_if<std::string*>(value) : nullptr;
      if (text == nullptr) refuse_references();
      keep(element_cost<std::string> + (*text)->size());
      manifest.parts.back().references.push_back(**text);
    } else if (path.starts_with("parts/*/")) {
      JsonMembers members(*this, part_seen_, "a part", path.substr(8), at, value);
      list(members, manifest.parts.back());
    } else if (path.starts_with(shards)) {
      shard_.value(manifest.shards.back(), rest(path), at, value);
    } else {
      JsonMembers members(*this, seen_, "the manifest", path, at, value);
      list(members);
      // A newer format may differ in other members, so it is checked first: that is no damage.
      if (path == "format") check_format(manifest.format, manifest_name_);
    }
  }
  void list(JsonMembers& m) {
    m.whole("format", manifest.format);
    m.truth("lossless", manifest.lossless);
    m.text("options", manifest.options, longest_options);
    m.box("bounds", manifest.bounds);
    m.hash("geometry_hash", manifest.geometry_hash);
    m.list("parts");
    m.list("shards");
    m.list("notes");
  }
  [[noreturn]] void refuse_references() const { refuse("'references' of a part are not what they should be"); }
  static void list(JsonMembers& m, PartInfo& part) {
    m.text("name", part.name);
    m.text("fingerprint", part.fingerprint);
    m.digits("file", 64, part.file);
    m.whole("bytes", part.bytes);
    m.whole("triangles", part.triangles);
    m.whole("objects", part.objects);
  }

  std::string manifest_name_;
  ShardReader shard_{*this};
  std::uint64_t seen_ = 0, part_seen_ = 0, note_seen_ = 0;
  bool references_seen_ = false;
  std::uint64_t triangles_ = 0, shard_triangles_ = 0;
};

}  // namespace

void check_format(std::uint32_t version, const std::string& name) {
  if (version > format_version) {
    throw NewerFormat(name,
                      fmt::format("it is written in version {} of the format, and this roam reads versions up to {}: "
                                  "use a newer roam",
                                  version, format_version));
  }
}

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
    if (!part.references.empty()) parts.back()["references"] = part.references;
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

ShardInfo parse_shard(std::string_view text, const std::string& name, std::uint64_t memory) {
  ShardText reader(name, memory);
  reader.read(text);
  return std::move(reader.shard);
}

Manifest parse_manifest(std::string_view text, const std::string& name, std::uint64_t memory, std::uint64_t* kept) {
  ManifestText reader(name, memory);
  reader.keep(text.size());
  reader.read(text);
  if (kept != nullptr) *kept = reader.kept() - text.size();
  return std::move(reader.manifest);
}

}  // namespace roam::store
