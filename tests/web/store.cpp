// A store on a web server is the store on the disk, and a bad server or network is a slow or damaged disk.

#include <algorithm>
#include <fstream>
#include <future>
#include <map>

#include "store/files.h"
#include "store/opened.h"
#include "store/web/disk_cache.h"
#include "web_made.h"

namespace {

using namespace made;

TEST(WebStore, AWalkOverNginxIsThatOnTheDiskToTheLastBit) {
  if (!support::Nginx::is_there()) GTEST_SKIP() << "nginx is not here (Debian: nginx-light)";
  const Served served("web_nginx");
  const support::Nginx nginx(served.folder.path() / "nginx", served.root());
  const auto store = opened(nginx.address());
  const auto disk = Store::open(served.store());
  EXPECT_EQ(store->name(), nginx.address());
  EXPECT_EQ(store->info().hash, disk->info().hash);
  EXPECT_EQ(all_bytes(*store), all_bytes(*disk));
  for (const std::uint64_t seed : {1, 2}) EXPECT_EQ(way_of(store, seed, 400), way_of(disk, seed, 400));
  roam::TriangleId some = 0;
  disk->for_each_triangle(disk->info().bounds, [&](auto, auto ids) { some = ids[0]; });
  EXPECT_EQ(store->source(some).object, "yard");
  EXPECT_TRUE(roam::verify_store(nginx.address(), {}).whole());
}

TEST(WebStore, BadAnswersAreSolidAndNamed) {
  const Served served("web_bad");
  const support::Misbehaving server(served.root());
  const std::map<std::string, std::string> reasons{
      {"bits", "its checksum is wrong"},
      {"zeros", "its checksum is wrong"},
      {"whole", "ignores ranges"},
      {"page", "ignores ranges"},
      {"short", "shorter than the manifest says"},
      {"truncated", "shorter than the manifest says; publish the store again"},
      {"cut", "connection to the web server broke"},
      {"reset", "connection to the web server broke"},
      {"long", "its checksum is wrong"},
      {"shifted", "another range"},
      {"unsaid", "another range"},
      {"absurd", "another range"},
      {"garbage", "no HTTP"},
      {"endless", "ignores ranges"},
      {"stall", "does not answer"},
      {"400", "does not understand"},
      {"401", "~/.netrc"},
      {"403", "refuses access"},
      {"404", "the store was replaced or removed"},
      {"412", "no file has"},
      {"416", "shorter than the manifest says"},
      {"429", "too many requests"},
      {"500", "fails or is overloaded"},
      {"503", "fails or is overloaded"},
      {"elsewhere", "redirects to another address"},
      {"file", "redirects to another address"},
      {"loop", "redirects to another address"},
  };
  for (const auto& [mode, reason] : reasons) {
    SCOPED_TRACE(mode);
    const auto store = opened(server.address(mode), patient(0.3));
    Pager pager(store, {.memory = 16 << 20, .loaders = 4});
    // "long" only breaks a connection: what was wanted has come before.
    const bool comes = mode == "long";
    EXPECT_TRUE(update_until(pager, {0.3, 0.6}, middle, [&] { return comes || pager.stats().failed > 0; }));
    if (!comes) {
      EXPECT_NE(pager.stats().last_failure.find(reason), std::string::npos) << pager.stats().last_failure;
    }
    const double length = judged_length(served, pager, 1, 60);
    if (!comes) {
      EXPECT_LT(length, 1e-9) << "held";
    }
  }
}

TEST(WebStore, WhatPassesIsTriedAgain) {
  const Served served("web_again");
  const support::Misbehaving server(served.root());
  const std::string there = all_bytes(*Store::open(served.store()));
  for (const char* mode : {"503once", "429once", "resetonce", "late50"}) {
    const auto store = opened(server.address(mode), patient(20.0));
    // Of one box: a pause for each tile would be long.
    std::string some, right;
    const roam::Box box{{18.0, 18.0, -1.0}, {19.0, 19.0, 4.0}};
    const auto add_to = [](std::string& all) {
      return [&all](auto triangles, auto) {
        all.append(reinterpret_cast<const char*>(triangles.data()), triangles.size_bytes());
      };
    };
    store->for_each_triangle(box, add_to(some));
    Store::open(served.store())->for_each_triangle(box, add_to(right));
    EXPECT_EQ(some, right) << mode;
  }
}

TEST(WebStore, ASlowServerIsNeverPassedThrough) {
  const Served served("web_slow", 3);
  const support::Misbehaving server(served.root());
  Pager pager(opened(server.address("late50")), {.memory = Pager::least_memory});
  EXPECT_GT(judged_length(served, pager, 3, 1500), 1.0);
}

TEST(WebStore, WhatIsNoStoreIsRefused) {
  const Served served("web_none");
  const support::Misbehaving server(served.root());
  const std::map<std::string, std::string> reasons{
      {"current-404", "there is no store at this address"},
      {"current-403", "refuses access"},
      {"current-page", "is no store, or damaged"},
      {"current-500", "overloaded"},
      {"current-elsewhere", "--redirects follows it"},
      {"current-endless", "larger than any of its kind"},
      {"current-stall", "does not answer"},
      {"current-head", "more header lines"},
      {"current-trailers", "more header lines"},
      {"current-garbage", "no HTTP"},
  };
  for (const auto& [mode, reason] : reasons) {
    const std::string message = refusal(server.address(mode));
    EXPECT_NE(message.find(reason), std::string::npos) << mode << ": " << message;
    EXPECT_NE(message.find(server.address(mode)), std::string::npos) << message;
  }
  const std::string nobody = fmt::format("http://127.0.0.1:{}/x.roam", support::free_port());
  EXPECT_NE(refusal(nobody).find("no connection to the web server"), std::string::npos);
  EXPECT_NE(refusal("http://name.invalid/x.roam").find("name is not known"), std::string::npos);
  EXPECT_NE(refusal("http:///x.roam").find("no address"), std::string::npos);
  EXPECT_NE(refusal("http://a/b c").find("%20"), std::string::npos);
  const std::string login = refusal("http://me:word@a/x.roam");
  EXPECT_NE(login.find(".netrc"), std::string::npos);
  EXPECT_EQ(login.find("me:"), std::string::npos);
}

TEST(WebStore, TheQueryGoesWithEachRequestAndIsSeenNowhereElse) {
  const Served served("web_signed");
  const support::Misbehaving server(served.root());
  const std::string secret = "Signature=Geheim%2F&Expires=1";
  const std::filesystem::path cache = served.folder.path() / "cache" / "web.cache";
  for (const bool in_address : {true, false}) {
    WebAccess web = with_cache(cache, 8 << 20);
    if (!in_address) web.query = secret;
    const auto store = opened(server.address("good") + (in_address ? "?" + secret : ""), web);
    EXPECT_EQ(store->name(), server.address("good"));
    static_cast<void>(all_bytes(*store));
    for (const std::string& request : server.requests()) EXPECT_NE(request.find(secret), std::string::npos) << request;
    for (const char* mode : {"current-403", "current-elsewhere", "current-page"}) {
      const std::string message = refusal(server.address(mode) + (in_address ? "?" + secret : ""), web);
      EXPECT_EQ(message.find("Geheim"), std::string::npos) << message;
    }
    const auto bad = opened(server.address("403") + (in_address ? "?" + secret : ""), web);
    Pager pager(bad, {.memory = Pager::least_memory});
    EXPECT_TRUE(update_until(pager, {0.3, 0.6}, middle, [&] { return pager.stats().failed > 0; }));
    EXPECT_NE(pager.stats().last_failure.find("signature of the address may have expired"), std::string::npos);
    EXPECT_EQ(pager.stats().last_failure.find("Geheim"), std::string::npos);
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(served.folder.path() / "cache")) {
    EXPECT_EQ(entry.path().string().find("Geheim"), std::string::npos);
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string content((std::istreambuf_iterator<char>(file)), {});
    EXPECT_EQ(content.find("Geheim"), std::string::npos) << entry.path();
  }
}

TEST(WebStore, NothingOutsideOfItsFolderIsRequested) {
  const Served served("web_outside");
  const support::Misbehaving server(served.root());
  const auto files = roam::store::web_store(server.address("good"), {}).bytes;
  std::vector<std::byte> out(10);
  const std::string digits(64, 'a');
  const std::vector<std::string> names{"../x",
                                       "packs/../" + digits + ".pack",
                                       "/etc/passwd",
                                       "packs/" + digits + ".pack?a",
                                       "http://other/packs/" + digits + ".pack",
                                       "LOCK",
                                       "packs/" + digits + "/../" + digits + ".pack"};
  for (const std::string& name : names) {
    EXPECT_THROW(static_cast<void>(files->whole(name, 100)), roam::Error) << name;
    EXPECT_THROW(static_cast<void>(files->read(name, 0, out)), roam::Error) << name;
  }
  EXPECT_TRUE(server.requests().empty());
  static_cast<void>(all_bytes(*opened(server.address("good"))));
  for (const std::string& request : server.requests()) EXPECT_TRUE(request.starts_with("/good/x.roam/")) << request;
}

TEST(WebStore, APagerOfAStalledServerEndsAtOnce) {
  const Served served("web_stalled");
  const support::Misbehaving server(served.root());
  const auto store = opened(server.address("stall"), patient(60.0));
  std::chrono::steady_clock::time_point begin;
  {
    Pager pager(store, {.memory = 16 << 20, .loaders = 4});
    EXPECT_FALSE(pager.wait({0.3, 0.6}, middle, Vec3(0.0), 0.3));
    begin = std::chrono::steady_clock::now();
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

TEST(WebStore, PagersEndAtOnceWhileNamesAreOnTheirWay) {
  const Served served("web_stalled_names");
  const support::Misbehaving server(served.root());
  const auto store = opened(server.address("stall"), patient(60.0));
  roam::TriangleId some = 0;
  Store::open(served.store())->for_each_triangle(store->info().bounds, [&](auto, auto ids) { some = ids[0]; });
  static_cast<void>(server.requests());
  std::chrono::steady_clock::time_point begin;
  {
    const Pager first(store, {.memory = Pager::least_memory}), second(store, {.memory = Pager::least_memory});
    for (const Pager* const pager : {&first, &second}) {
      std::size_t requests = 0;
      for (int i = 0; i < 1000 && requests == 0; ++i) {
        EXPECT_EQ(pager->object_name(some), "");
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        requests = server.requests().size();
      }
      EXPECT_EQ(requests, 1U) << "its thread waits for something else";
    }
    begin = std::chrono::steady_clock::now();
    EXPECT_THROW(static_cast<void>(store->source(~roam::TriangleId{0})), roam::Error);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

TEST(WebStore, WhoStopsTakesNoNeighbourWithHim) {
  const Served served("web_stops");
  const support::Misbehaving server(served.root());
  const auto store = opened(server.address("stall"), patient(60.0));
  const std::string pack = store->state().packs.front();
  const auto read = [&](std::uint64_t offset, std::stop_token stop) {
    return std::async(std::launch::async, [&store, &pack, offset, stop = std::move(stop)] {
      std::vector<std::byte> out(100);
      return store->state().bytes->read(pack, offset, out, stop);
    });
  };
  std::stop_source first, second;
  auto a = read(0, first.get_token()), b = read(100, second.get_token());
  EXPECT_EQ(a.wait_for(std::chrono::milliseconds(300)), std::future_status::timeout);
  first.request_stop();
  EXPECT_EQ(a.wait_for(std::chrono::seconds(2)), std::future_status::ready);
  EXPECT_EQ(b.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout);
  second.request_stop();
  EXPECT_EQ(b.wait_for(std::chrono::seconds(2)), std::future_status::ready);
}

TEST(WebStore, AFailureOfTheServerIsNoDamage) {
  const Served served("web_verified");
  const support::Misbehaving server(served.root());
  for (const char* mode : {"403", "503", "reset", "stall", "whole"}) {
    EXPECT_THROW(static_cast<void>(roam::verify_store(server.address(mode), {}, patient(0.3))), roam::Error) << mode;
  }
  // The files come whole, and then a page or a tile does not.
  for (const char* mode : {"inner403", "inner503", "innerreset", "innerstall"}) {
    try {
      static_cast<void>(roam::verify_store(server.address(mode), {}, patient(0.3)));
      ADD_FAILURE() << mode;
    } catch (const roam::Error& error) {
      EXPECT_NE(std::string(error.what()).find("cannot be verified: page 0"), std::string::npos) << error.what();
    }
  }
  for (const char* mode : {"404", "416", "short", "bits", "inner404", "innerbits"}) {
    EXPECT_FALSE(roam::verify_store(server.address(mode), {}, patient(0.3)).whole()) << mode;
  }
}

TEST(WebStore, AManifestThatIsCutOffOnTheWayIsRequestedOnceMore) {
  const Served served("web_unsized");
  const support::Misbehaving server(served.root());
  EXPECT_EQ(opened(server.address("all-unsizedonce"))->info().hash, Store::open(served.store())->info().hash);
  const std::string message = refusal(server.address("all-unsized"));
  EXPECT_NE(message.find("cut off on the way"), std::string::npos) << message;
}

TEST(WebStore, AReplacedStoreGoesOnAsTheOldOneOrSaysSo) {
  Served served("web_replaced");
  const support::Misbehaving server(served.root());
  const auto old = opened(server.address("good"));
  Pager pager(old, {.memory = Pager::least_memory});
  const auto first = all_bytes(*old);
  const Mesh other = yard_mesh(9);
  // A version that leaves the old files, as publish_store does.
  made::store(served.store(), {&other, 1}, {.page_tiles = 8, .tile_triangles = 100});
  EXPECT_EQ(all_bytes(*old), first);
  const auto now = opened(server.address("good"));
  EXPECT_NE(now->info().hash, old->info().hash);
  EXPECT_NE(all_bytes(*now), first);
  // One that removes them.
  std::filesystem::remove(served.root() / "x.roam" / old->state().packs.front());
  EXPECT_GE(judged_length(served, pager, 1, 100), 0.0);
  try {
    static_cast<void>(all_bytes(*old));
    ADD_FAILURE() << "the pack is not there";
  } catch (const roam::Error& error) {
    EXPECT_NE(std::string(error.what()).find("open it anew"), std::string::npos) << error.what();
  }
}

TEST(WebStore, WhatIsCachedIsNotRequestedAgain) {
  const Served served("web_cached");
  const support::Misbehaving server(served.root());
  const WebAccess web = with_cache(served.folder.path() / "web.cache", 16 << 20);
  const std::string right = all_bytes(*Store::open(served.store()));
  EXPECT_EQ(all_bytes(*opened(server.address("good"), web)), right);
  static_cast<void>(server.requests());
  EXPECT_EQ(all_bytes(*opened(server.address("good"), web)), right);
  const auto requests = server.requests();
  ASSERT_EQ(requests.size(), 1U) << "only CURRENT is read again";
  EXPECT_TRUE(requests[0].starts_with("/good/x.roam/CURRENT"));
  // Wrong bytes of a server are not kept, and another address is another store.
  EXPECT_THROW(static_cast<void>(all_bytes(*opened(server.address("bits"), web))), roam::Error);
  EXPECT_EQ(all_bytes(*opened(server.address("good"), web)), right);
  // A damaged cache is none.
  {
    std::fstream file(web.cache, std::ios::in | std::ios::out | std::ios::binary);
    const auto size = std::filesystem::file_size(web.cache);
    EXPECT_EQ(size, web.cache_bytes);
    for (std::uint64_t at = 8192; at < size; at += 512) file.seekp(static_cast<std::streamoff>(at)).put('x');
  }
  EXPECT_EQ(all_bytes(*opened(server.address("good"), web)), right);
  EXPECT_GT(server.requests().size(), 2U);
}

TEST(WebStore, AHostileManifestLeavesNothingInTheCacheForTheRightOne) {
  const Served served("web_planted");
  const support::Misbehaving server(served.root());
  const WebAccess web = with_cache(served.folder.path() / "web.cache", 16 << 20);
  const std::string right = all_bytes(*Store::open(served.store()));
  const auto genuine = roam::store::read_file(served.store(), "CURRENT", 4096);
  // Another page in the same pack, with the checksum that a manifest of its own names.
  roam::store::Manifest manifest = Store::open(served.store())->state().manifest;
  roam::store::PageRef& page = manifest.shards[0].pages[0];
  const auto pack = std::filesystem::path(served.store()) / roam::store::pack_file(manifest.shards[0].pack);
  std::filesystem::copy_file(pack, served.folder.path() / "pack");
  std::fstream file(pack, std::ios::in | std::ios::out | std::ios::binary);
  std::string bytes(page.bytes, ' ');
  file.seekg(static_cast<std::streamoff>(page.offset)).read(bytes.data(), page.bytes);
  bytes.back() = static_cast<char>(bytes.back() ^ 1);  // in the mask of a tile
  file.seekp(static_cast<std::streamoff>(page.offset)).write(bytes.data(), page.bytes);
  file.close();
  page.hash = roam::store::xxh3(std::as_bytes(std::span(bytes)));
  roam::store::publish(served.store(), manifest);
  EXPECT_EQ(all_bytes(*opened(server.address("good"), web)), right) << "only a mask differs";
  std::filesystem::copy_file(served.folder.path() / "pack", pack, std::filesystem::copy_options::overwrite_existing);
  roam::store::write_file(served.store(), "CURRENT", {reinterpret_cast<const char*>(genuine.data()), genuine.size()});
  EXPECT_EQ(all_bytes(*opened(server.address("good"), web)), right);
  static_cast<void>(server.requests());
  EXPECT_EQ(all_bytes(*opened(server.address("good"), web)), right);
  EXPECT_EQ(server.requests().size(), 1U) << "the right page is cached, too";
}

TEST(WebStore, AWrongEntryOfTheCacheIsRequestedAgain) {
  const Served served("web_entry");
  const support::Misbehaving server(served.root());
  const WebAccess web = with_cache(served.folder.path() / "web.cache", 16 << 20);
  const auto disk = Store::open(served.store());
  const auto& state = disk->state();
  const roam::store::PageRef& page = state.pages[0].ref;
  const std::string what = fmt::format("{}/{} {} {} {:016x}", server.address("good"), state.packs[state.pages[0].shard],
                                       page.offset, page.bytes, page.hash);
  const std::string key = roam::store::sha256(std::as_bytes(std::span(what)));
  roam::web::DiskCache cache(web.cache, web.cache_bytes);
  cache.keep(key, std::vector<std::byte>(page.bytes));
  EXPECT_EQ(all_bytes(*opened(server.address("good"), web)), all_bytes(*disk));
  std::vector<std::byte> now(page.bytes);
  ASSERT_TRUE(cache.find(key, now));
  EXPECT_EQ(roam::store::xxh3(now), page.hash) << "overwritten";
}

}  // namespace
