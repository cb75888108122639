// What cannot be read is solid and named, the rest goes on, and everything comes in the end.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <future>
#include <glm/geometric.hpp>
#include <numbers>

#include "changing_room.h"
#include "clutter.h"
#include "pager_made.h"
#include "roam/route.h"
#include "store/opened.h"
#include "store/tile_reader.h"
#include "walker_judged.h"

namespace {

using namespace scenes;
using roam::Body;
using roam::Pager;

/// A floor of tiles with boxes on it, 60 m by 60 m.
Mesh yard_mesh(std::uint64_t seed) {
  Random random(seed);
  Mesh m;
  m.name = "yard";
  for (int i = 0; i < 60; ++i) {
    for (int j = 0; j < 60; ++j) add_floor(m, i, j, i + 1.0, j + 1.0, 0.0);
  }
  for (int i = 0; i < 500; ++i) {
    const Vec3 at(random.between(1.0, 59.0), random.between(1.0, 59.0), 0.0);
    add_box(m, at, at + Vec3(random.between(0.1, 1.0), random.between(0.1, 1.0), random.between(0.2, 3.0)));
  }
  return m;
}

struct Yard {
  explicit Yard(const char* name, std::uint64_t seed = 1) : folder(name), mesh(yard_mesh(seed)), judge(mesh) {
    made::store(folder.path(), {&mesh, 1}, {.page_tiles = 8, .tile_triangles = 100});
    bytes = std::make_shared<made::TroubledBytes>(folder.path());
    store = roam::store::open_store(bytes, "yard");
  }
  made::Folder folder;
  Mesh mesh;
  Judge judge;
  std::shared_ptr<made::TroubledBytes> bytes;
  std::shared_ptr<const roam::Store> store;
};

constexpr Vec3 middle(30.5, 30.5, 1.5);

/// Walks about in all directions; every step is judged by all triangles.
void wander(Yard& yard, Pager& pager, Mode mode, double speed, int steps, std::uint64_t seed, double& length) {
  Random random(seed);
  ASSERT_TRUE(made::update_until(pager, {0.3, 0.6}, middle, [&] {
    return !pager.clearance({0.3, 0.6}, middle, 1.0).unknown;
  }));
  Walker w(pager, {}, mode, middle);
  double heading = 0.0;
  Vec3 before = w.position();
  for (int i = 0; i < steps; ++i) {
    if (w.report().blocked || random.chance(0.02)) heading = random.between(0.0, 6.28);
    const Vec3 p = w.position();
    if (p.x < 5.0 || p.y < 5.0 || p.x > 55.0 || p.y > 55.0) heading = std::atan2(30.0 - p.y, 30.0 - p.x);
    w.step({.velocity = {speed * std::cos(heading), speed * std::sin(heading), mode == Mode::fly ? 1.2 - p.z : 0.0}},
           frame);
    if (!w.report().held) {
      ASSERT_GE(margin(yard.judge, w.report(), w.settings().radius), 0.0) << i;
    }
    length += glm::length(w.position() - before);
    before = w.position();
    (void)pager.update(w.body(), w.position(), w.velocity());
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
}

TEST(PagerFailures, RefusesToPageNothingAndNamesNoMiss) {
  EXPECT_THROW(Pager(nullptr), roam::Error);
  Yard yard("unnamed");
  const Pager pager(yard.store);
  EXPECT_EQ(pager.object_name(roam::no_triangle), "");
}

TEST(PagerFailures, WithReadsThatNeverEndTheBodyIsHeldAndNothingWaits) {
  Yard yard("pager_hold");
  yard.bytes->hold();
  auto pager = std::make_unique<Pager>(yard.store);
  const Body body{0.3, 0.6};
  ASSERT_TRUE(made::update_until(*pager, body, middle, [&] { return yard.bytes->waiting() > 0; }));
  EXPECT_FALSE(pager->wait(body, middle, Vec3(0.0), 0.05));
  Walker w(*pager, {}, Mode::walk, middle);
  EXPECT_TRUE(w.held() && w.report().met_unknown);
  for (int i = 0; i < 100; ++i) {
    (void)pager->update(w.body(), w.position(), w.velocity());
    w.step({.velocity = {1.4, 0.0, 0.0}}, frame);
    EXPECT_EQ(w.position(), middle);
  }
  EXPECT_LT(pager->facts().speed_limit, 1.0);
  EXPECT_EQ(pager->stats().tiles, 0u);
  // Ending it waits for the read that is under way, and for no more.
  std::future<void> ended = std::async(std::launch::async, [&] { pager.reset(); });
  EXPECT_EQ(ended.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  yard.bytes->let_go();
  EXPECT_EQ(ended.wait_for(std::chrono::seconds(30)), std::future_status::ready);
}

TEST(PagerFailures, WaitingForNoTimeAheadWaitsForWhatTheBodyIsIn) {
  const Yard yard("wait");
  yard.bytes->hold();
  Pager pager(yard.store);
  const Body body{0.3, 0.0};
  const Vec3 place(30.0, 30.0, 0.4);
  EXPECT_FALSE(pager.wait(body, place, Vec3(0.0), 0.02, 0.0));
  yard.bytes->let_go();
  EXPECT_TRUE(pager.wait(body, place, Vec3(0.0), 60.0, 0.0));
  EXPECT_FALSE(pager.clearance(body, place, 1e-3).unknown);
}

TEST(PagerFailures, ABodyThatHasWaitedIsNotSlowedByTheLatency) {
  const Yard yard("pager_waited");
  yard.bytes->delay_us = 60'000;
  Pager pager(yard.store);
  const Body body{0.3, 0.6};
  ASSERT_TRUE(pager.wait(body, middle, Vec3(0.0), 60.0));
  const double limit = pager.facts().speed_limit;
  EXPECT_GT(limit, 50.0);
  (void)pager.update(body, middle, Vec3(0.0));
  EXPECT_LT(pager.facts().speed_limit, 0.5 * limit);
}

TEST(PagerFailures, ABodyThatWasHeldGoesOnWhenItsSurroundingsCome) {
  Yard yard("pager_release");
  yard.bytes->hold();
  Pager pager(yard.store);
  Walker w(pager, {}, Mode::walk, middle);
  (void)pager.update(w.body(), w.position(), w.velocity());
  EXPECT_TRUE(w.held());
  yard.bytes->let_go();
  EXPECT_TRUE(pager.wait(w.body(), w.position(), Vec3(0.0), 30.0));
  w.step({}, frame);
  EXPECT_FALSE(w.held());
  EXPECT_GE(margin(yard.judge, w.report(), w.settings().radius), 0.0);
}

TEST(PagerFailures, WhatFailsIsTriedAgainUntilItComes) {
  Yard yard("pager_retry");
  yard.bytes->errors = 300;
  yard.bytes->short_reads = 150;
  yard.bytes->flips = 150;
  Pager pager(yard.store, {.loaders = 3});
  ASSERT_NO_FATAL_FAILURE(made::load_all(pager));
  const auto stats = pager.stats();
  EXPECT_GT(stats.failures, 20u);
  EXPECT_EQ(stats.failed, 0u);
  EXPECT_FALSE(stats.last_failure.empty());
  EXPECT_EQ(pager.clearance({0.3, 0.0}, middle, 1.0).unknown, false);
}

TEST(PagerFailures, WhatNeverComesIsSolidAndNamedAndTheRestGoesOn) {
  Yard yard("pager_named");
  for (const auto& page : yard.store->state().pages) yard.bytes->spared.insert(page.ref.offset);
  yard.bytes->errors = 500;
  Pager pager(yard.store, {.memory = Pager::least_memory});
  ASSERT_TRUE(made::update_until(pager, {0.3, 0.0}, middle, [&] {
    if (pager.stats().tiles >= 20) yard.bytes->errors = 1000;
    return yard.bytes->errors == 1000;
  }));
  ASSERT_TRUE(made::update_until(pager, {0.3, 0.0}, middle, [&] {
    const auto s = pager.stats();
    return s.tiles + s.failed == yard.store->info().tiles;
  }));
  EXPECT_NE(pager.stats().last_failure.find("input/output"), std::string::npos) << pager.stats().last_failure;
  // What failed holds nobody up and is no reason to go slowly.
  EXPECT_TRUE(pager.wait({0.3, 0.0}, middle, Vec3(0.0), 5.0, 10.0));
  Random random(3);
  bool told = false;
  for (int i = 0; i < 200 && !told; ++i) {
    const Vec3 from(random.between(0.0, 60.0), random.between(0.0, 60.0), 10.0);
    const auto hit = pager.sweep({0.3, 0.0}, from, {0.0, 0.0, -20.0});
    if (!hit.hit || !hit.unknown) continue;
    std::string why;
    told = made::update_until(pager, {0.3, 0.0}, middle, [&] {
      why = pager.object_name(hit.triangle);
      return why.find("input/output") != std::string::npos;
    });
  }
  EXPECT_TRUE(told);
  yard.bytes->errors = 0;
  ASSERT_NO_FATAL_FAILURE(made::load_all(pager));
}

TEST(PagerFailures, ARouteIntoWhatDoesNotComeIsHeldByItNotBlocked) {
  const Yard yard("pager_route");
  const Body body{0.3, 0.6};
  // A way that no box bars.
  const World whole = build(yard.mesh);
  Random random(5);
  std::array<Vec3, 2> path{};
  do {
    path[0] = {random.between(10.0, 50.0), random.between(10.0, 50.0), 1.0};
    const double heading = random.between(0.0, 2.0 * std::numbers::pi);
    path[1] = path[0] + 10.0 * Vec3(std::cos(heading), std::sin(heading), 0.0);
  } while (whole.sweep({0.35, body.half_height}, path[0], path[1] - path[0]).hit);
  // What lies about its start can be read, and nothing farther off.
  roam::store::TileReader reader(yard.store->state());
  for (std::uint64_t p = 0; p < yard.store->state().pages.size(); ++p) {
    yard.bytes->spared.insert(yard.store->state().pages[p].ref.offset);
    for (const auto& tile : reader.page(p).view.tiles) {
      if (roam::store::box_of(tile).grown(1.0).holds(path[0])) yard.bytes->spared.insert(tile.offset);
    }
  }
  yard.bytes->errors = 1000;
  Pager pager(yard.store);
  ASSERT_TRUE(made::update_until(pager, body, path[0], [&] { return !pager.clearance(body, path[0], 0.3).unknown; }));
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    Walker w(pager, {.radius = body.radius, .height = body.height()}, mode, path[0]);
    roam::Route route(w, path, {.speed = 5.0});
    while (!route.done()) {
      route.advance();
      (void)pager.update(w.body(), w.position(), w.velocity());
    }
    EXPECT_EQ(route.result().outcome, roam::Outcome::held);
    EXPECT_LT(route.result().length, 9.0);
    ASSERT_TRUE(route.result().blocked_at);
    EXPECT_FALSE(route.result().blocked_at->opening);
    std::string why;
    EXPECT_TRUE(made::update_until(pager, body, w.position(), [&] {
      why = pager.object_name(route.result().blocked_at->triangle);
      return why.find("input/output") != std::string::npos;
    })) << why;
  }
}

TEST(PagerFailures, ARouteThatUpdatesItsPagerComesToItsEndAndOneThatDoesNotIsHeld) {
  const std::vector<Vec3> path{{5.0, 5.0, 3.5}, {55.0, 55.0, 3.5}};  // over all boxes
  for (const bool live : {false, true}) {
    Yard yard("pager_live");
    Pager pager(yard.store);
    Walker w(pager, ball(0.3), Mode::fly, path[0]);
    const roam::RouteOptions options{.speed = 20.0, .wait = 60.0};
    const roam::RouteResult r = live ? roam::follow(w, pager, path, options) : roam::follow(w, path, options);
    EXPECT_EQ(r.outcome, live ? roam::Outcome::reached : roam::Outcome::held);
  }
}

TEST(PagerFailures, ARouteThatASpaceSlowsDownToNothingIsHeldAndBehindAWallBlocked) {
  Mesh mesh;
  add_floor(mesh, -10.0, -10.0, 10.0, 10.0, 0.0);
  for (const bool wall : {false, true}) {
    if (wall) add_wall(mesh, 1.0, -10.0, 1.0, 10.0, 0.0, 3.0);
    ChangingRoom room(mesh, true);
    for (const Mode mode : {Mode::walk, Mode::fly}) {
      room.limit = 5.0;
      Walker w(room, {}, mode, {0.0, 0.0, 0.95});
      const std::array<Vec3, 2> path{Vec3(0.0, 0.0, 0.95), Vec3(5.0, 0.0, 0.95)};
      roam::Route route(w, path, {.speed = 3.0});
      for (int i = 0; i < 40; ++i) route.advance();
      room.limit = 0.01;
      while (!route.done()) route.advance();
      EXPECT_EQ(route.result().outcome, wall ? roam::Outcome::blocked : roam::Outcome::held);
      EXPECT_EQ(route.result().blocked_at.has_value(), wall);
    }
  }
}

TEST(PagerFailures, NobodyPassesAWallWhateverIsReadAndWhen) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    for (const Mode mode : {Mode::walk, Mode::fly}) {
      Yard yard("pager_trouble", seed);
      yard.bytes->errors = 200;
      yard.bytes->short_reads = 100;
      yard.bytes->flips = 100;
      yard.bytes->delay_us = seed == 1 ? 0 : 500;
      Pager pager(yard.store, {.memory = Pager::least_memory, .loaders = static_cast<int>(seed)});
      double length = 0.0;
      wander(yard, pager, mode, seed == 3 ? 50.0 : 1.4, 1500, seed, length);
      if (HasFatalFailure()) return;
      EXPECT_GT(length, 5.0);
    }
  }
}

TEST(PagerFailures, AStoreThatIsReplacedIsReadToItsEnd) {
  Yard yard("pager_replaced");
  Pager before(yard.store);
  const Mesh other = yard_mesh(77);
  made::store(yard.folder.path(), {&other, 1}, {.page_tiles = 8, .tile_triangles = 100});
  const auto replaced = roam::Store::open(yard.folder.path());
  Pager after(replaced);
  ASSERT_NO_FATAL_FAILURE(made::load_all(before));
  ASSERT_NO_FATAL_FAILURE(made::load_all(after));
  const roam::World first = build(yard.mesh), second = build(other);
  // The tiles are smaller than the worlds', and an edge that is a little elsewhere is met earlier or later by more.
  constexpr double stored_otherwise = 2e-3;
  long differ = 0;
  Random random(9);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 from(random.between(0.0, 60.0), random.between(0.0, 60.0), 5.0), down(0.0, 0.0, -10.0);
    const double one = first.sweep({0.2, 0.0}, from, down).time, other_one = second.sweep({0.2, 0.0}, from, down).time;
    ASSERT_NEAR(before.sweep({0.2, 0.0}, from, down).time, one, stored_otherwise);
    ASSERT_NEAR(after.sweep({0.2, 0.0}, from, down).time, other_one, stored_otherwise);
    differ += std::abs(one - other_one) > stored_otherwise ? 1 : 0;
  }
  EXPECT_GT(differ, 100);
}

TEST(PagerFailures, SeveralPagersReadOneStore) {
  Yard yard("pager_several");
  std::vector<std::unique_ptr<Pager>> pagers;
  for (int i = 0; i < 4; ++i) pagers.push_back(std::make_unique<Pager>(yard.store, roam::PagerOptions{.loaders = 2}));
  std::vector<std::future<double>> lengths;
  for (int i = 0; i < 4; ++i) {
    lengths.push_back(std::async(std::launch::async, [&, i] {
      double length = 0.0;
      wander(yard, *pagers[static_cast<std::size_t>(i)], Mode::walk, 5.0, 300, 20 + static_cast<std::uint64_t>(i),
             length);
      return length;
    }));
  }
  for (auto& l : lengths) EXPECT_GT(l.get(), 1.0);
}

}  // namespace
