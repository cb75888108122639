// Archives of 3D Tiles: the same scene as their folder, tile by tile, and what hostile ones cost.

#include <gtest/gtest.h>
#include <zlib.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "archive_made.h"
#include "gltf_made.h"
#include "import/parts.h"
#include "import_files.h"
#include "roam/error.h"
#include "sanitizer.h"
#include "shown_scene.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t deflate_method = 8, zstd_method = 93;

std::string grid_tile(float height) { return made_tile("b3dm", MadeGrid(3, height).gltf().glb()); }

/// A tileset of two levels, an external tileset and a tile in a folder.
std::vector<MadeEntry> city(std::uint32_t method) {
  const Json root =
      made_node("1.b3dm", {made_node("fine/2.b3dm"), made_node("fine/inner.json"), made_node("./fine/../4.b3dm")});
  std::vector<MadeEntry> entries{{"tileset.json", made_tileset(root)},
                                 {"1.b3dm", grid_tile(1)},
                                 {"fine/", ""},
                                 {"fine/2.b3dm", grid_tile(2)},
                                 {"fine/inner.json", made_tileset(made_node("3.b3dm"))},
                                 {"fine/3.b3dm", grid_tile(3)},
                                 {"4.b3dm", grid_tile(4)},
                                 {"@3dtilesIndex1@", "an index"}};
  for (MadeEntry& entry : entries) entry.method = method;
  return entries;
}

/// The entries as files.
fs::path unpack(const TemporaryFolder& folder, const std::vector<MadeEntry>& entries) {
  for (const MadeEntry& entry : entries) {
    if (!entry.name.ends_with('/')) folder.write("city/" + entry.name, entry.content);
  }
  return folder.path() / "city";
}

std::string error_of(const TemporaryFolder& folder, const std::vector<MadeEntry>& entries,
                     const ImportOptions& options = {}) {
  return import_error(folder.write("city.3tz", made_archive(entries)), options);
}

TEST(ImportArchives, AreTheSameSceneAsTheirFolder) {
  const TemporaryFolder folder;
  const ImportedScene loose = import_scene(unpack(folder, city(0)));
  EXPECT_EQ(loose.report.triangles, 54u);
  for (const char* name : {"city.3tz", "city.ZIP"}) {
    for (const std::uint32_t method : {0u, deflate_method}) {
      const ImportedScene scene = import_scene(folder.write(name, made_archive(city(method))));
      EXPECT_EQ(triangles_of(scene), triangles_of(loose)) << name << method;
      EXPECT_EQ(scene.report.files, loose.report.files);
      EXPECT_TRUE(scene.report.notes.empty());
    }
  }
  EXPECT_EQ(show_finest({folder.path() / "city.3tz"}).triangles.size(), 54u);
}

TEST(ImportArchives, AreReadPartByPart) {
  const TemporaryFolder folder;
  const fs::path archive = folder.write("city.3tz", "#!/bin/sh\n" + made_archive(city(deflate_method)));
  const std::vector<ScenePart> parts = scene_parts({&archive, 1});
  ASSERT_EQ(parts.size(), 4u);  // the outline and three contents
  EXPECT_EQ(parts[1].name, "city/fine/2.b3dm");
  std::ifstream in(archive, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::uint64_t triangles = 0;
  for (const ScenePart& part : parts) {
    ASSERT_EQ(part.entries.size(), part.files.size());
    std::vector<FileLookUp> look_ups;
    const auto read = [&](const ScenePart& one) {
      return stream_part(
                 one, {}, [](const Mesh&, bool) {}, [&](const FileLookUp& file) { look_ups.push_back(file); })
          .triangles;
    };
    triangles += read(part);
    if (part.entries.size() > 1) continue;
    const ArchiveEntry& entry = part.entries[0];
    const auto height = static_cast<float>(&part - parts.data() + 1);
    EXPECT_EQ(bytes.substr(entry.begin, entry.packed), deflated(grid_tile(height)));
    // Wherever the directory has it now.
    ScenePart moved = part;
    moved.entries[0].record += 3;
    EXPECT_EQ(read(moved), 18u);
    moved.entries[0].number = 1;
    moved.entries[0].record = std::uint64_t{1} << 63;
    EXPECT_EQ(read(moved), 18u);
    for (const FileLookUp& file : look_ups) EXPECT_TRUE(file.found && file.bytes == bytes.size()) << file.file;
  }
  EXPECT_EQ(triangles, 54u);
}

TEST(ImportArchives, ReadNothingOutside) {
  const TemporaryFolder folder;
  for (const char* name : {"outside.b3dm", "inner.3tz"}) folder.write(name, grid_tile(9));
  const Json root = made_node("", {made_node("1.b3dm"), made_node("../outside.b3dm"), made_node("../city.3tz"),
                                   made_node((folder.path() / "outside.b3dm").string()), made_node("inner.3tz/1.b3dm"),
                                   made_node("tileset.json")});
  const fs::path archive = folder.write("city.3tz", made_archive({{"tileset.json", made_tileset(root)},
                                                                  {"1.b3dm", grid_tile(1)},
                                                                  {"inner.3tz", made_archive(city(0))}}));
  const ImportedScene scene = import_scene(archive);
  EXPECT_EQ(scene.report.triangles, 18u);
  EXPECT_EQ(scene.report.missing_pages, 5u);
  EXPECT_TRUE(notes_contain(scene, "contains itself"));
}

TEST(ImportArchives, LeaveOutADamagedEntryWithANote) {
  const TemporaryFolder folder;
  for (const std::uint32_t method : {0u, deflate_method}) {
    std::string bytes = made_archive(city(method));
    bytes[bytes.find("b3dm", bytes.find("fine/3.b3dm") + 11) + 100] ^= 1;
    const ImportedScene scene = import_scene(folder.write("city.3tz", bytes));
    EXPECT_EQ(scene.report.triangles, 36u);
    EXPECT_EQ(scene.report.missing_pages, 1u);
    EXPECT_TRUE(notes_contain(scene, "does not have its checksum"));
  }
}

TEST(ImportArchives, AreRefusedForEntriesThatCannotBeMeant) {
  const TemporaryFolder folder;
  const auto with = [](const MadeEntry& entry) {
    std::vector<MadeEntry> entries = city(0);
    entries.push_back(entry);
    return entries;
  };
  for (const char* name : {"../x", "/etc/passwd", "a/../../x", "..\\x", "..", ""}) {
    EXPECT_TRUE(contains(error_of(folder, with({name, "x"})), "leads out of the archive")) << name;
  }
  EXPECT_TRUE(contains(error_of(folder, with({std::string("a\0b", 3), "x"})), "leads out of the archive"));
  EXPECT_TRUE(contains(error_of(folder, with({std::string(5000, 'a'), "x"})), "has 5000 bytes"));
  for (const char* name : {"1.b3dm", "./1.b3dm", "fine/../1.b3dm", "fine\\2.b3dm"}) {
    EXPECT_TRUE(contains(error_of(folder, with({name, "x"})), "two of its entries have the name")) << name;
  }
  EXPECT_TRUE(contains(error_of(folder, with({"x", "x", 0, 1})), "is encrypted"));
  EXPECT_TRUE(contains(error_of(folder, with({"x", "x", zstd_method})), "is compressed by zstd, which is not read"));
  EXPECT_TRUE(contains(error_of(folder, with({"x", "x", 14})), "is compressed by method 14 of zip"));
  EXPECT_TRUE(contains(error_of(folder, with({"x", "xyz", 0, 0, "x"})), "states 3 bytes, packed into 1"));
  EXPECT_TRUE(contains(error_of(folder, with({"x", std::string(20'000, ' '), 8, 0, "x"})), "states 20000 bytes"));
  EXPECT_TRUE(contains(error_of(folder, {}), "no whole zip archive"));
  EXPECT_TRUE(contains(error_of(folder, {{"city/tileset.json", "{}"}}), "has no tileset.json at its root"));
}

TEST(ImportArchives, AreRefusedIfEntriesShareTheirBytes) {
  const TemporaryFolder folder;
  std::vector<MadeEntry> entries = city(0);
  for (int i = 0; i < 500; ++i) {
    entries.push_back({"x" + std::to_string(i), grid_tile(1), 0, 0, std::nullopt, 0});
  }
  EXPECT_TRUE(contains(error_of(folder, entries), "its entries have more bytes than the archive"));

  // A few whose bytes fit. Two names of the same bytes do no harm; one entry inside of another does.
  const Json root = made_node("", {made_node("1.b3dm"), made_node("2.b3dm"), made_node("3.b3dm")});
  const MadeEntry tileset{"tileset.json", made_tileset(root)};
  MadeEntry outer{"1.b3dm", grid_tile(1)};
  const std::size_t place = local_entry(tileset).size();
  const std::size_t inside = place + local_entry(outer).size();
  const MadeEntry same{"3.b3dm", grid_tile(1), 0, 0, std::nullopt, place};
  const auto parts_of = [&](const std::vector<MadeEntry>& all) {
    // Bytes before the archive, so that there are as many as the entries have.
    const fs::path archive = folder.write("city.3tz", std::string(9 * outer.content.size(), 'x') + made_archive(all));
    return scene_parts({&archive, 1}).size();
  };
  EXPECT_EQ(parts_of({tileset, outer, same}), 3u);
  const MadeEntry inner{"2.b3dm", grid_tile(2), 0, 0, std::nullopt, inside};
  outer.content += local_entry(inner);
  try {
    parts_of({tileset, outer, inner});
    ADD_FAILURE() << "one entry inside of another";
  } catch (const Error& error) {
    EXPECT_TRUE(contains(error.what(), "the entries of this archive overlap")) << error.what();
  }
}

/// Bytes deflated by zlib.
std::string zlib_deflated(const std::string& bytes) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  std::string input = bytes;
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

TEST(ImportArchives, UnpackNoMoreThanTheMemoryHolds) {
  ROAM_NEEDS_PLAIN_MEMORY();
  const TemporaryFolder folder;
  const std::string bomb = grid_tile(1) + std::string(100u << 20, '\0');
  const MadeEntry entry{"bomb.b3dm", bomb, deflate_method, 0, zlib_deflated(bomb)};
  const std::string bytes = made_archive({{"tileset.json", made_tileset(made_node("bomb.b3dm"))}, entry});
  EXPECT_LT(bytes.size(), 1u << 20);
  const fs::path archive = folder.write("city.3tz", bytes);
  EXPECT_TRUE(contains(import_error(archive, {.memory_limit = 64u << 20}), "of memory that importing may use"));
  EXPECT_EQ(import_error(archive), "");
}

TEST(ImportArchives, AreRefusedIfCutOff) {
  const TemporaryFolder folder;
  const std::string whole = made_archive(city(deflate_method));
  for (std::size_t i = 1; i < 16; ++i) {
    const std::string error = import_error(folder.write("city.3tz", whole.substr(0, whole.size() * i / 16)));
    EXPECT_TRUE(contains(error, "no whole zip archive")) << error;
  }
  // Archives may begin behind other bytes, as for all programs that read zip.
  EXPECT_EQ(import_error(folder.write("city.3tz", "#!/bin/sh\n" + whole)), "");
}

TEST(ImportArchives, GiveTheTrianglesOfRealTiles) {
  ROAM_NEEDS_TEST_DATA();
  const TemporaryFolder folder;
  std::vector<MadeEntry> entries;
  for (const auto& file : fs::recursive_directory_iterator(test_data() / "pit_3dtiles")) {
    if (!file.is_regular_file()) continue;
    std::ifstream in(file.path(), std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(in), {}};
    const std::string name = file.path().lexically_relative(test_data() / "pit_3dtiles").string();
    entries.push_back({name, content, deflate_method, 0, zlib_deflated(content)});
  }
  const ImportedScene loose = import_scene(test_data() / "pit_3dtiles");
  const ImportedScene scene = import_scene(folder.write("pit.3tz", made_archive(entries)));
  EXPECT_EQ(scene.report.triangles, 177'950u);
  EXPECT_EQ(triangles_of(scene), triangles_of(loose));
  EXPECT_EQ(scene.report.notes.size(), loose.report.notes.size());
}

}  // namespace
}  // namespace roam::test
