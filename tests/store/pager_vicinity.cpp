// Bodies that keep what lies around them in a store of which tiles come and go: what is unknown is met as it is
// without, what is known is answered as well, and what is answered does not depend on when the rest came.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <set>

#include "pager_made.h"
#include "roam/generate.h"
#include "roam/world.h"
#include "vicinity_course.h"

namespace {

using clutter::Random;
using course::Course;
using course::gap_in;
using course::Judged;
using course::same;
using course::sweep_in;
using roam::Body;
using roam::Impact;
using roam::Mesh;
using roam::Pager;
using roam::Vec3;
using roam::Vicinity;

Mesh heap(std::uint64_t seed, int count, double half, const Vec3& centre) {
  Random random(seed);
  return clutter::make(random, {count, half, 0.01, 0.6, centre});
}

void add(Mesh& mesh, const Mesh& more) {
  for (std::size_t i = 0; i < more.triangles.size(); ++i) {
    const roam::Triangle t = more.triangle(i);
    scenes::add_triangle(mesh, t[0], t[1], t[2]);
  }
}

/// Everything is in memory: judged by brute force, over several pages.
void judge(const char* name, const Mesh& mesh, const made::StoreOptions& options, const Course& course) {
  const made::Folder folder(std::string("pager_vicinity_") + name);
  Pager pager(made::store(folder.path(), {&mesh, 1}, options), {.memory = 64 << 20, .loaders = 2});
  ASSERT_NO_FATAL_FAILURE(made::load_all(pager));
  ASSERT_GT(pager.stats().pages, 4u);
  Random random(1);
  long pages = 0;
  for (const bool on_foot : {false, true}) {
    Judged asker(pager, mesh, options.lossless);
    Course c = course;
    c.on_foot = on_foot;
    course::go(random, mesh, c, asker);
    const course::Tally& t = asker.tally;
    EXPECT_GT(t.hits - t.touching, t.sweeps / 50);
    EXPECT_GT(t.near, t.gaps / 20);
    EXPECT_GT(t.kept, t.asked() / 2);
    EXPECT_LT(t.gathered, t.asked() / 4);
    pages += t.pages;
  }
  EXPECT_GT(pages, course.steps / 5);
}

TEST(PagerVicinity, IsAnsweredAsWellOverSeveralPages) {
  judge("pages", heap(1, 60'000, 8.0, Vec3(0.0)), {.page_tiles = 1, .tile_triangles = 2000}, {.steps = 3000});
}
TEST(PagerVicinity, IsAnsweredAsWellInALosslessStoreFarAway) {
  judge("lossless", heap(2, 40'000, 8.0, Vec3(6.4e6, -6.4e6, 6.4e6)),
        {.lossless = true, .page_tiles = 2, .tile_triangles = 2000}, {.steps = 3000});
}

struct Question {
  Body body;
  Vec3 from, motion;
  double reach;
  bool sweep;
};

/// What a course asks in a pager.
std::vector<Question> questions_of(const Pager& pager, const Mesh& mesh, const Course& course, std::uint64_t seed) {
  struct Asker {
    const Pager& pager;
    std::vector<Question> asked{};
    Impact sweep(const Body& body, const Vec3& from, const Vec3& motion) {
      asked.push_back({body, from, motion, 0.0, true});
      return pager.sweep(body, from, motion);
    }
    double gap_bound(const Body& body, const Vec3& from, const Vec3& motion, double reach) {
      asked.push_back({body, from, motion, reach, false});
      return pager.gap_bound(body, from, motion, reach);
    }
  } asker{pager};
  Random random(seed);
  course::go(random, mesh, course, asker);
  return asker.asked;
}

struct Answer {
  Impact impact;
  double gap = 0.0;

  [[nodiscard]] bool is(const Answer& other) const { return same(impact, other.impact) && same(gap, other.gap); }
};
Answer ask_in(const Pager& pager, Vicinity& vicinity, const Question& q) {
  if (q.sweep) return {sweep_in(pager, vicinity, q.body, q.from, q.motion)};
  return {{}, gap_in(pager, vicinity, q.body, q.from, q.motion, q.reach)};
}
Answer ask(const Pager& pager, const Question& q) {
  if (q.sweep) return {pager.sweep(q.body, q.from, q.motion)};
  return {{}, pager.gap_bound(q.body, q.from, q.motion, q.reach)};
}

/// Where all around the body is in memory, its answers are judged as those of a world. Where it is not they are those
/// that are given without, and no later than the truth.
void judge_beside(const Pager& pager, Vicinity& vicinity, const Question& q, const Answer& a,
                  judged::NearJudge& judge) {
  const Answer b = ask(pager, q);
  if (vicinity.state()->complete) {
    ASSERT_FALSE(a.impact.unknown);
    ASSERT_FALSE(b.impact.unknown);
    if (q.sweep) {
      judged::judge_sweep(a.impact, q.body, q.from, q.motion, judged::farthest_off, judge);
    } else {
      judged::judge_gap(a.gap, q.body, q.from, q.motion, q.reach, judge);
    }
    return;
  }
  ASSERT_TRUE(a.is(b));
  const double enough = q.body.radius + q.reach + 0.01;
  if (!q.sweep) {
    const double gap = judge.over(q.body, q.from, q.motion, enough) - q.body.radius;
    ASSERT_LE(a.gap, std::max(gap, 0.0) + judged::nearest_allowed);
  } else if (!a.impact.hit || a.impact.time > 0.0) {
    ASSERT_GE(judge.over(q.body, q.from, a.impact.time * q.motion, enough), q.body.radius - judged::nearest_allowed);
  }
}

/// A heap, a store of it, and its bytes.
struct Stored {
  explicit Stored(const char* name, const Mesh& scene,
                  const made::StoreOptions& options = {.page_tiles = 2, .tile_triangles = 2000})
      : folder(std::string("pager_vicinity_") + name), mesh(scene) {
    made::store(folder.path(), {&mesh, 1}, options);
    bytes = std::make_shared<made::TroubledBytes>(folder.path());
    store = roam::store::open_store(bytes, name);
  }
  made::Folder folder;
  Mesh mesh;
  std::shared_ptr<made::TroubledBytes> bytes;
  std::shared_ptr<const roam::Store> store;
};

/// Reads go on when a test ends, however it does.
struct LetGo {
  made::TroubledBytes& bytes;
  ~LetGo() { bytes.let_go(); }
};

/// The same questions while nothing is there, while some of it is, and when all is: what is unknown is met as without,
/// to the bit, for nothing is kept then.
TEST(PagerVicinity, MeetsWhatIsUnknownAsWithoutAndFollowsWhatComes) {
  Stored all("comes", heap(3, 40'000, 8.0, Vec3(0.0)), {.page_tiles = 2, .tile_triangles = 800});
  Pager known(all.store, {.memory = 64 << 20});
  ASSERT_NO_FATAL_FAILURE(made::load_all(known));
  const std::vector<Question> questions =
      questions_of(known, all.mesh, {.steps = 150, .on_foot = true, .restart_each = 1'000'000, .largest = 0.2}, 7);
  all.bytes->hold();
  all.bytes->delay_us = 1000;
  Pager pager(all.store, {.memory = 64 << 20});
  const LetGo at_the_end{*all.bytes};
  Vicinity vicinity;
  for (const Question& q : questions) {
    const Answer a = ask_in(pager, vicinity, q);
    ASSERT_TRUE(a.is(ask(pager, q)));
    ASSERT_TRUE(!q.sweep || (a.impact.hit && a.impact.unknown && a.impact.time == 0.0));
    ASSERT_TRUE(q.sweep || !(a.gap > 0.0));
  }
  judged::NearJudge judge(all.mesh);
  long unknown = 0, between = 0;
  const auto tiles = all.store->info().tiles;
  for (bool last = false; !last;) {
    // One arrival after another.
    const std::uint64_t before = pager.stats().tiles;
    all.bytes->let_go();
    ASSERT_TRUE(made::update_until(pager, {0.3, 0.0}, questions[0].from, [&] { return pager.stats().tiles > before; }));
    all.bytes->hold();
    last = pager.stats().tiles == tiles;
    between += last ? 0 : 1;
    for (std::size_t i = 0; i < questions.size(); i += last ? 1 : 7) {
      const Answer a = ask_in(pager, vicinity, questions[i]);
      ASSERT_NO_FATAL_FAILURE(judge_beside(pager, vicinity, questions[i], a, judge)) << i;
      unknown += a.impact.unknown ? 1 : 0;
    }
  }
  EXPECT_GT(between, 5);
  EXPECT_GT(unknown, 10);
  EXPECT_TRUE(vicinity.state()->complete);
}

/// A box that reaches into what went is no longer kept, though nothing was asked meanwhile.
TEST(PagerVicinity, ForgetsWhatWent) {
  Mesh mesh = heap(4, 15'000, 4.0, Vec3(0.0));
  add(mesh, heap(5, 500'000, 20.0, Vec3(3000.0, 0.0, 0.0)));
  Stored all("goes", mesh);
  ASSERT_GT(all.store->info().resident_bytes, 10u << 20);
  Pager pager(all.store, {.memory = Pager::least_memory});
  const Body body{0.3, 0.0};
  Random random(6);
  long unknown = 0;
  for (int round = 0; round < 6; ++round) {
    const Vec3 here = random.in_box(3.0);
    Vicinity vicinity;
    ASSERT_TRUE(pager.wait(body, here, Vec3(0.0), 30.0));
    const Question down{{0.05, 0.3}, here, {0.0, 0.0, -0.1}, 0.0, true};
    const Question look{{0.05, 0.3}, here, {0.1, 0.0, 0.0}, 0.2, false};
    const Impact known = ask_in(pager, vicinity, down).impact;
    ASSERT_FALSE(known.unknown);
    ASSERT_TRUE(vicinity.state()->complete);
    // Elsewhere, until what was here has gone.
    const auto gone = [&] {
      const Impact s = pager.sweep(down.body, down.from, down.motion);
      return s.hit && s.unknown;
    };
    for (int i = 0; i < 1000 && !gone(); ++i) {
      const Vec3 there = Vec3(3000.0, 0.0, 0.0) + random.in_box(20.0);
      ASSERT_TRUE(pager.wait(body, there, Vec3(0.0), 30.0));
    }
    ASSERT_TRUE(gone());
    for (const Question& q : {down, look}) {
      ASSERT_TRUE(ask_in(pager, vicinity, q).is(ask(pager, q))) << round;
      ++unknown;
    }
    ASSERT_TRUE(pager.wait(body, here, Vec3(0.0), 30.0));
    ASSERT_TRUE(same(ask_in(pager, vicinity, down).impact, known));
  }
  EXPECT_EQ(unknown, 12);
}

/// On the way through a store that is larger than memory, by leaps too: never late, whatever is kept.
TEST(PagerVicinity, IsNeverLateWhateverIsInMemory) {
  Stored all("parts", heap(8, 400'000, 20.0, Vec3(0.0)));
  ASSERT_GT(all.store->info().resident_bytes, 9u << 20);
  Pager pager(all.store, {.memory = Pager::least_memory});
  judged::NearJudge judge(all.mesh);
  Random random(9);
  Vicinity vicinity;
  long unknown = 0, known = 0, kept = 0;
  for (int leap = 0; leap < 60; ++leap) {
    const Body body = course::some_body(random, 0.3);
    Vec3 at = course::beside(random, all.mesh, body);
    Vec3 ahead = 0.05 * random.direction();
    for (int i = 0; i < 40; ++i) {
      (void)pager.update(body, at, 60.0 * ahead);
      if (i % 5 == 0) std::this_thread::sleep_for(std::chrono::microseconds(300));
      const Question sweep{body, at, ahead, 0.0, true}, gap{body, at, ahead, 0.2, false};
      const Impact s = ask_in(pager, vicinity, sweep).impact;
      ASSERT_NO_FATAL_FAILURE(judge_beside(pager, vicinity, sweep, {s}, judge)) << leap << " " << i;
      const Answer bound = ask_in(pager, vicinity, gap);
      ASSERT_NO_FATAL_FAILURE(judge_beside(pager, vicinity, gap, bound, judge)) << leap << " " << i;
      ++(s.hit && s.unknown ? unknown : known);
      kept += vicinity.state()->complete ? 1 : 0;
      at += s.time * ahead + (s.hit ? 3e-3 * s.normal : Vec3(0.0));
      if (s.hit) ahead = 0.05 * random.direction();
    }
  }
  EXPECT_GT(unknown, 100);
  EXPECT_GT(known, 500);
  EXPECT_GT(kept, 500);
  EXPECT_GT(pager.stats().evictions, 20u);
}

/// Two stores that are alike but for where things are.
TEST(PagerVicinity, NeverAnswersFromAnotherStore) {
  const auto shifted = [](double by) {
    Mesh m = heap(10, 20'000, 5.0, Vec3(0.0));
    scenes::shift(m, Vec3(0.0, 0.0, by));
    return m;
  };
  Stored low("low", shifted(0.0)), high("high", shifted(0.05));
  Pager one(low.store, {.memory = 64 << 20}), other(high.store, {.memory = 64 << 20});
  // What it is known by that a store is another one, or has changed.
  const auto revisions = [](Pager& pager) {
    std::set<std::uint64_t> all{pager.facts().revision.value()};
    const auto tiles = pager.store().info().tiles;
    EXPECT_TRUE(made::update_until(pager, {0.3, 0.0}, Vec3(0.0), [&] {
      all.insert(pager.facts().revision.value());
      return pager.stats().tiles == tiles;
    }));
    return all;
  };
  const std::set<std::uint64_t> of_one = revisions(one);
  EXPECT_GT(of_one.size(), 1U);
  for (const std::uint64_t revision : revisions(other)) EXPECT_FALSE(of_one.contains(revision));
  judged::NearJudge judge_one(low.mesh), judge_other(high.mesh);
  Vicinity vicinity;
  long hits = 0;
  for (const Question& q : questions_of(one, low.mesh, {.steps = 1500, .on_foot = true}, 11)) {
    const auto judged = [&](const Pager& pager, judged::NearJudge& judge) {
      const Answer a = ask_in(pager, vicinity, q);
      hits += a.impact.hit ? 1 : 0;
      if (q.sweep) {
        judged::judge_sweep(a.impact, q.body, q.from, q.motion, judged::farthest_off, judge);
      } else {
        judged::judge_gap(a.gap, q.body, q.from, q.motion, q.reach, judge);
      }
    };
    ASSERT_NO_FATAL_FAILURE(judged(one, judge_one));
    ASSERT_NO_FATAL_FAILURE(judged(other, judge_other));
  }
  EXPECT_GT(hits, 300);
}

/// What was asked before decides, not what came when: all that is near is there, and in one of two the rest comes while
/// they are asked.
TEST(PagerVicinity, AnswersTheSameBitsWhenTheRestComesAtOtherTimes) {
  const Mesh near = heap(12, 30'000, 6.0, Vec3(0.0));
  Mesh mesh = near;
  add(mesh, heap(13, 300'000, 30.0, Vec3(80.0, 0.0, 0.0)));
  Stored all("bits", mesh);
  Pager complete(all.store, {.memory = 64 << 20, .loaders = 2});
  ASSERT_NO_FATAL_FAILURE(made::load_all(complete));
  all.bytes->delay_us = 1000;
  Pager growing(all.store, {.memory = 64 << 20});
  const Body body{0.3, 0.6};
  ASSERT_TRUE(growing.wait(body, Vec3(0.0), Vec3(0.0), 30.0, 10.0));
  const auto tiles = all.store->info().tiles;
  ASSERT_LT(growing.stats().tiles, tiles / 2);
  Vicinity of_complete, of_growing;
  long changes = 0, answered = 0;
  const std::vector<Question> questions =
      questions_of(complete, near, {.steps = 1500, .on_foot = true, .largest = 0.3}, 15);
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const Question& q = questions[i];
    if (const auto before = growing.stats().tiles; i % 20 == 0 && before < tiles) {
      ASSERT_TRUE(made::update_until(growing, body, Vec3(0.0), [&] { return growing.stats().tiles > before; }));
      ++changes;
    }
    const Answer a = ask_in(complete, of_complete, q), b = ask_in(growing, of_growing, q);
    ASSERT_EQ(of_complete.state()->complete, of_growing.state()->complete) << i;
    if (!of_complete.state()->complete) continue;  // too much is near
    ++answered;
    ASSERT_TRUE(a.is(b)) << i;
  }
  EXPECT_GT(changes, 50);
  EXPECT_GT(answered, long(questions.size()) / 2);
}

}  // namespace
