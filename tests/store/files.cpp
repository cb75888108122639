// Files that are whole or not there, packs, the manifest, part files: what a store is made of.
#include "store/files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <map>
#include <random>

#include "import_files.h"
#include "packed_part.h"
#include "store/files.h"
#include "store/manifest.h"
#include "store/part.h"

namespace {

using namespace roam;
using namespace roam::store;
using roam::test::TemporaryFolder;
namespace fs = std::filesystem;

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }
std::string text_of(const fs::path& file) {
  const auto bytes = read_file(file.parent_path(), file.filename(), 1 << 20);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}
template <class F>
std::string error_of(const F& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Hashes, AreTheStandardOnes) {
  // FIPS 180-4, "abc"; XXH3 of nothing with seed 0, from xxHash's own test vectors.
  EXPECT_EQ(sha256(bytes_of("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(xxh3({}), 0x2d06800538d394c2ULL);
}

TEST(NewFile, IsThereOnlyWhenItIsWhole) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.txt";
  {
    NewFile file(path.parent_path(), path.filename());
    file.write(bytes_of("half"));
    EXPECT_FALSE(fs::exists(path));
  }
  EXPECT_EQ(files_in(folder.path()), 0U) << "what was not committed is removed";
  NewFile file(path.parent_path(), path.filename());
  file.write(bytes_of("who"));
  file.write(bytes_of("le"));
  file.commit();
  EXPECT_EQ(text_of(path), "whole");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(NewFile, ReplacesInOneStroke) {
  const TemporaryFolder folder;
  const fs::path path = folder.write("a.txt", "old");
  {
    NewFile file(path.parent_path(), path.filename());
    file.write(bytes_of("new"));
    EXPECT_EQ(text_of(path), "old");
    file.commit();
  }
  EXPECT_EQ(text_of(path), "new");
}

TEST(NewFile, IsNamedByItsContent) {
  const TemporaryFolder folder;
  NewFile file(folder.path(), "new.pack");
  file.write(bytes_of("a"));
  file.write(bytes_of("bc"));
  const std::string hash = file.commit_by_hash();
  EXPECT_EQ(hash, sha256(bytes_of("abc")));
  EXPECT_EQ(text_of(folder.path() / (hash + ".pack")), "abc");
  EXPECT_EQ(sha256_of_file(folder.path(), hash + ".pack"), hash);
}

TEST(StoreFiles, AreRefusedIfMostOfThemIsHoles) {
  const TemporaryFolder folder;
  const fs::path path = folder.write("a.pack", "abc");
  std::filesystem::resize_file(path, std::uintmax_t{1} << 40U);
  const std::string error = error_of([&] { static_cast<void>(sha256_of_file(folder.path(), "a.pack")); });
  EXPECT_NE(error.find("a.pack"), std::string::npos) << error;
  EXPECT_NE(error.find("holes"), std::string::npos) << error;
  std::vector<std::byte> out(3);
  const char* problem = files_of(folder.path())->read("a.pack", 0, out);
  ASSERT_NE(problem, nullptr);
  EXPECT_NE(std::string(problem).find("holes"), std::string::npos) << problem;
  // A copy may have a few.
  std::filesystem::resize_file(path, 8 << 20);
  EXPECT_EQ(files_of(folder.path())->read("a.pack", 0, out), nullptr);
  EXPECT_EQ(sha256_of_file(folder.path(), "a.pack").size(), 64U);
}

TEST(NewFile, SaysWhatFileItCouldNotWriteAndWhy) {
  const TemporaryFolder folder;
  const std::string error = error_of([&] { NewFile file(folder.path(), "absent/a.txt"); });
  EXPECT_NE(error.find("absent"), std::string::npos) << error;
  EXPECT_NE(error.find("No such file"), std::string::npos) << error;
}

TEST(NewFile, LeavesTheOldOneWhereTheDiskIsFull) {
  const TemporaryFolder folder;
  const fs::path path = folder.write("a.txt", "old");
  // A limit on the size of files stands for a disk that is full: in a process of its own, since it is for good.
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      NewFile file(path.parent_path(), path.filename());
      file.write(std::vector<std::byte>(10'000));
      file.commit();
      _exit(1);
    } catch (const Error& error) {
      _exit(std::string(error.what()).find("a.txt") != std::string::npos ? 0 : 2);
    }
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(text_of(path), "old");
}

TEST(ReadFile, RefusesWhatIsTooLargeForItsKind) {
  const TemporaryFolder folder;
  const fs::path path = folder.write("a.txt", "12345");
  EXPECT_EQ(read_file(folder.path(), "a.txt", 5).size(), 5U);
  EXPECT_THROW((void)read_file(folder.path(), "a.txt", 4), Error);
  EXPECT_THROW((void)read_file(folder.path(), "absent", 4), Error);
}

TEST(Pack, HoldsBlobsWhereItSays) {
  const TemporaryFolder folder;
  make_folder_in(folder.path(), "packs");
  PackWriter pack(folder.path());
  std::mt19937 random(1);
  std::vector<std::pair<std::uint64_t, std::vector<std::byte>>> blobs;
  for (int i = 0; i < 50; ++i) {
    std::vector<std::byte> blob(random() % 300);
    for (std::byte& b : blob) b = std::byte(random());
    const std::uint64_t offset = pack.add(blob);
    EXPECT_EQ(offset % pack_alignment, 0U);
    blobs.emplace_back(offset, blob);
  }
  const std::uint64_t size = pack.size();
  const std::string hash = pack.commit();
  EXPECT_EQ(fs::file_size(folder.path() / pack_file(hash)), size);
  const auto files = files_of(folder.path());
  for (const auto& [offset, blob] : blobs) {
    std::vector<std::byte> read(blob.size());
    EXPECT_EQ(files->read(pack_file(hash), offset, read), nullptr);
    EXPECT_EQ(read, blob);
  }
  std::vector<std::byte> beyond(10);
  EXPECT_NE(files->read(pack_file(hash), size - 5, beyond), nullptr);
  EXPECT_NE(files->read("packs/absent.pack", 0, beyond), nullptr);
}

TEST(Files, KeepReadingAPackThatWasRemoved) {
  const TemporaryFolder folder;
  folder.write("packs/a.pack", "content");
  const auto files = files_of(folder.path());
  std::vector<std::byte> out(7);
  ASSERT_EQ(files->read("packs/a.pack", 0, out), nullptr);
  fs::remove(folder.path() / "packs/a.pack");
  EXPECT_EQ(files->read("packs/a.pack", 0, out), nullptr);
}

TEST(Files, ReadAPackThatWasRepaired) {
  const TemporaryFolder folder;
  folder.write("packs/a.pack", "damaged");
  const auto files = files_of(folder.path());
  std::vector<std::byte> out(7);
  ASSERT_EQ(files->read("packs/a.pack", 0, out), nullptr);
  write_file(folder.path(), "packs/a.pack", "content");
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(files->read("packs/a.pack", 0, out), nullptr);
    EXPECT_EQ(std::memcmp(out.data(), "content", 7), 0);
  }
}

TEST(BuildLock, IsForOneProcessAtATimeAndEndsWithIt) {
  const TemporaryFolder folder;
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    const BuildLock lock(folder.path());
    const char ready = 'r';
    static_cast<void>(!write(pipe_ends[1], &ready, 1));
    pause();
    _exit(0);
  }
  char ready = 0;
  ASSERT_EQ(read(pipe_ends[0], &ready, 1), 1);
  const std::string error = error_of([&] { const BuildLock lock(folder.path()); });
  EXPECT_NE(error.find("process " + std::to_string(child)), std::string::npos) << error;
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  close(pipe_ends[0]);
  close(pipe_ends[1]);
  EXPECT_NO_THROW(const BuildLock lock(folder.path()));
}

// ----------------------------------------------------------------------------------------------------------- manifest

ShardInfo some_shard(std::uint64_t triangles) {
  ShardInfo shard;
  shard.key = std::string(64, 'a');
  shard.pack = std::string(64, 'b');
  shard.bytes = 123'456'789'012ULL;
  shard.triangles = triangles;
  shard.tiles = 3;
  shard.geometry_bytes = 5;
  shard.number_bytes = 6;
  shard.resident_bytes = 7;
  shard.bounds = {Vec3(-0.1, 1e-300, 2.0 / 3.0), Vec3(6.4e6, 1.0, 2.0)};
  shard.largest_error = 0x1.fp-11;
  shard.geometry_hash = 0xfedcba9876543210ULL;
  shard.pages = {{shard.bounds, 64, 456, 0xffffffffffffffffULL, 1}, {shard.bounds, 2000, 784, 1, 2}};
  return shard;
}

Manifest some_manifest() {
  Manifest manifest;
  manifest.lossless = true;
  manifest.options = "up z, metres";
  manifest.bounds = {Vec3(-1.0), Vec3(1.0)};
  manifest.geometry_hash = 1;
  manifest.parts = {{"a \"quoted\" ünïcode.ply", "f", std::string(64, 'c'), 10, 40, 1},
                    {"b", "g", std::string(64, 'd'), 11, 2, 7}};
  manifest.shards = {some_shard(30), some_shard(12)};
  manifest.shards[1].pack = std::string(64, 'e');
  manifest.notes = {"A note."};
  return manifest;
}

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
    return error_of([&] { (void)parse_manifest(to_text(manifest), "m"); }) != "no error";
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
    const auto bytes = bytes_of(it->second);
    return {bytes.begin(), bytes.end()};
  }
  const char* read(const std::string&, std::uint64_t, std::span<std::byte>) override { return "nothing to read"; }

  std::map<std::string, std::string> files;
};

TEST(Publish, WhileAnotherReadsLeadsItToTheNewOne) {
  /// Publishes the next manifest, and removes the one before it, between the reading of CURRENT and of what it names.
  struct Republished : StoreBytes {
    std::map<std::string, std::string> files;
    std::vector<std::string> next;  ///< texts of manifests
    void publish() {
      const std::string hash = sha256(bytes_of(next.back()));
      files = {{"CURRENT", "roam store 1\n" + hash + "\n"}, {manifest_file(hash), next.back()}};
      next.pop_back();
    }
    std::vector<std::byte> whole(const std::string& file, std::uint64_t) override {
      const auto it = files.find(file);
      if (it == files.end()) throw Error(file + " is not there");
      const auto bytes = bytes_of(it->second);
      std::vector<std::byte> content(bytes.begin(), bytes.end());
      if (file == "CURRENT" && !next.empty()) publish();
      return content;
    }
    const char* read(const std::string&, std::uint64_t, std::span<std::byte>) override { return "not asked for"; }
  } bytes;
  for (const char* options : {"third", "second", "first"}) {
    Manifest manifest = some_manifest();
    manifest.options = options;
    bytes.next.push_back(to_text(manifest));
  }
  bytes.publish();
  EXPECT_EQ(read_manifest(bytes, "s").options, "third");
  bytes.files.erase(bytes.files.rbegin()->first);  // and one that is gone for good is an error
  EXPECT_NE(error_of([&] { (void)read_manifest(bytes, "s"); }), "no error");
}

TEST(Publish, EveryFlippedBitOfWhatIsReadFirstIsRefused) {
  const TemporaryFolder folder;
  const std::string hash = publish(folder.path(), some_manifest());
  Memory memory;
  for (const std::string& file : {std::string(current_file), manifest_file(hash)}) {
    memory.files[file] = text_of(folder.path() / file);
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

// --------------------------------------------------------------------------------------------------------- part files

PartFile some_part() {
  PartFile part;
  part.cell_bits = 42;
  std::mt19937_64 random(3);
  CurveKey key = 0;
  for (int i = 0; i < 1000; ++i) {
    key += CurveKey{1 + random() % 1000} << (random() % 20 + 42);
    part.cells.push_back({key, 1 + random() % 100});
    part.triangles += part.cells.back().triangles;
  }
  part.objects = {{0, "floor"}, {10, ""}, {11, "wall"}};
  return part;
}

TEST(PartFile, ComesBackAsItWas) {
  const PartFile part = some_part();
  const PartFile again = decode_part(encode_part(part), "p");
  EXPECT_EQ(again.triangles, part.triangles);
  EXPECT_EQ(again.cell_bits, part.cell_bits);
  ASSERT_EQ(again.cells.size(), part.cells.size());
  for (std::size_t i = 0; i < part.cells.size(); ++i) {
    EXPECT_TRUE(again.cells[i].key == part.cells[i].key);
    EXPECT_EQ(again.cells[i].triangles, part.cells[i].triangles);
  }
  EXPECT_EQ(again.object(0), "floor");
  EXPECT_EQ(again.object(9), "floor");
  EXPECT_EQ(again.object(10), "");
  EXPECT_EQ(again.object(1'000'000), "wall");
}

TEST(PartFile, SurvivesAnyBytes) {
  const std::vector<std::byte> good = encode_part(some_part());
  std::mt19937 random(5);
  for (std::size_t size = 0; size < good.size(); size += 7) {
    EXPECT_THROW((void)decode_part(std::span(good).first(size), "p"), Error);
  }
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::byte> bad = good;
    for (unsigned n = 0; n < 1 + random() % 3; ++n) bad[random() % bad.size()] ^= std::byte(1 + random() % 255);
    try {
      (void)decode_part(bad, "p");
    } catch (const Error&) {
    }
  }
}

}  // namespace
