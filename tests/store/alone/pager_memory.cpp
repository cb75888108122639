// A pager takes its memory when it is made. After that the thread that moves the body allocates nothing, whatever comes
// and goes, and the process does not grow.

#include <gtest/gtest.h>
#include <malloc.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "clutter.h"
#include "pager_made.h"
#include "roam/generate.h"
#include "roam/walker.h"
#include "sanitizer.h"
#include "store/pager/names.h"

namespace {

thread_local bool counting = false;
thread_local long allocations = 0;
thread_local long held_bytes = 0;  // allocated by this thread, less what it has freed

}  // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which have an operator new of their own
namespace {

void* taken(void* p) {
  if (counting) ++allocations;
  if (p == nullptr) throw std::bad_alloc();
  held_bytes += static_cast<long>(::malloc_usable_size(p));
  return p;
}

void give_back(void* p) {
  held_bytes -= static_cast<long>(::malloc_usable_size(p));
  std::free(p);
}

}  // namespace

// Those of arrays call these. Not inlined: g++ takes malloc and free that it sees through them for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t bytes) { return taken(std::malloc(bytes > 0 ? bytes : 1)); }
[[gnu::noinline]] void* operator new(std::size_t bytes, std::align_val_t alignment) {
  const auto a = static_cast<std::size_t>(alignment);
  return taken(std::aligned_alloc(a, (bytes + a - 1) / a * a));
}
[[gnu::noinline]] void operator delete(void* p) noexcept { give_back(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { give_back(p); }
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { give_back(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept { give_back(p); }
#endif

namespace {

using roam::Body;
using roam::Pager;
using roam::Vec3;

/// Bytes of this process that are in memory.
std::uint64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  file >> all >> resident;
  return resident * 4096;
}

TEST(PagerMemory, NothingIsAllocatedAndTheProcessDoesNotGrow) {
  ROAM_NEEDS_PLAIN_MEMORY();
  const made::Folder folder("pager_memory");
  const auto meshes = roam::generate::collect(roam::generate::gallery({.triangles = 800'000, .seed = 2}));
  const auto store = made::store(folder.path(), meshes, {.page_tiles = 16, .tile_triangles = 4000});
  ASSERT_GT(store->info().resident_bytes, 7u << 20) << "nothing would have to go";
  Pager pager(store, {.memory = Pager::least_memory});
  counting = true;
  ::operator delete (::operator new (256, std::align_val_t{128}), std::align_val_t{128});
  counting = false;
  ASSERT_EQ(std::exchange(allocations, 0), 1) << "an aligned one is counted, too";
  const std::uint64_t memory = pager.stats().memory;
  EXPECT_LE(memory, Pager::least_memory);
  EXPECT_GT(memory, Pager::least_memory / 10 * 9);
  clutter::Random random(1);
  std::array<roam::Contact, 16> contacts;
  std::uint64_t grown_from = 0;
  roam::Impact impact;
  for (int i = 0; i < 3000; ++i) {
    const roam::Mesh& mesh = meshes[random.engine() % meshes.size()];
    const Vec3 place = mesh.vertices[random.engine() % mesh.vertices.size()] + random.in_box(2.0);
    const Body body{0.3, 0.6};
    const Vec3 motion = 5.0 * random.direction(), velocity = 20.0 * random.direction();
    const bool walks = i % 50 != 0;  // a walker's own copies of settings are no business of this test
    counting = walks;
    for (int k = 0; k < 4; ++k) {
      (void)pager.update(body, place + 0.1 * k * velocity, velocity);
      impact = pager.sweep(body, place, motion);
      (void)pager.clearance(body, place, motion, 1.0);
      (void)pager.gap_bound(body, place, motion, 1.0);
      (void)pager.contacts(body, place, motion, 0.5, contacts);
    }
    counting = false;
    if (i == 500) grown_from = resident_bytes();
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
  const auto stats = pager.stats();
  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(stats.memory, memory);
  EXPECT_LE(stats.used, memory);
  EXPECT_GT(stats.evictions, 300u);
  EXPECT_LT(resident_bytes(), grown_from + (512u << 10));
}

TEST(PagerMemory, KeepsOnlyTheBeginningsOfLongNames) {
  ROAM_NEEDS_PLAIN_MEMORY();
  std::string longest = "x";  // no character ends after 1024 bytes
  for (int i = 0; i < 32'767; ++i) longest += "\u00fc";
  roam::paging::Names names;
  const long before = held_bytes;
  for (roam::TriangleId triangle = 1; triangle <= 64; ++triangle) {
    EXPECT_EQ(names.ask(triangle), "");
    EXPECT_TRUE(names.serve(roam::paging::Names::Kind::object, [&](auto) { return std::optional(longest); }));
  }
  EXPECT_LT(held_bytes - before, 64 * 1100);
  EXPECT_TRUE(names.ask(1) == longest.substr(0, 1023));
}

}  // namespace
