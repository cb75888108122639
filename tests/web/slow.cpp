// Reads over a slow network: several under way, and none waits for another's bytes.

#include <fstream>
#include <future>

#include "store/files.h"
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
  EXPECT_LT(requests, store->info().tiles + store->info().pages) << "a busy machine begins few reads at once";
}

TEST(WebSlow, AReaderOfAllTilesHasSeveralRequestsUnderWay) {
  const Served served("web_ahead");
  const support::Misbehaving server(served.root());
  const auto store = opened(server.address("late100"));
  static_cast<void>(server.most_at_once());
  EXPECT_EQ(all_bytes(*store), all_bytes(*Store::open(served.store())));
  EXPECT_GE(server.most_at_once(), 2);
  static_cast<void>(server.most_at_once());
  static_cast<void>(server.requests());
  EXPECT_TRUE(roam::verify_store(server.address("late100"), {}, patient(2.0)).whole());
  EXPECT_GE(server.most_at_once(), 2);
  EXPECT_LT(server.requests().size(), 2 * store->info().tiles) << "a tile is two reads, which become one request";
  struct Enough {};
  EXPECT_THROW(store->for_each_triangle(store->info().bounds, [](auto, auto) { throw Enough(); }), Enough);
}

/// A pack that the store does not name, of so many bytes.
std::string add_pack(const Served& served, char digit, std::size_t bytes) {
  std::string name = roam::store::pack_file(std::string(64, digit));
  std::ofstream(served.root() / "x.roam" / name, std::ios::binary) << std::string(bytes, 'x');
  return name;
}

/// Reads that far apart are requests of their own.
constexpr std::uint64_t apart = 40 << 10;

void await_requests(const support::Misbehaving& server, std::size_t count) {
  for (std::size_t seen = server.requests().size(); seen < count; seen += server.requests().size()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

std::future<const char*> begun(const Store& store, const std::string& pack, std::uint64_t offset, std::size_t bytes) {
  return std::async(std::launch::async, [&files = *store.state().bytes, pack, offset, bytes] {
    std::vector<std::byte> out(bytes);
    return files.read(pack, offset, out);
  });
}

TEST(WebSlow, OverASlowLineTheFirstTileOfARequestDoesNotWaitForTheLast) {
  const Served served("web_line");
  const support::Misbehaving server(served.root());
  const auto store = opened(server.address("gated"), patient(60.0));
  const std::string held = add_pack(served, 'f', 8 * apart), pack = add_pack(served, 'a', 10'100);
  static_cast<void>(server.requests());
  // While as many requests as there may be are under way, the next wait for their neighbours.
  std::vector<std::future<const char*>> before;
  for (std::uint64_t i = 0; i < 8; ++i) before.push_back(begun(*store, held, i * apart, 100));
  await_requests(server, 8);
  auto first = begun(*store, pack, 0, 100), last = begun(*store, pack, 100, 10'000);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  server.release("first");
  EXPECT_EQ(first.wait_for(std::chrono::seconds(20)), std::future_status::ready) << "the rest is held";
  EXPECT_EQ(last.wait_for(std::chrono::seconds(0)), std::future_status::timeout);
  EXPECT_EQ(server.requests().size(), 1U) << "they are one request";
  server.release("rest");
  EXPECT_STREQ(first.get(), nullptr);
  EXPECT_STREQ(last.get(), nullptr);
  for (auto& read : before) EXPECT_EQ(read.get(), nullptr);
}

TEST(WebSlow, AReadThatHasWaitedForItsTurnIsTriedAgain) {
  const Served served("web_turn");
  const support::Misbehaving server(served.root());
  const std::string pack = add_pack(served, 'a', 18 * apart);
  const auto store = opened(server.address(fmt::format("rate32reset{}", 16 * apart)), patient(4.0));
  static_cast<void>(server.requests());
  std::vector<std::future<const char*>> reads;
  for (std::uint64_t i = 0; i < 8; ++i) reads.push_back(begun(*store, pack, 2 * i * apart, 18'000));
  await_requests(server, 8);
  reads.push_back(begun(*store, pack, 16 * apart, 18'000));
  for (std::size_t i = 0; i < reads.size(); ++i) EXPECT_STREQ(reads[i].get(), nullptr) << i;
}

/// Each second brings enough, and the end would come after days.
TEST(WebSlow, ATransferThatTakesFarTooLongIsEnded) {
  const Served served("web_drip");
  const support::Misbehaving server(served.root());
  const std::string message = refusal(server.address("all-drip"), patient(0.1));
  EXPECT_NE(message.find("far too long"), std::string::npos) << message;
}

}  // namespace
