// A store that says what cannot be: it is refused, or read, in little memory.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/file.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <future>
#include <random>
#include <stop_token>

#include "files/descriptor.h"
#include "memory_cost.h"
#include "packed_part.h"
#include "pager_made.h"
#include "roam/pager.h"
#include "store/build/fingerprint.h"
#include "store/opened.h"
#include "store/part_bytes.h"
#include "store_made.h"

namespace {

using namespace roam;

using memory_cost::Cost;
using memory_cost::cost_of;
using packed_parts::number;
using packed_parts::packed_part;

class HostileStore : public testing::Test {
 protected:
  HostileStore() : folder_("hostile") {
    mesh_.name = "square";
    for (std::uint32_t i = 0; i < 900; ++i) mesh_.vertices.emplace_back(i % 30, i / 30, (i * 7919U) % 5);
    for (std::uint32_t i = 0; i + 31 < 900; ++i) mesh_.triangles.push_back({i, i + 1, i + 30});
    made::Maker(folder_.path(), {&mesh_, 1}, {.page_tiles = 4, .tile_triangles = 100}).run();
  }

  [[nodiscard]] store::Manifest manifest() const { return store::read_manifest(*store::files_of(folder_.path()), "s"); }
  /// Puts any text in force.
  void publish(const std::string& text) const {
    store::NewFile file(folder_.path(), store::manifest_file("new"));
    file.write(std::as_bytes(std::span(text)));
    store::write_file(folder_.path(), store::current_file, "roam store 1\n" + file.commit_by_hash() + "\n");
  }
  /// Puts a part file of these many objects and this content in force. `window`: log2 of the bytes of its window.
  void publish_part(std::uint64_t objects, const std::string& content, int window = 21) const {
    publish_part(folder_.path(), objects, content, window);
  }
  static void publish_part(const std::filesystem::path& folder, std::uint64_t objects, const std::string& content,
                           int window) {
    store::Manifest m = store::read_manifest(*store::files_of(folder), "s");
    const auto bytes = packed_part(m.parts[0].triangles, objects, 1, content, window);
    store::NewFile file(folder, store::part_file("new"));
    file.write(bytes);
    m.parts[0].file = file.commit_by_hash();
    m.parts[0].bytes = bytes.size();
    m.parts[0].objects = objects;
    store::publish(folder, m);
  }
  /// What `source` says of a triangle of the store.
  [[nodiscard]] std::string object_of_one() const {
    const auto opened = Store::open(folder_.path());
    TriangleId some = 0;
    opened->for_each_triangle(opened->info().bounds, [&](auto, auto ids) { some = ids[0]; });
    return opened->source(some).object;
  }
  /// One cell of all triangles, as a part's content ends.
  [[nodiscard]] std::string cell() const { return std::string(1, '\0') + number(mesh_.triangles.size()); }
  [[nodiscard]] static std::string damage(const StoreVerification& found) {
    std::string text;
    for (const StoreDamage& d : found.damage) text += d.what + ": " + d.why + "\n";
    return text;
  }

  const made::Folder folder_;
  Mesh mesh_;
};

TEST_F(HostileStore, PagesAndPacksAreNamedOnce) {
  const auto refusal = [&](const store::Manifest& m) {
    store::publish(folder_.path(), m);
    return cost_of([&] { static_cast<void>(Store::open(folder_.path())); }).said;
  };
  EXPECT_EQ(refusal(manifest()), "");
  const store::Manifest good = manifest();
  store::Manifest m = good;
  ASSERT_GE(m.shards[0].pages.size(), 2U);
  m.shards[0].pages[1].offset = m.shards[0].pages[0].offset;
  EXPECT_NE(refusal(m).find("over each other"), std::string::npos);
  m = good;
  m.shards.push_back(m.shards[0]);
  m.parts.push_back(m.parts[0]);
  EXPECT_NE(refusal(m).find("the same pack"), std::string::npos);
  m = good;
  m.parts.push_back(m.parts[0]);
  ++m.parts[1].objects;
  EXPECT_NE(refusal(m).find("not the same counts"), std::string::npos);
  EXPECT_EQ(refusal(good), "");
}

TEST_F(HostileStore, APartOfMoreObjectsThanTrianglesIsDamaged) {
  constexpr std::uint64_t objects = 1'000'000;
  publish_part(objects, std::string(2 * objects, '\0') + cell(), 10);
  EXPECT_NE(damage(verify_store(folder_.path())).find("objects"), std::string::npos);
  EXPECT_NE(cost_of([&] { static_cast<void>(object_of_one()); }).said.find("objects"), std::string::npos);
}

TEST_F(HostileStore, APartOfOtherCountsThanTheManifestNamesNoObject) {
  publish_part(1, std::string(2, '\0') + cell());
  EXPECT_EQ(object_of_one(), "");
  store::Manifest m = manifest();
  m.parts[0].objects = 2;
  store::publish(folder_.path(), m);
  EXPECT_NE(cost_of([&] { static_cast<void>(object_of_one()); }).said.find("counts"), std::string::npos);
}

TEST_F(HostileStore, APartThatUnpacksToFarMoreThanItsSizeIsDamaged) {
  const std::string name(100'000, 'a');
  const std::string content = std::string(1, '\0') + number(name.size()) + name + cell();
  publish_part(1, content);
  EXPECT_NE(damage(verify_store(folder_.path())).find("unpack"), std::string::npos);
  EXPECT_NE(cost_of([&] { static_cast<void>(object_of_one()); }).said.find("unpack"), std::string::npos);
  publish_part(1, content, 10);
  EXPECT_EQ(damage(verify_store(folder_.path())), "");
}

TEST_F(HostileStore, ALongNameIsCutAndNotKept) {
  const std::string name(200'000'000, 'a');
  publish_part(1, std::string(1, '\0') + number(name.size()) + name + cell(), 10);
  std::string object;
  EXPECT_LT(cost_of([&] { object = object_of_one(); }).mebibytes, 16U);
  EXPECT_EQ(object, std::string(store::longest_part_name, 'a'));
}

/// Queries find the triangles of a tile by its box, and by its mask before it is loaded.
TEST_F(HostileStore, ATileOutsideItsBoxOrItsMaskIsNotUsed) {
  Mesh wall;
  wall.vertices = {{0, 0, 0}, {8, 0, 0}, {8, 8, 8}, {0, 8, 8}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto box_of_a_corner = [](store::TileEntry& e) {
    for (int k = 0; k < 3; ++k) e.upper[k] = e.lower[k] + 1.0;
    std::fill(std::begin(e.mask), std::end(e.mask), ~std::uint64_t{0});
  };
  const auto elsewhere = [](store::TileEntry& e) {
    for (int k = 0; k < 3; ++k) e.origin[k] += 100.0 * e.step * 65536.0;
  };
  // No corner of a triangle is in there.
  const auto hole = [](store::TileEntry& e) { e.mask[3] &= ~(std::uint64_t{0xff} << (8 * 3)); };
  const struct {
    std::function<void(store::TileEntry&)> lie;
    std::string said;
  } lies[] = {
      {{}, ""}, {box_of_a_corner, "outside its box"}, {elsewhere, "outside its box"}, {hole, "outside its mask"}};
  for (const bool lossless : {false, true}) {
    for (const auto& [lie, said] : lies) {
      SCOPED_TRACE(said);
      const made::Folder folder("place");
      const auto opened = made::store(folder.path(), {&wall, 1}, {.lossless = lossless, .change = lie});
      const auto all = [&] { opened->for_each_triangle({Vec3(-1e3), Vec3(1e3)}, [](auto, auto) {}); };
      const std::string found = damage(verify_store(folder.path()));
      EXPECT_NE(cost_of(all).said.find(said), std::string::npos) << cost_of(all).said;
      EXPECT_NE(found.find(said), std::string::npos) << found;
      EXPECT_EQ(cost_of(all).said.empty(), said.empty());
      Pager pager(opened);
      const Vec3 beside(0.3, 0.3, 0.3);
      const auto stats = [&] { return pager.stats(); };
      ASSERT_TRUE(made::update_until(pager, {0.1, 0.1}, beside, [&] { return stats().tiles + stats().failed == 1; }));
      EXPECT_EQ(stats().failed, said.empty() ? 0U : 1U);
      EXPECT_NE(stats().last_failure.find(said), std::string::npos) << stats().last_failure;
      EXPECT_EQ(pager.clearance({0.1, 0.1}, beside, 1.0).unknown, !said.empty());
    }
  }
}

/// Bodies look for the tiles of a page within what the manifest says of it; pictures and verification show them.
TEST_F(HostileStore, APageThatIsNotTheOneOfTheManifestIsNotUsed) {
  const auto elsewhere = [](store::Manifest& m) {
    for (store::PageRef& page : m.shards[0].pages) page.box = {{0, 0, -90'000}, {10, 10, -89'999}};
    m.bounds.lower.z = m.shards[0].bounds.lower.z = -90'000;
  };
  const auto larger = [](store::Manifest& m) { m.shards[0].pages[0].box.upper.x += 1.0; };
  const auto smaller = [](store::Manifest& m) { m.shards[0].pages[0].box.upper.x -= 1.0; };
  const auto low = [](store::Manifest& m) { m.bounds.upper.z = m.shards[0].bounds.upper.z = 0.5; };
  const auto exact = [](store::Manifest& m) { m.shards[0].largest_error *= 0.5; };
  const auto fewer = [](store::Manifest& m) {
    ++m.shards[0].pages[0].tiles;
    --m.shards[0].pages[1].tiles;
  };
  const auto right = [](store::Manifest&) {};
  const struct {
    std::function<void(store::Manifest&)> lie;
    std::string said;
  } lies[] = {{right, ""},
              {elsewhere, "not that of its tiles"},
              {larger, "not that of its tiles"},
              {smaller, "not that of its tiles"},
              {low, "beyond the bounds"},
              {exact, "error"},
              {fewer, "more or fewer tiles"}};
  const store::Manifest good = manifest();
  for (const auto& [lie, said] : lies) {
    SCOPED_TRACE(said);
    store::Manifest m = good;
    lie(m);
    store::publish(folder_.path(), m);
    const auto opened = Store::open(folder_.path());
    std::uint64_t triangles = 0;
    std::string missing;
    opened->for_each_triangle(
        {Vec3(-1e5), Vec3(1e5)}, [&](auto some, auto) { triangles += some.size(); },
        [&](const std::string& what) { missing += what + "\n"; });
    EXPECT_EQ(triangles == mesh_.triangles.size(), said.empty());
    EXPECT_EQ(missing.empty(), said.empty());
    EXPECT_NE(missing.find(said), std::string::npos) << missing;
    EXPECT_NE(damage(verify_store(folder_.path())).find(said), std::string::npos);
    Pager pager(opened);
    const Vec3 at = m.shards[0].pages[0].box.center();
    ASSERT_TRUE(
        made::update_until(pager, {0.1, 0.1}, at, [&] { return pager.stats().pages + pager.stats().failed > 0; }));
    EXPECT_NE(pager.stats().last_failure.find(said), std::string::npos) << pager.stats().last_failure;
  }
}

/// The boxes by which queries find triangles are those without the low bits.
TEST_F(HostileStore, AFineTileWhoseErrorsHideItsLowBitsIsNotUsed) {
  Mesh wall;
  wall.vertices = {{0, 0, 0}, {8, 0.01, 0.01}, {8.25, 8.75, 8.125}, {0, 8, 8}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto none = [](store::TileEntry& e) {
    for (int k = 0; k < 3; ++k) {
      e.lower[k] += double(e.error);
      e.upper[k] -= double(e.error);
    }
    e.error = e.fine_error = 0.0F;
  };
  const auto coarse = [](store::TileEntry& e) { e.fine_error = e.error; };
  const struct {
    std::function<void(store::TileEntry&)> lie;
    std::string said;
  } lies[] = {{{}, ""}, {none, "low bits"}, {coarse, "error is out of range"}};
  for (const auto& [lie, said] : lies) {
    SCOPED_TRACE(said);
    const made::Folder folder("low");
    const auto opened = made::store(folder.path(), {&wall, 1}, {.lossless = true, .change = lie});
    const auto all = [&] { opened->for_each_triangle({Vec3(-1e3), Vec3(1e3)}, [](auto, auto) {}); };
    const std::string found = cost_of(all).said;
    EXPECT_EQ(found.empty(), said.empty());
    EXPECT_NE(found.find(said), std::string::npos) << found;
    EXPECT_NE(damage(verify_store(folder.path())).find(said), std::string::npos);
  }
}

/// Else a small pack would take as long as a large one.
TEST_F(HostileStore, TilesThatLieOverEachOtherInTheirPackAreNotUsed) {
  const auto longer = [](store::TileEntry& e) { e.number_bytes += 64; };
  for (const bool lies : {false, true}) {
    const made::Folder folder("over");
    const auto opened = made::store(folder.path(), {&mesh_, 1},
                                    {.page_tiles = 4,
                                     .tile_triangles = 100,
                                     .change = lies ? std::function<void(store::TileEntry&)>(longer) : nullptr});
    const std::string found = damage(verify_store(folder.path()));
    EXPECT_EQ(found.find("over each other") != std::string::npos, lies) << found;
    EXPECT_EQ(found.empty(), !lies) << found;
  }
}

/// The names of the first objects are kept without a look at those that follow them.
TEST_F(HostileStore, APartWhoseFirstNamesAreGoodIsDamagedBehindThem) {
  constexpr std::uint64_t objects = 15'000, bad = 14'000;
  constexpr std::size_t side = 128;  // 2 * 127 * 127 triangles
  Mesh mesh;
  for (std::uint32_t i = 0; i < side * side; ++i) mesh.vertices.emplace_back(i % side, i / side, 0.0);
  for (std::uint32_t i = 0; i + side + 1 < side * side; ++i) {
    if (i % side == side - 1) continue;
    mesh.triangles.push_back({i, i + 1, i + static_cast<std::uint32_t>(side)});
  }
  ASSERT_GT(mesh.triangles.size(), objects);
  const made::Folder folder("behind");
  made::Maker(folder.path(), {&mesh, 1}, {.page_tiles = 4, .tile_triangles = 100}).run();
  std::mt19937 random(1);
  std::string content;
  for (std::uint64_t i = 0; i < objects; ++i) {
    content += std::string(1, i == 0 || i == bad ? '\0' : '\1') + number(40);
    for (int k = 0; k < 40; ++k) content += static_cast<char>('a' + random() % 26);
  }
  content += std::string(1, '\0') + number(mesh.triangles.size());
  publish_part(folder.path(), objects, content, 21);

  const auto opened = Store::open(folder.path());
  const auto id_of = [&](std::uint64_t wanted) {
    TriangleId id = 0;
    opened->for_each_triangle(opened->info().bounds, [&](auto, auto ids) {
      for (const TriangleId some : ids) id = opened->scene_triangle(some) == wanted ? some : id;
    });
    return id;
  };
  const TriangleId early = id_of(5), late = id_of(14'500);
  const auto said = [&](TriangleId id) { return cost_of([&] { static_cast<void>(opened->source(id)); }).said; };
  EXPECT_EQ(said(early), "");
  EXPECT_NE(said(late).find("in no order"), std::string::npos) << said(late);
  EXPECT_NE(said(late).find("in no order"), std::string::npos) << "it was kept";
}

/// The right to read a file is enough to lock it.
TEST_F(HostileStore, ALockedManifestKeepsNobodyWaiting) {
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "manifests")) {
    const files::Descriptor held(::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC));
    ASSERT_EQ(::flock(held.number(), LOCK_EX), 0);
    EXPECT_GT(Store::open(folder_.path())->info().triangles, 0U);
  }
}

/// Reads of part files wait until they are let go.
class SlowParts : public store::StoreBytes {
 public:
  explicit SlowParts(const std::filesystem::path& folder) : files_(store::files_of(folder)) {}
  std::promise<void> begun, go;
  std::vector<std::byte> whole(const std::string& file, std::uint64_t limit) override {
    return files_->whole(file, limit);
  }
  const char* read(const std::string& file, std::uint64_t offset, std::span<std::byte> out,
                   const std::stop_token& /*stop*/) override {
    if (file.starts_with("parts/") && offset == 0) {
      begun.set_value();
      go.get_future().wait();
    }
    return files_->read(file, offset, out);
  }

 private:
  std::shared_ptr<store::StoreBytes> files_;
};

TEST_F(HostileStore, APartThatTakesLongHoldsNothingElseUp) {
  const auto bytes = std::make_shared<SlowParts>(folder_.path());
  const auto opened = store::open_store(bytes, "slow");
  TriangleId some = 0;
  opened->for_each_triangle(opened->info().bounds, [&](auto, auto ids) { some = ids[0]; });
  auto name = std::async(std::launch::async, [&] { return opened->source(some).object; });
  bytes->begun.get_future().wait();
  auto other = std::async(std::launch::async, [&] { return opened->scene_triangle(some); });
  EXPECT_EQ(other.wait_for(std::chrono::seconds(20)), std::future_status::ready);
  bytes->go.set_value();
  EXPECT_EQ(name.get(), "square");
}

std::stop_token ended() {
  std::stop_source source;
  source.request_stop();
  return source.get_token();
}

TEST_F(HostileStore, UnpackingAPartCanBeEnded) {
  const auto opened = Store::open(folder_.path());
  TriangleId some = 0;
  opened->for_each_triangle(opened->info().bounds, [&](auto, auto ids) { some = ids[0]; });
  EXPECT_THROW(static_cast<void>(store::find_source(opened->state(), some, ended())), Cancelled);
  EXPECT_EQ(store::find_source(opened->state(), some, {}).object, "square");
  // Now it is known.
  EXPECT_EQ(store::find_source(opened->state(), some, ended()).object, "square");
}

TEST_F(HostileStore, HashingTheRestOfAPartCanBeEnded) {
  const auto opened = Store::open(folder_.path());
  const Store::State& s = opened->state();
  EXPECT_THROW(static_cast<void>(store::PartBytes(s, s.manifest.parts[0], ended()).is_whole()), Cancelled);
  EXPECT_TRUE(store::PartBytes(s, s.manifest.parts[0]).is_whole());
}

TEST(Recent, CountsMoreThanTheNumbersOfATile) {
  Mesh mesh;
  constexpr std::uint32_t count = 10'000;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = 2.0 * (i % 200), y = 2.0 * (i / 200);
    mesh.vertices.insert(mesh.vertices.end(), {{x, y, 0.0}, {x + 1.0, y, 0.0}, {x, y + 1.0, 0.0}});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const made::Folder folder("recent");
  const auto opened = made::store(folder.path(), {&mesh, 1}, {.page_tiles = 1000, .tile_triangles = 1});
  ASSERT_EQ(opened->info().tiles, count);
  std::vector<TriangleId> all;
  opened->for_each_triangle(opened->info().bounds, [&](auto, auto ids) { all.push_back(ids[0]); });
  const std::size_t before = ::mallinfo2().uordblks;
  std::size_t most = 0;
  for (const TriangleId id : all) {
    static_cast<void>(opened->scene_triangle(id));
    most = std::max(most, ::mallinfo2().uordblks);
  }
  EXPECT_LT(most, before + (std::size_t{9} << 17)) << "1 MiB, and what reads one tile";
}

TEST_F(HostileStore, AManifestIsRefusedBeforeItTakesMemory) {
  const std::string good = store::to_text(manifest());
  const std::size_t notes = good.find("\"notes\": [") + 10;
  const auto with_notes = [&](const std::string& text) { return std::string(good).insert(notes, text); };
  std::string many_notes = "\"\"", many_parts, deep_members;
  for (int i = 0; i < 12'000'000; ++i) many_notes += ",\"\"";
  for (int i = 0; i < 2'000'000; ++i) many_parts += "{\"name\":\"\"},";
  const std::size_t parts = good.find("\"parts\": [") + 10;
  const struct {
    std::string what, text, said;
  } cases[] = {{"lists in lists", "{\"x\": " + std::string(50'000'000, '['), "deeper"},
               {"lists in lists where a note should be", with_notes(std::string(40'000'000, '[')), "notes"},
               {"many notes", with_notes(many_notes), "memory"},
               {"many parts", std::string(good).insert(parts, many_parts), "part"},
               {"a long text", with_notes("\"" + std::string(50'000'000, 'x') + "\""), "longer"},
               {"more than may be read", std::string(300'000'000, ' ') + good, "memory"},
               {"a key like a path", "{\"shards/*/pages/*/offset\": 1}", ""},
               {"a list with the names of its elements", "{\"shards\": {\"*\": {\"pages\": 1}}}", ""}};
  for (const auto& c : cases) {
    publish(c.text);
    const Cost cost = cost_of([&] { static_cast<void>(Store::open(folder_.path())); });
    EXPECT_LT(cost.mebibytes, (Store::usual_memory >> 20) + 64) << c.what;
    EXPECT_NE(cost.said, "") << c.what;
    EXPECT_NE(cost.said.find(c.said), std::string::npos) << c.what << ": " << cost.said;
    // Where less may be taken, less is.
    const Cost small = cost_of([&] { static_cast<void>(Store::open(folder_.path(), 4 << 20)); });
    EXPECT_LT(small.mebibytes, 16U) << c.what;
    EXPECT_NE(small.said, "") << c.what;
  }
}

TEST_F(HostileStore, OptionsOfManyOrDeepListsAreRefusedInLittleMemory) {
  const std::string deep = "{\"allow\":" + std::string(120'000, '[') + std::string(120'000, ']') + "}";
  std::string many = "{\"allow\":[{}";
  for (int i = 0; i < 340'000; ++i) many += ",{}";
  for (const std::string& text : {deep, many + "]}"}) {
    // The depth alone, too, in a text that is short enough.
    for (const std::string& options : {text, text.substr(0, store::longest_options)}) {
      ImportOptions import;
      const Cost reading = cost_of([&] { store::read_as(options, import); });
      EXPECT_LT(reading.mebibytes, 8U);
      EXPECT_NE(reading.said.find("does not know"), std::string::npos) << reading.said;
      EXPECT_LT(reading.said.size(), 2000U);
    }
    store::Manifest m = manifest();
    m.options = text;
    const std::string written = store::to_text(m);
    const Cost cost = cost_of([&] { static_cast<void>(store::parse_manifest(written, "m")); });
    EXPECT_LT(cost.mebibytes, 8U);
    EXPECT_NE(cost.said.find("'options' of the manifest"), std::string::npos) << cost.said;
  }
  // Those of an import are read back.
  ImportOptions import, read;
  import.up = UpAxis::y;
  import.unit = LengthUnit::ft;
  import.ignore = {"a*", "\"b\""};
  store::read_as(store::text_of(import), read);
  EXPECT_EQ(store::text_of(read), store::text_of(import));
}

TEST_F(HostileStore, SizesThatCannotBeAreRefusedBeforeAnythingIsAllocated) {
  const auto refused = [&](const std::function<void(store::Manifest&)>& spoil) {
    store::Manifest m = manifest();
    spoil(m);
    const Cost cost = cost_of([&] { static_cast<void>(store::parse_manifest(store::to_text(m), "m")); });
    EXPECT_LT(cost.mebibytes, 16U);
    return cost.said;
  };
  EXPECT_EQ(refused([](store::Manifest&) {}), "");
  EXPECT_NE(refused([](store::Manifest& m) {
              m.shards[0].bytes = 1ULL << 40;
              m.shards[0].pages[0].bytes = UINT32_MAX;
            }).find("'bytes' of a page"),
            std::string::npos);
  // Sums that wrap would agree.
  EXPECT_NE(refused([](store::Manifest& m) {
              m.parts.push_back(m.parts[0]);
              m.parts[0].triangles = UINT64_MAX;
              m.parts[1].triangles = m.shards[0].triangles + 1;
            }),
            "");
  EXPECT_NE(refused([](store::Manifest& m) {
              m.parts[0].triangles = m.shards[0].triangles = m.shards[0].tiles * 16384 + 1;
            }).find("'triangles' of a shard"),
            std::string::npos);
}

TEST_F(HostileStore, ATileOfMoreBytesThanATileMayHaveIsRefusedWithItsPage) {
  const store::Manifest m = manifest();
  const store::PageRef& ref = m.shards[0].pages[0];
  std::vector<std::byte> bytes(ref.bytes);
  ASSERT_EQ(store::files_of(folder_.path())->read(store::pack_file(m.shards[0].pack), ref.offset, bytes), nullptr);
  const auto view_of = [&](std::uint32_t tile, std::uint32_t numbers) {
    auto spoiled = bytes;
    store::TileEntry entry{};
    std::byte* const at = spoiled.data() + spoiled.size() - sizeof entry;
    std::memcpy(&entry, at, sizeof entry);
    entry.bytes += tile;
    entry.number_bytes += numbers;
    std::memcpy(at, &entry, sizeof entry);
    const auto memory = std::make_unique<index::Block[]>(spoiled.size() / sizeof(index::Block) + 1);
    std::memcpy(memory.get(), spoiled.data(), spoiled.size());
    store::PageView view;
    const char* const problem =
        store::view_page({reinterpret_cast<const std::byte*>(memory.get()), spoiled.size()}, 1ULL << 40, view);
    return std::string(problem != nullptr ? problem : "");
  };
  EXPECT_EQ(view_of(0, 0), "");
  EXPECT_NE(view_of(1U << 30, 0).find("more bytes than a tile"), std::string::npos);
  EXPECT_NE(view_of(0, 1U << 30).find("more bytes than a tile"), std::string::npos);
}

}  // namespace
