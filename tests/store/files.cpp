// A store's files: whole or absent; packs; the build lock.
#include "store/files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <random>

#include "import_files.h"
#include "messages.h"

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
std::size_t count_files(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
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
  EXPECT_EQ(count_files(folder.path()), 0U) << "what was not committed is removed";
  NewFile file(path.parent_path(), path.filename());
  file.write(bytes_of("who"));
  file.write(bytes_of("le"));
  file.commit();
  EXPECT_EQ(text_of(path), "whole");
  EXPECT_EQ(count_files(folder.path()), 1U);
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

TEST(FileHashes, ReadAFileWithManyNamesOnce) {
  const TemporaryFolder folder;
  const fs::path path = folder.write("0.pack", "abc");
  for (int i = 1; i < 50; ++i) fs::create_hard_link(path, folder.path() / fmt::format("{}.pack", i));
  folder.write("other.pack", "ab");
  FileHashes hashes(folder.path());
  std::atomic<std::uint64_t> bytes{0};
  tbb::parallel_for(0, 50, [&](int i) {
    EXPECT_EQ(hashes.sha256(fmt::format("{}.pack", i), [&](std::uint64_t read) { bytes += read; }),
              sha256(bytes_of("abc")));
  });
  EXPECT_EQ(bytes, 3U);
  EXPECT_EQ(hashes.sha256("other.pack"), sha256(bytes_of("ab")));
  EXPECT_NE(error_of([&] { static_cast<void>(hashes.sha256("none.pack")); }).find("none.pack"), std::string::npos);
}

TEST(FileHashes, EndWhenTheCallerDoes) {
  const TemporaryFolder folder;
  folder.write("a.pack", "abc");
  FileHashes hashes(folder.path());
  EXPECT_THROW(static_cast<void>(hashes.sha256("a.pack", [](std::uint64_t) { throw roam::Cancelled(); })),
               roam::Cancelled);
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
    static_cast<void>(!::write(pipe_ends[1], &ready, 1));
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

}  // namespace
