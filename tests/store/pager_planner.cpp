// What the planner of a pager decides, without threads and files: bodies roam among made-up pages, everything comes at
// once, and nothing is ever read, or used, of a page that has gone.
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <new>
#include <random>

#include "store/pager/planner.h"

namespace {

using namespace roam;
using namespace roam::paging;

class Scenery {
 public:
  explicit Scenery(unsigned seed) : random_(seed) {
    const auto pages = whole(4, 40);
    for (unsigned p = 0; p < pages; ++p) add_page();
    store_.manifest.shards.emplace_back();
    units_ = whole(200, 800);
    memory_ = std::make_unique<Unit[]>(units_);
    arena_ = memory_[0].bytes;
    planner_ = std::make_unique<Planner>(store_, arena_, units_, number(1.0, 30.0), handover_);
    residents_ = std::make_unique<Residents>(store_, arena_);
  }

  void step() {
    place_ += 0.05 * velocity_;
    if (whole(0, 49) == 0) velocity_ = {number(-20.0, 20.0), number(-20.0, 20.0), 0.0};
    if (whole(0, 99) == 0) place_ = {number(-100.0, 100.0), number(-100.0, 100.0), 0.0};
    handover_.tracked = TrackedBody({0.3, 0.5}, place_, velocity_);
    ++handover_.told;
    if (whole(0, 2) > 0) update();
    Work work;
    for (unsigned i = whole(0, 11); i > 0 && !testing::Test::HasFatalFailure() && planner_->next(work); --i) {
      load(work);
    }
  }
  [[nodiscard]] int gone() const { return gone_; }

 private:
  struct alignas(4096) Unit {
    std::byte bytes[unit_bytes];
  };

  unsigned whole(unsigned least, unsigned most) {
    return std::uniform_int_distribution<unsigned>(least, most)(random_);
  }
  double number(double least, double most) { return std::uniform_real_distribution<double>(least, most)(random_); }

  void add_page() {
    const Vec3 middle(number(-150.0, 150.0), number(-150.0, 150.0), 0.0);
    const double width = number(5.0, 60.0);
    std::vector<store::TileEntry> tiles(whole(1, 120));
    store::PageRef ref;
    for (store::TileEntry& t : tiles) {
      t = {};
      const Vec3 lower = middle + Vec3(number(-width, width), number(-width, width), number(-3.0, 3.0));
      const Vec3 upper = lower + Vec3(number(1.0, 15.0), number(1.0, 15.0), number(1.0, 5.0));
      for (int k = 0; k < 3; ++k) {
        t.lower[k] = lower[k];
        t.upper[k] = upper[k];
      }
      t.leaves = static_cast<std::uint16_t>(whole(1, 1500));
      t.nodes = static_cast<std::uint16_t>(1 + t.leaves / 8);
      ref.box.include({lower, upper});
    }
    ref.tiles = static_cast<std::uint32_t>(tiles.size());
    ref.bytes = static_cast<std::uint32_t>(tiles.size() * sizeof(store::TileEntry));
    store_.pages.push_back({0, ref});
    tiles_.push_back(std::move(tiles));
  }

  /// What Pager::update does.
  void update() {
    while (!handover_.messages.empty() && handover_.gone.room() > 0) {
      const Message message = handover_.messages.pop();
      const PagedItem& item = message.item;
      ASSERT_TRUE(item.is_page() || residents_->has_page(item.page)) << "spoken of after its page";
      if (message.kind == Message::Kind::failed) {
        residents_->fail(item);
      } else if (message.kind == Message::Kind::go) {
        const bool kept = handover_.tracked.holds(residents_->box(item));
        handover_.gone.push({item, kept});
        if (!kept) residents_->take(item);
        ++gone_;
      } else if (item.is_page()) {
        residents_->put_page(item.page, message.page);
      } else {
        residents_->put_tile(item, message.unit);
      }
    }
  }

  /// What a loading thread does.
  void load(const paging::Work& work) {
    std::byte* const memory = arena_ + work.unit * unit_bytes;
    const std::vector<store::TileEntry>& tiles = tiles_[work.item.page];
    paging::Outcome outcome;
    if (work.item.is_page()) {
      const std::uint32_t coded = store_.pages[work.item.page].ref.bytes;
      std::memcpy(memory, tiles.data(), coded);
      outcome.page.view.tiles = {reinterpret_cast<const store::TileEntry*>(memory), tiles.size()};
      std::byte* at = memory + Planner::tiles_offset(coded);
      outcome.page.tiles = reinterpret_cast<index::Tile*>(at);
      index::Tile absent{};
      absent.nodes = index::Tile::absent_leaf;
      for (std::size_t i = 0; i < tiles.size(); ++i, at += sizeof absent) new (at) index::Tile(absent);
      for (std::size_t i = 0; i < tiles.size(); ++i, at += sizeof(Planner::TileState)) new (at) Planner::TileState();
    } else {
      const auto* entry = reinterpret_cast<const std::byte*>(work.entry);
      ASSERT_TRUE(entry >= arena_ && entry < arena_ + units_ * unit_bytes) << "to be read after its page has gone";
      ASSERT_EQ(std::memcmp(entry, &tiles[work.item.tile], sizeof(store::TileEntry)), 0) << "its page is overwritten";
      std::memset(memory, 0xEE, shape_of(*work.entry).bytes());
    }
    if (whole(0, 49) == 0) outcome.why = "made to fail";
    planner_->done(work, outcome);
  }

  std::mt19937 random_;
  Store::State store_;
  std::vector<std::vector<store::TileEntry>> tiles_;
  std::uint32_t units_ = 0;
  std::unique_ptr<Unit[]> memory_;
  std::byte* arena_ = nullptr;
  Handover handover_;
  std::unique_ptr<Planner> planner_;
  std::unique_ptr<Residents> residents_;
  Vec3 place_{0.0}, velocity_{10.0, 0.0, 0.0};
  int gone_ = 0;
};

TEST(PagerPlanner, SendsNoPageAwayThatSomethingIsWantedOf) {
  int gone = 0;
  for (unsigned seed = 1; seed <= 60 && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Scenery scenery(seed);
    for (int i = 0; i < 400 && !testing::Test::HasFatalFailure(); ++i) scenery.step();
    gone += scenery.gone();
  }
  EXPECT_GT(gone, 1000);  // or nothing was put to the test
}

}  // namespace
