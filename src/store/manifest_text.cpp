// Conversion between manifests and text.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "index/partition.h"
#include "store/files.h"
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

/// Reads the members of a JSON object.
class Members {
 public:
  Members(JsonReader& reader, const char* what, const Json& json) : reader_(reader), what_(what), json_(json) {}

  /// A text of at most `most` bytes.
  void text(const char* name, std::string& out, std::size_t most = std::numeric_limits<std::size_t>::max()) const {
    const Json& json = at(name, Json::value_t::string);
    const auto& found = json.get_ref<const std::string&>();
    if (found.size() > most) bad(name);
    reader_.keep(found.size());
    out = found;  // copied, so that it takes only its own size
  }
  /// A text of `count` hexadecimal digits.
  void digits(const char* name, std::size_t count, std::string& out) const {
    out = at(name, Json::value_t::string).get<std::string>();
    if (!is_digits(out, count)) bad(name);
  }
  void hash(const char* name, std::uint64_t& out) const {
    std::string text;
    digits(name, 16, text);
    out = std::stoull(text, nullptr, 16);
  }
  template <class Whole>
  void whole(const char* name, Whole& out) const {
    const auto found = at(name, Json::value_t::number_unsigned).get<std::uint64_t>();
    if (found > std::numeric_limits<Whole>::max()) bad(name);
    out = static_cast<Whole>(found);
  }
  void number(const char* name, double& out) const { out = number_in(at(name), name); }
  void truth(const char* name, bool& out) const { out = at(name, Json::value_t::boolean).get<bool>(); }
  void box(const char* name, Box& out) const {
    const Json& sides = at(name, Json::value_t::array);
    if (sides.size() != 2) bad(name);
    for (std::size_t side = 0; side < 2; ++side) {
      if (!sides[side].is_array() || sides[side].size() != 3) bad(name);
      for (std::size_t k = 0; k < 3; ++k) {
        (side == 0 ? out.lower : out.upper)[static_cast<int>(k)] = number_in(sides[side][k], name);
      }
    }
    if (out.empty()) bad(name);
  }
  [[nodiscard]] bool has(const char* name) const { return json_.contains(name); }
  /// Its elements have been read before.
  void list(const char* name) const { static_cast<void>(at(name, Json::value_t::array)); }
  [[noreturn]] void bad(std::string_view name) const {
    reader_.refuse(fmt::format("'{}' of {} is missing or not what it should be", name, what_));
  }

 private:
  [[nodiscard]] const Json& at(const char* name) const {
    const auto found = json_.find(name);
    if (found == json_.end()) bad(name);
    return *found;
  }
  [[nodiscard]] const Json& at(const char* name, Json::value_t type) const {
    const Json& found = at(name);
    if (found.type() != type) bad(name);
    return found;
  }
  [[nodiscard]] double number_in(const Json& json, const char* name) const {
    if (!json.is_number() || !std::isfinite(json.get<double>())) bad(name);
    return json.get<double>();
  }

  JsonReader& reader_;
  const char* what_;
  const Json& json_;
};

/// An object of a manifest. Other members than these are left out.
struct Kind {
  const char* what;
  std::array<std::string_view, 12> members;
};
enum KindNumber : std::size_t { the_manifest, a_part, a_shard, a_page };
constexpr std::array<Kind, 4> kinds{
    {{"the manifest", {"format", "lossless", "options", "bounds", "geometry_hash", "parts", "shards", "notes"}},
     {"a part", {"name", "fingerprint", "file", "bytes", "triangles", "objects", "references"}},
     {"a shard",
      {"key", "pack", "bytes", "triangles", "tiles", "geometry_bytes", "number_bytes", "resident_bytes", "bounds",
       "largest_error_m", "geometry_hash", "pages"}},
     {"a page", {"box", "offset", "bytes", "xxh3", "tiles"}}}};

/// Reads a manifest, or a shard on its own. Each part, shard, page and note is taken as soon as it is read, and leaves
/// the tree of values then.
class ManifestReader {
 public:
  ManifestReader(const std::string& name, std::uint64_t memory, KindNumber root)
      : reader_(name, memory), name_(name), root_level_(root == a_shard ? 2 : 0) {
    if (root == a_shard) member_[the_manifest] = "shards";
  }

  void read(std::string_view text) {
    static_cast<void>(reader_.read(text, [this](int depth, Json::parse_event_t event, Json& json) {
      return see(depth + root_level_, event, json);
    }));
  }

  [[nodiscard]] std::uint64_t kept() const { return reader_.kept(); }

  Manifest manifest;

 private:
  /// The digits, plus what an open store keeps for each.
  static constexpr std::uint64_t part_cost = 2 * 80 + 128, shard_cost = 2 * 80 + 128;
  /// What an open store keeps for each page.
  static constexpr std::uint64_t page_cost = 96;
  /// Values and lists of the known members of an object, at most.
  static constexpr int most_values = 64;
  static constexpr int none = std::numeric_limits<int>::max();

  /// Whether a value is kept in the tree.
  bool see(int level, Json::parse_event_t event, Json& json) {
    using Event = Json::parse_event_t;
    if (event == Event::key) return begin_member(level, json.get_ref<const std::string&>());
    if (event == Event::array_end || level >= skipped_) return true;
    if (event == Event::object_end) {
      skipped_ = none;
      end_object(json);
      return level == root_level_;
    }
    const auto is_in = [&](KindNumber kind, std::string_view list) { return open_ == kind && member_[kind] == list; };
    if (level == 2 && is_in(the_manifest, "notes")) {
      if (!json.is_string()) bad();
      reader_.keep(element_cost<std::string> + json.get_ref<const std::string&>().size());
      manifest.notes.push_back(json.get<std::string>());
      return false;
    }
    if (level == 4 && is_in(a_part, "references")) {
      if (!json.is_string()) bad();
      reader_.keep(element_cost<std::string> + json.get_ref<const std::string&>().size());
      manifest.parts.back().references.push_back(json.get<std::string>());
      return false;
    }
    std::optional<KindNumber> kind;
    if (level == 0) kind = the_manifest;
    if (level == 2 && is_in(the_manifest, "parts")) kind = a_part;
    if (level == 2 && is_in(the_manifest, "shards")) kind = a_shard;
    if (level == 4 && is_in(a_shard, "pages")) kind = a_page;
    if (kind) {
      if (event != Event::object_start) reader_.refuse(fmt::format("{} is no object", kinds[*kind].what));
      begin_object(*kind);
      return true;
    }
    if (event == Event::object_start || ++values_[open_] > most_values) bad();
    // A newer format may differ in other members, so it is checked first: that is no damage.
    if (is_in(the_manifest, "format") && json.is_number_unsigned()) {
      check_format(static_cast<std::uint32_t>(std::min<std::uint64_t>(json.get<std::uint64_t>(), UINT32_MAX)), name_);
    }
    return true;
  }

  bool begin_member(int level, std::string_view name) {
    if (level > skipped_) return false;
    const auto& members = kinds[open_].members;
    const auto known = std::find(members.begin(), members.end(), name);
    skipped_ = name.empty() || known == members.end() ? level : none;
    if (skipped_ == level) return false;
    member_[open_] = *known;
    const unsigned bit = 1U << (known - members.begin());
    if ((seen_[open_] & bit) != 0) bad();
    seen_[open_] |= bit;
    return true;
  }

  void begin_object(KindNumber kind) {
    if (kind == a_part) {
      reader_.keep(element_cost<PartInfo> + part_cost);
      manifest.parts.emplace_back();
    } else if (kind == a_shard) {
      reader_.keep(element_cost<ShardInfo> + shard_cost);
      manifest.shards.emplace_back();
    } else if (kind == a_page) {
      reader_.keep(element_cost<PageRef> + page_cost);
      manifest.shards.back().pages.emplace_back();
    }
    open_ = kind;
    values_[kind] = 0;
    seen_[kind] = 0;
  }

  void end_object(const Json& json) {
    const Members members(reader_, kinds[open_].what, json);
    if (open_ == a_page) {
      take(members, manifest.shards.back().pages.back());
    } else if (open_ == a_shard) {
      take(members, manifest.shards.back());
    } else if (open_ == a_part) {
      take(members, manifest.parts.back());
    } else {
      take(members);
    }
    open_ = open_ == a_page ? a_shard : the_manifest;
  }

  static void take(const Members& m, PageRef& page) {
    m.box("box", page.box);
    m.whole("offset", page.offset);
    m.whole("bytes", page.bytes);
    m.hash("xxh3", page.hash);
    m.whole("tiles", page.tiles);
    if (page.tiles < 1 || page.tiles > page_tiles) m.bad("tiles");
    if (page.bytes > most_page_bytes(page.tiles)) m.bad("bytes");
  }
  void take(const Members& m, ShardInfo& shard) {
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
    std::uint64_t tiles = 0;
    for (const PageRef& page : shard.pages) {
      if (page.offset > shard.bytes || page.bytes > shard.bytes - page.offset)
        reader_.refuse("a page lies outside its pack");
      tiles += page.tiles;
    }
    if (tiles != shard.tiles || shard.pages.empty()) m.bad("pages");
    if (shard.triangles > shard.tiles * index::most_tile_triangles) m.bad("triangles");
    add(shard_triangles_, shard.triangles, "shards");
  }
  void take(const Members& m, PartInfo& part) {
    m.text("name", part.name);
    m.text("fingerprint", part.fingerprint);
    m.digits("file", 64, part.file);
    m.whole("bytes", part.bytes);
    m.whole("triangles", part.triangles);
    m.whole("objects", part.objects);
    if (m.has("references")) m.list("references");
    add(triangles_, part.triangles, "parts");
  }
  void take(const Members& m) {
    m.whole("format", manifest.format);
    m.truth("lossless", manifest.lossless);
    m.text("options", manifest.options, longest_options);
    m.box("bounds", manifest.bounds);
    m.hash("geometry_hash", manifest.geometry_hash);
    for (const char* list : {"parts", "shards", "notes"}) m.list(list);
    if (manifest.shards.empty()) m.bad("shards");
    if (triangles_ != shard_triangles_) {
      reader_.refuse("the shards hold more or fewer triangles than the parts of the scene");
    }
  }

  void add(std::uint64_t& sum, std::uint64_t triangles, const char* of) const {
    if (triangles > UINT64_MAX - sum) {
      reader_.refuse(fmt::format("the triangles of the {} are more than there can be", of));
    }
    sum += triangles;
  }
  /// The present member is not what it should be.
  [[noreturn]] void bad() {
    static const Json nothing;
    Members(reader_, kinds[open_].what, nothing).bad(member_[open_]);
  }

  JsonReader reader_;
  const std::string& name_;
  int root_level_;
  int skipped_ = none;                        ///< level of a member that is not known, from its name to the next one
  KindNumber open_ = the_manifest;            ///< the innermost object
  std::array<std::string_view, 4> member_{};  ///< of each kind's object, the present one
  std::array<unsigned, 4> seen_{};            ///< a bit for each of its members
  std::array<int, 4> values_{};
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
  ManifestReader reader(name, memory, a_shard);
  reader.read(text);
  return std::move(reader.manifest.shards.front());
}

Manifest parse_manifest(std::string_view text, const std::string& name, std::uint64_t memory, std::uint64_t* kept) {
  ManifestReader reader(name, memory, the_manifest);
  reader.read(text);
  if (kept != nullptr) *kept = reader.kept();
  return std::move(reader.manifest);
}

}  // namespace roam::store
