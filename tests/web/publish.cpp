// A published store is the old one or the new one, whole.

#include <algorithm>
#include <fstream>
#include <set>

#include "roam/store_build.h"
#include "store/files.h"
#include "store/opened.h"
#include "web_made.h"

namespace {

using namespace made;
namespace fs = std::filesystem;

class Publish : public testing::Test {
 protected:
  /// Builds version `seed` in place of the store.
  void make(std::uint64_t seed) {
    const Mesh mesh = yard_mesh(seed);
    made::store(from(), {&mesh, 1}, {.page_tiles = 8, .tile_triangles = 100});
  }
  [[nodiscard]] fs::path from() const { return folder_.path() / "from"; }
  [[nodiscard]] fs::path to() const { return folder_.path() / "www" / "x.roam"; }
  [[nodiscard]] std::set<std::string> packs() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(to() / "packs")) names.insert(entry.path().filename());
    return names;
  }
  made::Folder folder_{"publish"};
};

TEST_F(Publish, KeepsTheVersionBeforeAndNoOlderOne) {
  std::vector<std::string> bytes;
  std::shared_ptr<const Store> reader;
  for (const std::uint64_t seed : {1, 2, 3}) {
    make(seed);
    const auto done = roam::publish_store(from(), to());
    EXPECT_EQ(done.hash, Store::open(from())->info().hash);
    EXPECT_EQ(done.files + done.present, 2U) << "a pack, and a part whose names stay the same";
    const auto there = Store::open(to());
    EXPECT_EQ(there->info().hash, done.hash);
    bytes.push_back(all_bytes(*there));
    EXPECT_EQ(bytes.back(), all_bytes(*Store::open(from())));
    EXPECT_EQ(packs().size(), seed == 1 ? 1U : 2U);
    EXPECT_TRUE(roam::verify_store(to()).whole());
  }
  const auto again = roam::publish_store(from(), to());
  EXPECT_TRUE(again.unchanged);
  EXPECT_EQ(packs().size(), 2U) << "the version before is still there";
}

TEST_F(Publish, GoesOnAfterAnInterruption) {
  make(1);
  static_cast<void>(roam::publish_store(from(), to()));
  const std::string old = Store::open(to())->info().hash;
  make(2);
  std::uint64_t copied = 0;
  EXPECT_THROW(static_cast<void>(roam::publish_store(from(), to(),
                                                     [&](std::uint64_t done, std::uint64_t total) {
                                                       copied = done;
                                                       return done < total;
                                                     })),
               roam::Cancelled);
  EXPECT_GT(copied, 0U);
  EXPECT_EQ(Store::open(to())->info().hash, old);
  EXPECT_TRUE(roam::verify_store(to()).whole());
  const auto done = roam::publish_store(from(), to());
  EXPECT_GT(done.present, 0U);
  EXPECT_TRUE(roam::verify_store(to()).whole());
}

TEST_F(Publish, RefusesDamageAndFoldersWithOtherThings) {
  make(1);
  static_cast<void>(roam::publish_store(from(), to()));
  const std::string old = Store::open(to())->info().hash;
  make(2);
  const std::string pack = Store::open(from())->state().packs.front();
  {
    std::fstream file(from() / pack, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(100).put('x');
  }
  try {
    static_cast<void>(roam::publish_store(from(), to()));
    ADD_FAILURE() << "published a damaged store";
  } catch (const roam::Error& error) {
    EXPECT_NE(std::string(error.what()).find("is damaged"), std::string::npos) << error.what();
  }
  EXPECT_EQ(Store::open(to())->info().hash, old);
  EXPECT_EQ(packs().size(), 1U);
  EXPECT_TRUE(roam::verify_store(to()).whole());

  const fs::path other = folder_.path() / "other";
  fs::create_directory(other);
  std::ofstream(other / "index.html") << "hello";
  EXPECT_THROW(static_cast<void>(roam::publish_store(to(), other)), roam::Error);
  EXPECT_THROW(static_cast<void>(roam::publish_store(to(), to())), roam::Error);
  EXPECT_THROW(static_cast<void>(roam::publish_store(to(), to() / "packs" / "www")), roam::Error);
  EXPECT_FALSE(fs::exists(to() / "packs" / "www"));
  EXPECT_THROW(static_cast<void>(roam::publish_store(to(), "http://host/x.roam")), roam::Error);
  EXPECT_THROW(static_cast<void>(roam::publish_store(folder_.path() / "nothing", other / "new")), roam::Error);
  EXPECT_FALSE(fs::exists(other / "new"));
}

TEST_F(Publish, SaysWhatAFailureLeavesAndTheNextOneTidies) {
  make(1);
  static_cast<void>(roam::publish_store(from(), to()));
  const auto first = packs();
  const fs::path aside = folder_.path() / "aside";
  fs::copy(from(), aside, fs::copy_options::recursive);
  const Mesh two[] = {yard_mesh(2), yard_mesh(3)};
  made::store(from(), two, {.page_tiles = 8, .tile_triangles = 100});
  // A copy is cut off by a kill, and the version before is published again.
  std::ofstream(to() / "packs" / (std::string(64, 'a') + ".pack")) << "of a version that never came";
  std::ofstream(to() / "packs" / "new.pack.123.1.unfinished") << "";
  EXPECT_TRUE(roam::publish_store(aside, to()).unchanged);
  EXPECT_EQ(packs(), first);
  // The parts are copied, and then a pack cannot be.
  const std::string pack = Store::open(from())->state().packs.front();
  fs::resize_file(from() / pack, fs::file_size(from() / pack) - 8);
  try {
    static_cast<void>(roam::publish_store(from(), to()));
    ADD_FAILURE() << "published a pack that was cut off";
  } catch (const roam::Error& error) {
    EXPECT_NE(std::string(error.what()).find("goes on from what is copied"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(roam::verify_store(to()).whole());
  EXPECT_EQ(Store::open(to())->info().hash, Store::open(aside)->info().hash);
}

TEST_F(Publish, MirrorsAStoreOnAWebServer) {
  make(1);
  const support::Misbehaving server(folder_.path());
  static_cast<void>(roam::publish_store(server.address("good", "from"), to()));
  EXPECT_EQ(all_bytes(*Store::open(to())), all_bytes(*Store::open(from())));
  EXPECT_THROW(
      static_cast<void>(roam::publish_store(server.address("bits", "from"), folder_.path() / "bad", {}, patient(1.0))),
      roam::Error);
  EXPECT_FALSE(fs::exists(folder_.path() / "bad" / "CURRENT"));
}

TEST_F(Publish, AHostileUpstreamRemovesNothing) {
  make(1);
  static_cast<void>(roam::publish_store(from(), to()));
  const std::string right = all_bytes(*Store::open(to()));
  const auto before = packs();
  // The pack in force, under the name of another.
  roam::store::Manifest manifest = Store::open(from())->state().manifest;
  const std::string other(64, 'a');
  fs::rename(from() / roam::store::pack_file(manifest.shards[0].pack), from() / roam::store::pack_file(other));
  manifest.shards[0].pack = other;
  roam::store::publish(from(), manifest);
  EXPECT_THROW(static_cast<void>(roam::publish_store(from(), to())), roam::Error);
  EXPECT_EQ(packs(), before);
  EXPECT_EQ(all_bytes(*Store::open(to())), right);
}

TEST_F(Publish, CountsAFileOfTwoPartsOnce) {
  make(1);
  roam::store::Manifest manifest = Store::open(from())->state().manifest;
  ASSERT_EQ(manifest.parts[0].triangles % 2, 0U);
  manifest.parts[0].triangles /= 2;
  manifest.parts.push_back(manifest.parts[0]);
  manifest.parts[1].name = "twin";
  roam::store::publish(from(), manifest);
  std::uint64_t last = 0, all = 0;
  static_cast<void>(roam::publish_store(from(), to(), [&](std::uint64_t done, std::uint64_t total) {
    last = done;
    all = total;
    return true;
  }));
  EXPECT_EQ(last, all);
}

TEST_F(Publish, AManifestThatChangesMeanwhileIsRefused) {
  make(1);
  const std::string file = roam::store::manifest_file(Store::open(from())->info().hash);
  const support::Misbehaving server(folder_.path());
  for (const std::string& upstream : {from().string(), server.address("good", "from")}) {
    make(1);
    EXPECT_THROW(static_cast<void>(roam::publish_store(upstream, to(),
                                                       [&](auto, auto) {
                                                         std::ofstream(from() / file) << "<html>Who are you?</html>";
                                                         return true;
                                                       })),
                 roam::Error);
    EXPECT_FALSE(fs::exists(to() / "CURRENT"));
  }
}

}  // namespace
