// Work that is not done in real time waits for tiles: its results are those of a store that is all there.
#include "scenes/arrivals.h"

#include <gtest/gtest.h>

#include <cstring>

#include "clutter.h"
#include "pager_made.h"
#include "roam/route.h"
#include "roam/walker.h"
#include "store/read_ahead.h"
#include "store/web/server.h"
#include "walker_judged.h"

namespace {

using namespace scenes;
using roam::Body;
using roam::Pager;
using roam::app::TilesAround;

/// A floor with boxes, 60 m long, as a store.
struct Alley {
  explicit Alley(const char* name) : folder(name) {
    Random random(3);
    mesh.name = "alley";
    for (int i = 0; i < 60; ++i) {
      for (int j = 0; j < 6; ++j) add_floor(mesh, i, j, i + 1.0, j + 1.0, 0.0);
      const Vec3 at(i + 0.2, random.between(0.0, 1.5) + (i % 2 == 0 ? 4.0 : 0.0), 0.0);
      add_box(mesh, at, at + Vec3(0.5, 0.5, random.between(0.1, 2.0)));
    }
    made::store(folder.path(), {&mesh, 1}, {.page_tiles = 8, .tile_triangles = 40});
    bytes = std::make_shared<made::TroubledBytes>(folder.path());
  }
  made::Folder folder;
  Mesh mesh;
  std::shared_ptr<made::TroubledBytes> bytes;
};

const Body person = Body::capsule(0.3, 1.8);
constexpr Vec3 begin(1.0, 3.0, 0.95);
const auto always = [] { return true; };

/// All places and gaps of a walk through the alley, as bytes.
std::string walked(const std::shared_ptr<roam::store::StoreBytes>& bytes, int loaders, const char* name = "alley") {
  constexpr double speed = 20.0, reach = 10.0;
  Pager pager(roam::store::open_store(bytes, name), {.memory = 16 << 20, .loaders = loaders});
  TilesAround tiles(pager, always);
  tiles.wait(person, begin, Vec3(0.0), reach);
  Walker walker(pager, {}, Mode::walk, begin);
  roam::Route route(walker, std::vector<Vec3>{begin, {55.0, 3.0, 0.95}}, {.speed = speed});
  std::string all;
  while (!route.done()) {
    const roam::StepReport& report = route.advance();
    const Vec3 at = report.to;
    const double gap = pager.clearance(walker.body(), at, 5.0).distance;
    all.append(reinterpret_cast<const char*>(&at), sizeof at).append(reinterpret_cast<const char*>(&gap), sizeof gap);
    tiles.wait(walker.body(), at, walker.velocity(), reach);
  }
  EXPECT_EQ(route.result().outcome, roam::Outcome::reached);
  return all;
}

TEST(TilesAround, AreWaitedForHoweverSlowTheReads) {
  const Alley alley("around_slow");
  const std::string right = walked(alley.bytes, 1);
  alley.bytes->delay_us = 30'000;
  EXPECT_EQ(walked(alley.bytes, 4), right);
}

TEST(TilesAround, ThatAWebServerFailsToSendAreWaitedFor) {
  const Alley alley("around_failing");
  const std::string right = walked(alley.bytes, 1);
  alley.bytes->errors = 300;
  alley.bytes->reason = "the connection to the web server broke";
  EXPECT_EQ(walked(alley.bytes, 4, "http://alley"), right);
}

TEST(TilesAround, ThatAWebServerCannotSendAreNotWaitedFor) {
  for (const char* reason : {roam::web::no_ranges, roam::web::too_short, roam::store::wrong_checksum,
                             "the web server has no such file (status 404 or 410)"}) {
    const Alley alley("around_impossible");
    alley.bytes->errors = 1000;
    alley.bytes->reason = reason;
    Pager pager(roam::store::open_store(alley.bytes, "http://alley"), {.memory = Pager::least_memory});
    int asked = 0;  // every 20 ms
    TilesAround(pager, [&] { return ++asked < 1000; }).wait(person, begin, Vec3(0.0), 5.0);
    EXPECT_LT(asked, 500) << reason;
    EXPECT_NE(pager.stats().last_failure.find(reason), std::string::npos);
  }
}

TEST(TilesAround, ThatMayComeAreWaitedForBesideOthersThatCannot) {
  const Alley alley("around_mixed");
  alley.bytes->lost = 200;
  alley.bytes->reason = "the connection to the web server broke";
  const auto failed = [&](int errors) {
    alley.bytes->errors = errors;
    Pager pager(roam::store::open_store(alley.bytes, "http://alley"), {.memory = Pager::least_memory});
    TilesAround(pager, always).wait(person, begin, Vec3(0.0), 30.0);
    return pager.stats().failed;
  };
  const std::uint64_t right = failed(0);
  EXPECT_GT(right, 0U);
  EXPECT_EQ(failed(300), right);
}

TEST(TilesAround, ThatNeverComeAreGivenUpOnceAndSaidSo) {
  const Alley alley("around_stuck");
  Pager pager(roam::store::open_store(alley.bytes, "alley"), {.memory = Pager::least_memory});
  TilesAround tiles(pager, always, 0.3);
  alley.bytes->hold();
  testing::internal::CaptureStderr();
  tiles.wait(person, begin, Vec3(0.0), 5.0);
  tiles.wait(person, begin, Vec3(0.0), 5.0);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("nothing has come from alley for 0.3 s"), std::string::npos) << said;
  EXPECT_EQ(said.find("nothing"), said.rfind("nothing")) << said;
  EXPECT_FALSE(pager.wait(person, begin, Vec3(0.0), 0.0));
  alley.bytes->let_go();
  tiles.wait(person, begin, Vec3(0.0), 5.0);
  tiles.wait(person, begin, Vec3(0.0), 5.0);
  EXPECT_TRUE(pager.wait(person, begin, Vec3(0.0), 0.0));
}

TEST(TilesAround, ThatNobodyWantsAnyMoreAreNotWaitedFor) {
  const Alley alley("around_unwanted");
  Pager pager(roam::store::open_store(alley.bytes, "alley"), {.memory = Pager::least_memory});
  alley.bytes->hold();
  TilesAround(pager, [] { return false; }).wait(person, begin, Vec3(0.0), 5.0);
  EXPECT_EQ(pager.stats().loads, 0U);
  alley.bytes->let_go();
}

}  // namespace
