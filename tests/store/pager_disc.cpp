// A support disc over a store of which tiles are missing: where it is carried it is so in the whole scene, or the step
// says that it met what is not known.

#include <gtest/gtest.h>

#include <set>

#include "motion/state.h"
#include "motion/support.h"
#include "pager_made.h"
#include "store/opened.h"
#include "support_scenes.h"

namespace {

using namespace scenes;
using roam::Carrying;
using roam::Pager;

/// The files of a store, of which some tiles cannot be read.
class SomeGone : public roam::store::StoreBytes {
 public:
  SomeGone(const std::filesystem::path& folder, std::uint64_t seed)
      : files_(roam::store::files_of(folder)), seed_(seed) {}
  std::vector<std::byte> whole(const std::string& file, std::uint64_t limit) override {
    return files_->whole(file, limit);
  }
  const char* read(const std::string& file, std::uint64_t offset, std::span<std::byte> out,
                   const std::stop_token& /*stop*/) override {
    const std::uint64_t chance = ((offset + seed_) * 0x9E3779B97F4A7C15ULL) >> 40;
    if (!pages.contains(offset) && chance % 5 == 0) return "the disk reports an input/output error";
    return files_->read(file, offset, out);
  }
  std::set<std::uint64_t> pages;  ///< that can

 private:
  std::shared_ptr<roam::store::StoreBytes> files_;
  std::uint64_t seed_;
};

/// Floors of 3 m in small triangles with splits of 0.7 m between them, and a bottom.
Mesh slabs() {
  Mesh m;
  for (int slab = 0; slab < 8; ++slab) {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 24; ++j) {
        const double x = 3.7 * slab + 0.5 * i, y = 0.5 * j;
        add_floor(m, x, y, x + 0.5, y + 0.5, 0.0);
      }
    }
  }
  add_floor(m, -2.0, -2.0, 32.0, 14.0, -6.0);
  return m;
}

TEST(PagerDisc, IsCarriedByTheSceneOrSaysThatItMetTheUnknown) {
  const Mesh mesh = slabs();
  const roam::World whole = build(mesh);
  int carried = 0, told = 0, walks = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const made::Folder folder("pager_disc");
    made::store(folder.path(), {&mesh, 1}, {.page_tiles = 8, .tile_triangles = 24});
    const auto bytes = std::make_shared<SomeGone>(folder.path(), seed);
    const auto store = roam::store::open_store(bytes, "slabs");
    for (const auto& page : store->state().pages) bytes->pages.insert(page.ref.offset);
    Pager pager(store, {.memory = 64 << 20, .loaders = 2});
    ASSERT_TRUE(made::update_until(pager, {0.3, 0.6}, Vec3(15.0, 6.0, 1.0), [&] {
      const auto s = pager.stats();
      return s.failed > 0 && s.tiles + s.failed == store->info().tiles;
    }));
    for (const double y : {2.3, 5.1, 9.7}) {
      ++walks;
      Walker w(pager, person(0.37), Mode::walk, {1.3, y, 0.92});
      double lowest = 0.0;
      for (int i = 0; i < 1500 && w.position().x < 28.0; ++i) {
        const StepReport& r = w.step({{1.4, 0.0, 0.0}}, frame);
        lowest = std::min(lowest, w.feet().z);
        if (!r.bridging) continue;
        ++carried;
        if (r.met_unknown) {
          ++told;
          continue;
        }
        roam::walking::DiscFound none;
        EXPECT_EQ(roam::walking::carrying(whole, w.settings(), w.skin(), w.body().height(), w.state().floor().value(),
                                          w.position(), none),
                  Carrying::yes)
            << "seed " << seed << " at " << w.position().x << " " << w.position().y;
      }
      EXPECT_GT(lowest, -0.3) << "nobody falls where the whole scene carries: " << seed << " " << y;
    }
  }
  EXPECT_GT(carried, 50 * walks);
  EXPECT_GT(told, 100);
  EXPECT_LT(told, carried - 100);
}

}  // namespace
