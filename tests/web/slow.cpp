// Reads over a slow network: several under way, and none waits for another's bytes.

#include <future>

#include "store/opened.h"
#include "web_made.h"

namespace {

using namespace made;

TEST(WebSlow, NeighboursBecomeOneRequest) {
  const Served served("web_neighbours");
  const support::Misbehaving server(served.root());
  const auto store = opened(server.address("late50"));
  static_cast<void>(server.requests());
  Pager pager(store, {.memory = 64 << 20, .loaders = 8});
  EXPECT_TRUE(update_until(pager, {0.3, 0.6}, middle, [&] { return pager.stats().tiles == store->info().tiles; }));
  std::size_t requests = 0;
  for (const std::string& request : server.requests()) requests += request.find("/packs/") != std::string::npos ? 1 : 0;
  EXPECT_LT(2 * requests, store->info().tiles + store->info().pages);
}

TEST(WebSlow, WhoReadsAllHasSeveralRequestsUnderWay) {
  const Served served("web_ahead");
  const support::Misbehaving server(served.root());
  const auto store = opened(server.address("late100"));
  static_cast<void>(server.most_at_once());
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(all_bytes(*store), all_bytes(*Store::open(served.store())));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_GE(server.most_at_once(), 2);
  EXPECT_LT(took.count(), 0.05 * static_cast<double>(store->info().tiles + store->info().pages));
  struct Enough {};
  EXPECT_THROW(store->for_each_triangle(store->info().bounds, [](auto, auto) { throw Enough(); }), Enough);
}

TEST(WebSlow, OverASlowLineTheFirstTileOfARequestDoesNotWaitForTheLast) {
  const Served served("web_line");
  const support::Misbehaving server(served.root());
  const auto store = opened(server.address("rate20"));
  const auto& state = store->state();
  const auto read = [&](std::uint64_t offset, std::size_t bytes) {
    return std::async(std::launch::async, [&state, offset, bytes] {
      std::vector<std::byte> out(bytes);
      EXPECT_EQ(state.bytes->read(state.packs.front(), offset, out), nullptr);
      return std::chrono::steady_clock::now();
    });
  };
  // While one is under way, the next wait for their neighbours.
  const std::uint64_t size = state.manifest.shards.front().bytes;
  ASSERT_GT(size, 47'000U) << "they would be neighbours";
  static_cast<void>(server.requests());
  auto before = read(size - 4000, 4000);
  while (server.requests().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  auto first = read(0, 100), last = read(100, 10'000);
  const auto apart = last.get() - first.get();
  EXPECT_EQ(server.requests().size(), 1U) << "they are one request";
  EXPECT_GT(apart, std::chrono::milliseconds(150));
}

}  // namespace
