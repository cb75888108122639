// The manifest of a store, and how a new one comes into force.
#include "store/manifest.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "import_files.h"
#include "messages.h"
#include "store/files.h"
#include "store_files_made.h"

namespace {

using namespace roam;
using namespace roam::store;
using roam::test::TemporaryFolder;

using made::some_manifest;
using made::some_shard;

TEST(Manifest, ComesBackAsItWas) {
  const Manifest manifest = some_manifest();
  const std::string text = to_text(manifest);
  const Manifest again = parse_manifest(text, "m");
  EXPECT_EQ(to_text(again), text);
  ASSERT_EQ(again.shards.size(), 2U);
  const ShardInfo &a = again.shards[0], b = some_shard(30);
  EXPECT_EQ(a.bounds.lower, b.bounds.lower);
  EXPECT_EQ(a.largest_error, b.largest_error);
  EXPECT_EQ(a.geometry_hash, b.geometry_hash);
  EXPECT_EQ(a.pages[0].hash, b.pages[0].hash);
  EXPECT_EQ(a.pages[1].offset, b.pages[1].offset);
  EXPECT_EQ(again.parts[0].name, manifest.parts[0].name);
  EXPECT_EQ(again.notes, manifest.notes);
  EXPECT_EQ(to_text(parse_shard(to_text(b), "s")), to_text(b));
}

TEST(Manifest, IsRefusedWhereAnythingIsNotAsItShouldBe) {
  const auto refused = [](const std::function<void(Manifest&)>& spoil) {
    Manifest manifest = some_manifest();
    spoil(manifest);
    return error_of([&] { (void)parse_manifest(to_text(manifest), "m"); }) != "";
  };
  EXPECT_FALSE(refused([](Manifest&) {}));
  EXPECT_TRUE(refused([](Manifest& m) { m.shards.clear(); }));
  EXPECT_TRUE(refused([](Manifest& m) { m.shards[0].triangles = 31; })) << "more than the parts have";
  EXPECT_TRUE(refused([](Manifest& m) { m.shards[0].pages[0].tiles = 0; }));
  EXPECT_TRUE(refused([](Manifest& m) { m.shards[0].pages[0].tiles = 1025; }));
  EXPECT_TRUE(refused([](Manifest& m) { m.shards[0].pages[0].offset = m.shards[0].bytes - 10; }));
  EXPECT_TRUE(refused([](Manifest& m) { m.shards[0].pack = "../../etc/passwd"; })) << "names are digits only";
  EXPECT_TRUE(refused([](Manifest& m) { m.parts[0].file = "x"; }));
  EXPECT_TRUE(refused([](Manifest& m) { m.bounds = {}; }));
  EXPECT_TRUE(refused([](Manifest& m) { m.shards[1].bounds.upper.x = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_THROW((void)parse_manifest("{", "m"), Error);
  EXPECT_THROW((void)parse_manifest("[]", "m"), Error);
}

TEST(Manifest, OfANewerFormatAsksForANewerProgram) {
  Manifest manifest = some_manifest();
  manifest.format = format_version + 1;
  const std::string error = error_of([&] { (void)parse_manifest(to_text(manifest), "m"); });
  EXPECT_NE(error.find("newer roam"), std::string::npos) << error;
}

TEST(Publish, PutsTheManifestInForce) {
  const TemporaryFolder folder;
  const std::string hash = publish(folder.path(), some_manifest());
  const auto files = files_of(folder.path());
  std::string named;
  EXPECT_EQ(to_text(read_manifest(*files, "s", &named)), to_text(some_manifest()));
  EXPECT_EQ(named, hash);
}

/// A store in memory.
class Memory : public StoreBytes {
 public:
  std::vector<std::byte> whole(const std::string& file, std::uint64_t) override {
    const auto it = files.find(file);
    if (it == files.end()) throw Error("no " + file);
    const auto bytes = std::as_bytes(std::span(it->second));
    return {bytes.begin(), bytes.end()};
  }
  const char* read(const std::string&, std::uint64_t, std::span<std::byte>, const std::stop_token& /*stop*/) override {
    return "nothing to read";
  }

  std::map<std::string, std::string> files;
};

TEST(Publish, WhileAnotherReadsLeadsItToTheNewOne) {
  /// Publishes the next manifest, and removes the one before it, between the reading of CURRENT and of what it names.
  struct Republished : StoreBytes {
    std::map<std::string, std::string> files;
    std::vector<std::string> next;  ///< texts of manifests
    void publish() {
      const std::string hash = sha256(std::as_bytes(std::span(next.back())));
      files = {{"CURRENT", "roam store 1\n" + hash + "\n"}, {manifest_file(hash), next.back()}};
      next.pop_back();
    }
    std::vector<std::byte> whole(const std::string& file, std::uint64_t) override {
      const auto it = files.find(file);
      if (it == files.end()) throw Error(file + " is not there");
      const auto bytes = std::as_bytes(std::span(it->second));
      std::vector<std::byte> content(bytes.begin(), bytes.end());
      if (file == "CURRENT" && !next.empty()) publish();
      return content;
    }
    const char* read(const std::string&, std::uint64_t, std::span<std::byte>,
                     const std::stop_token& /*stop*/) override {
      return "not asked for";
    }
  } bytes;
  for (const char* options : {"third", "second", "first"}) {
    Manifest manifest = some_manifest();
    manifest.options = options;
    bytes.next.push_back(to_text(manifest));
  }
  bytes.publish();
  EXPECT_EQ(read_manifest(bytes, "s").options, "third");
  bytes.files.erase(bytes.files.rbegin()->first);  // now it is gone for good
  EXPECT_NE(error_of([&] { (void)read_manifest(bytes, "s"); }), "");
}

TEST(Publish, ForEverEndsTheOpening) {
  struct Endless : StoreBytes {
    int reads = 0;
    std::vector<std::byte> whole(const std::string& file, std::uint64_t) override {
      if (file != "CURRENT" || ++reads > 1000) throw Error(file + " is not there");
      const std::string text = "roam store 1\n" + sha256(std::as_bytes(std::span(&reads, 1))) + "\n";
      const auto bytes = std::as_bytes(std::span(text));
      return {bytes.begin(), bytes.end()};
    }
    const char* read(const std::string&, std::uint64_t, std::span<std::byte>,
                     const std::stop_token& /*stop*/) override {
      return "not asked for";
    }
  } bytes;
  const std::string error = error_of([&] { (void)read_manifest(bytes, "s"); });
  EXPECT_NE(error.find("open it again later"), std::string::npos) << error;
  EXPECT_LE(bytes.reads, 12);
}

TEST(Publish, EveryFlippedBitOfWhatIsReadFirstIsRefused) {
  const TemporaryFolder folder;
  const std::string hash = publish(folder.path(), some_manifest());
  Memory memory;
  for (const std::string& file : {std::string(current_file), manifest_file(hash)}) {
    const auto bytes = read_file(folder.path(), file, 1 << 20);
    memory.files[file].assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  ASSERT_NO_THROW((void)read_manifest(memory, "s"));
  for (auto& [file, text] : memory.files) {
    const std::string good = text;
    for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
      text[bit / 8] = static_cast<char>(text[bit / 8] ^ 1 << bit % 8);
      ASSERT_THROW((void)read_manifest(memory, "s"), Error) << file << " bit " << bit;
      text = good;
    }
    for (std::size_t size = 0; size < good.size(); ++size) {
      text = good.substr(0, size);
      ASSERT_THROW((void)read_manifest(memory, "s"), Error) << file << " cut to " << size;
    }
    text = good;
  }
}

}  // namespace
