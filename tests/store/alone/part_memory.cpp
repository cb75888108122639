// A part file takes no more memory than what it holds, whatever it claims.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>

#include "packed_part.h"
#include "roam/error.h"
#include "store/part.h"

namespace {

std::atomic<std::size_t> largest{0};

}  // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which have an operator new of their own
// Not inlined: g++ takes malloc and free that it sees through them for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (size > largest) largest = size;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
#endif

namespace {

using namespace roam::store;

TEST(PartFileMemory, IsBoundedByWhatTheFileHolds) {
  PartFile part;
  for (int i = 0; i < 3000; ++i)
    part.objects.push_back({part.triangles + static_cast<unsigned>(i), "wall " + std::to_string(i * 7919)});
  part.triangles = 4000;
  part.cells.push_back({0, 4000});
  std::vector<std::byte> bytes = encode_part(part);
  ASSERT_EQ(decode_part(bytes, "p").objects.size(), 3000U);
  ASSERT_GT(bytes.size(), 8192U);
  // Objects, cells, bytes before compression.
  for (const std::size_t field : {16U, 24U, 40U}) {
    for (const std::uint64_t claim : {std::uint64_t{1} << 30, std::uint64_t{1} << 62}) {
      std::vector<std::byte> hostile = bytes;
      std::memcpy(hostile.data() + field, &claim, sizeof claim);
      largest = 0;
      EXPECT_THROW(static_cast<void>(decode_part(hostile, "p")), roam::Error) << field;
      EXPECT_LT(largest, std::size_t{4} << 20) << field;
    }
  }
}

TEST(PartFileMemory, EveryLengthButItsOwnIsRefused) {
  PartFile part;
  part.triangles = 5;
  part.objects.push_back({0, "wall"});
  part.cells.push_back({0, 5});
  const std::vector<std::byte> bytes = encode_part(part);
  for (std::size_t size = 0; size < bytes.size() + 3; ++size) {
    std::vector<std::byte> other = bytes;
    other.resize(size);
    if (size == bytes.size()) continue;
    EXPECT_THROW(static_cast<void>(decode_part(other, "p")), roam::Error) << size;
  }
}

}  // namespace
