// The cache on the disk: whole entries or none, of a fixed size, for several processes at once.

#include "store/web/disk_cache.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "roam/error.h"
#include "store_made.h"

namespace {

using roam::web::DiskCache;

std::string key_of(std::uint64_t n) {
  std::string key = std::to_string(n);
  return key + std::string(DiskCache::key_bytes - key.size(), 'k');
}

/// The only content that the key may have.
std::vector<std::byte> content_of(std::uint64_t n) {
  std::vector<std::byte> bytes(1000 + n * 7919 % 60000);
  std::uint64_t x = n * 0x9E3779B97F4A7C15ULL + 1;
  for (std::byte& b : bytes) {
    x = x * 6364136223846793005ULL + 1442695040888963407ULL;
    b = static_cast<std::byte>(x >> 56);
  }
  return bytes;
}

/// Whether the entry is there. Fails if it is wrong.
bool is_there(DiskCache& cache, std::uint64_t n) {
  const auto right = content_of(n);
  std::vector<std::byte> found(right.size());
  const bool there = cache.find(key_of(n), found);
  if (there) {
    EXPECT_EQ(found, right) << n;
  }
  const auto any = cache.find(key_of(n), 1 << 20);
  if (any) {
    EXPECT_EQ(*any, right) << n;
  }
  return there;
}

TEST(DiskCache, KeepsTheNewestWithinItsSize) {
  const made::Folder folder("disk_cache");
  const auto file = folder.path() / "deep" / "er" / "cache";
  constexpr std::uint64_t bytes = 4 << 20;
  DiskCache cache(file, bytes);
  EXPECT_FALSE(is_there(cache, 1));
  for (std::uint64_t n = 0; n < 1000; ++n) {
    cache.keep(key_of(n), content_of(n));
    EXPECT_TRUE(is_there(cache, n)) << n;
    EXPECT_LE(std::filesystem::file_size(file), bytes);
  }
  int there = 0;
  for (std::uint64_t n = 0; n < 1000; ++n) there += is_there(cache, n) ? 1 : 0;
  EXPECT_GT(there, 80);
  EXPECT_LT(there, 150);
  EXPECT_EQ(std::filesystem::status(file).permissions(), std::filesystem::perms(0600));
  DiskCache again(file, bytes);
  EXPECT_TRUE(is_there(again, 999));
  std::vector<std::byte> other(10);
  EXPECT_FALSE(again.find(key_of(999), other));
  again.keep(key_of(1), std::vector<std::byte>(3 << 20));  // more than its part: not kept
  EXPECT_FALSE(again.find(key_of(1), 4 << 20));
}

TEST(DiskCache, KeepsTheFirstAsLongAsThereIsRoom) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const made::Folder folder("disk_cache_first");
    DiskCache cache(folder.path() / "cache", 4 << 20);
    for (std::uint64_t n = 0; n < 30; ++n) cache.keep(key_of(1000 * seed + n), content_of(1000 * seed + n));
    for (std::uint64_t n = 0; n < 30; ++n) EXPECT_TRUE(is_there(cache, 1000 * seed + n)) << seed << ' ' << n;
  }
}

TEST(DiskCache, WhatIsUsedStays) {
  const made::Folder folder("disk_cache_used");
  DiskCache cache(folder.path() / "cache", 4 << 20);
  for (std::uint64_t n = 0; n < 1000; ++n) {
    cache.keep(key_of(n), content_of(n));
    cache.keep(key_of(0), content_of(0));
    EXPECT_TRUE(is_there(cache, 0));
  }
}

TEST(DiskCache, AnotherSizeBeginsAnew) {
  const made::Folder folder("disk_cache_size");
  const auto file = folder.path() / "cache";
  DiskCache large(file, 16 << 20);
  large.keep(key_of(1), content_of(1));
  DiskCache small(file, 4 << 20);
  EXPECT_EQ(std::filesystem::file_size(file), 4U << 20);
  EXPECT_FALSE(is_there(small, 1));
  // The first goes on in the smaller file.
  for (std::uint64_t n = 0; n < 500; ++n) large.keep(key_of(n), content_of(n));
  EXPECT_EQ(std::filesystem::file_size(file), 4U << 20);
  EXPECT_TRUE(is_there(small, 499));
}

TEST(DiskCache, OverwritesNothingElse) {
  const made::Folder folder("disk_cache_other");
  const auto file = folder.path() / "cache";
  std::ofstream(file) << "a letter to a friend, longer than a header of a cache, which nobody wants to lose";
  EXPECT_THROW(DiskCache(file, 4 << 20), roam::Error);
  std::filesystem::create_symlink("elsewhere", folder.path() / "link");
  EXPECT_THROW(DiskCache(folder.path() / "link", 4 << 20), roam::Error);
  std::filesystem::create_hard_link(file, folder.path() / "hard");
  EXPECT_THROW(DiskCache(folder.path() / "hard", 4 << 20), roam::Error);
  EXPECT_THROW(DiskCache(folder.path() / "small", 100), roam::Error);
}

TEST(DiskCache, SurvivesKilledProcessesAtOnce) {
  const made::Folder folder("disk_cache_killed");
  const auto file = folder.path() / "cache";
  constexpr std::uint64_t bytes = 4 << 20;
  DiskCache cache(file, bytes);
  for (int round = 0; round < 10; ++round) {
    std::vector<pid_t> writers;
    for (int writer = 0; writer < 3; ++writer) {
      const pid_t made = ::fork();
      if (made == 0) {
        DiskCache own(file, bytes);
        for (std::uint64_t n = static_cast<std::uint64_t>(writer);; n += 2)
          own.keep(key_of(n % 300), content_of(n % 300));
      }
      writers.push_back(made);
    }
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(60 + 13 * round);
    for (std::uint64_t n = 0; std::chrono::steady_clock::now() < end; ++n) static_cast<void>(is_there(cache, n % 300));
    for (const pid_t writer : writers) {
      ::kill(writer, SIGKILL);
      ::waitpid(writer, nullptr, 0);
    }
    cache.keep(key_of(7), content_of(7));
    EXPECT_TRUE(is_there(cache, 7));
    EXPECT_LE(std::filesystem::file_size(file), bytes);
  }
}

TEST(DiskCache, ReadsNoDamagedEntry) {
  const made::Folder folder("disk_cache_damage");
  const auto file = folder.path() / "cache";
  for (std::uint64_t seed = 1; seed < 60; ++seed) {
    DiskCache cache(file, 4 << 20);
    for (std::uint64_t n = 0; n < 20; ++n) cache.keep(key_of(n), content_of(n));
    std::fstream damage(file, std::ios::in | std::ios::out | std::ios::binary);
    std::uint64_t x = seed * 0x9E3779B97F4A7C15ULL;
    // In the table and in the entries, also in the header.
    for (int i = 0; i < 30; ++i) {
      x = x * 6364136223846793005ULL + 1442695040888963407ULL;
      const std::uint64_t at = i == 0 ? x >> 40 & 31 : (x >> 33) % (800 << 10);
      damage.seekp(static_cast<std::streamoff>(at)).put(static_cast<char>(x >> 24));
    }
    damage.close();
    for (std::uint64_t n = 0; n < 20; ++n) static_cast<void>(is_there(cache, n));
    std::filesystem::resize_file(file, seed % 3 == 0 ? 100 : 4 << 20);
    for (std::uint64_t n = 0; n < 20; ++n) static_cast<void>(is_there(cache, n));
    std::filesystem::remove(file);
  }
}

TEST(DiskCache, NobodyWaitsForTheLock) {
  const made::Folder folder("disk_cache_lock");
  const auto file = folder.path() / "cache";
  DiskCache cache(file, 4 << 20);
  cache.keep(key_of(1), content_of(1));
  const roam::files::Descriptor other(::open(file.c_str(), O_RDWR | O_CLOEXEC));
  ASSERT_EQ(::flock(other.number(), LOCK_EX), 0);
  const auto begin = std::chrono::steady_clock::now();
  cache.keep(key_of(2), content_of(2));
  EXPECT_FALSE(is_there(cache, 2));
  DiskCache same(file, 4 << 20);
  EXPECT_TRUE(is_there(same, 1));
  DiskCache larger(file, 8 << 20);
  larger.keep(key_of(1), content_of(1));
  EXPECT_FALSE(is_there(larger, 1));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
  ASSERT_EQ(::flock(other.number(), LOCK_UN), 0);
  cache.keep(key_of(2), content_of(2));
  EXPECT_TRUE(is_there(cache, 2));
}

TEST(DiskCache, ZerosOfAPowerCutAreAnEmptyCache) {
  const made::Folder folder("disk_cache_zeros");
  const auto file = folder.path() / "cache";
  static_cast<void>(DiskCache(file, 4 << 20));
  std::filesystem::resize_file(file, 0);
  std::filesystem::resize_file(file, 4 << 20);
  DiskCache cache(file, 4 << 20);
  cache.keep(key_of(1), content_of(1));
  EXPECT_TRUE(is_there(cache, 1));
}

TEST(DiskCache, OthersMayNotWriteToIt) {
  using std::filesystem::perms;
  const made::Folder folder("disk_cache_rights");
  const auto file = folder.path() / "cache";
  for (const perms right : {perms::group_write, perms::others_write}) {
    static_cast<void>(DiskCache(file, 4 << 20));
    std::filesystem::permissions(file, perms(0600) | right);
    EXPECT_THROW(DiskCache(file, 4 << 20), roam::Error);
    std::filesystem::remove(file);
  }
}

}  // namespace
