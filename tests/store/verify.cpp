// What verify_store finds where every hash is right and the manifest still does not say what is there.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <utility>

#include "store_made.h"

namespace {

using namespace roam;

/// A store of a bumpy square, its manifest spoiled and published again: what is wrong with it.
std::vector<StoreDamage> damage_after(const std::function<void(store::Manifest&)>& spoil) {
  const made::Folder folder("verify");
  Mesh mesh;
  for (std::uint32_t i = 0; i < 900; ++i) mesh.vertices.emplace_back(i % 30, i / 30, (i * 7919U) % 5);
  for (std::uint32_t i = 0; i + 31 < 900; ++i) mesh.triangles.push_back({i, i + 1, i + 30});
  made::Maker(folder.path(), {&mesh, 1}, {.page_tiles = 2, .tile_triangles = 100}).run();
  store::Manifest manifest = store::read_manifest(*store::files_of(folder.path()), "s");
  spoil(manifest);
  store::publish(folder.path(), manifest);
  return verify_store(folder.path()).damage;
}

/// Makes a store of one square.
void make_store(const std::filesystem::path& folder) {
  const Mesh mesh{"", {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  made::Maker(folder, {&mesh, 1}, {}).run();
}

TEST(MadeFolder, IsOfItsOwn) {
  const made::Folder one("verify"), other("verify");
  EXPECT_NE(one.path(), other.path());
}

TEST(VerifyStore, ReadsTheStoreThatItOpenedWhateverTakesItsPlace) {
  const made::Folder folder("verify_replaced");
  const std::filesystem::path place = folder.path() / "s", aside = folder.path() / "aside";
  make_store(place);
  bool replaced = false;
  const StoreVerification found = verify_store(place, [&](std::uint64_t, std::uint64_t) {
    if (!std::exchange(replaced, true)) {
      std::filesystem::rename(place, aside);
      std::filesystem::create_directory(place);
    }
    return true;
  });
  EXPECT_TRUE(replaced);
  EXPECT_TRUE(found.whole()) << (found.damage.empty() ? "" : found.damage[0].what + ": " + found.damage[0].why);
  EXPECT_EQ(found.tiles, 1U);
}

TEST(VerifyStore, ComparesWhatTheManifestSaysWithWhatIsThere) {
  EXPECT_TRUE(damage_after([](store::Manifest&) {}).empty());
  EXPECT_FALSE(damage_after([](store::Manifest& m) { m.geometry_hash ^= 1; }).empty());
  EXPECT_FALSE(damage_after([](store::Manifest& m) { m.shards[0].largest_error *= 0.5; }).empty());
  EXPECT_FALSE(damage_after([](store::Manifest& m) { m.bounds.upper.x += 1.0; }).empty());
  const auto found = damage_after([](store::Manifest& m) { m.shards[0].pages[1].box.upper.z -= 1.0; });
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].what.substr(0, 7), "page 1 ");
  EXPECT_FALSE(found[0].where.empty());
}

/// Else the time would grow with names, which cost nothing, instead of with bytes.
TEST(VerifyStore, DecodesAPackOnceWhateverNamesItHas) {
  const made::Folder folder("verify_names");
  make_store(folder.path());
  store::Manifest m = store::read_manifest(*store::files_of(folder.path()), "s");
  const store::ShardInfo shard = m.shards[0];
  const std::uint64_t hash = m.geometry_hash;
  for (const char digit : {'1', '2', '3'}) {
    m.shards.push_back(shard);
    m.shards.back().pack = std::string(64, digit);
    std::filesystem::create_hard_link(folder.path() / store::pack_file(shard.pack),
                                      folder.path() / store::pack_file(m.shards.back().pack));
    m.parts[0].triangles += shard.triangles;
    m.geometry_hash += hash;
  }
  store::publish(folder.path(), m);
  const StoreVerification found = verify_store(folder.path());
  EXPECT_EQ(found.tiles, 1U);
  EXPECT_GE(found.damage.size(), 3U);
  // A pack whose name is wrong is decoded once, too: that shows which of its tiles are usable.
  std::filesystem::remove(folder.path() / store::pack_file(shard.pack));
  m.shards.erase(m.shards.begin());
  m.parts[0].triangles -= shard.triangles;
  store::publish(folder.path(), m);
  EXPECT_EQ(verify_store(folder.path()).tiles, 1U);
}

}  // namespace
