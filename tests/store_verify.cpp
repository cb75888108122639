// What verify_store finds where every hash is right and the manifest still does not say what is there.
#include <gtest/gtest.h>

#include <functional>

#include "store/made.h"

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

}  // namespace
