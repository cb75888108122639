// Where memory runs out, in whatever thread, a store ends no program: what was asked for throws, or fails and is tried
// again. Instrumented builds have an operator new of their own, and test the rest.
#include <gtest/gtest.h>

#include <stdexcept>

#include "fallible_calls.h"
#include "pager_made.h"

namespace {

using namespace roam;

Mesh bumpy_square() {
  Mesh mesh;
  mesh.name = "square";
  for (std::uint32_t i = 0; i < 900; ++i) mesh.vertices.emplace_back(i % 30, i / 30, (i * 7919U) % 5);
  for (std::uint32_t i = 0; i + 31 < 900; ++i) mesh.triangles.push_back({i, i + 1, i + 30});
  return mesh;
}

class StoreAllocations : public testing::Test {
 protected:
  StoreAllocations() : folder_("allocations"), mesh_(bumpy_square()) {
    store_ = made::store(folder_.path(), {&mesh_, 1}, {.page_tiles = 4, .tile_triangles = 100});
  }

  const made::Folder folder_;
  const Mesh mesh_;
  std::shared_ptr<const Store> store_;
};

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

TEST_F(StoreAllocations, OpeningReturnsWhereverOneFails) {
  fail_calls({{"open", [&] { return std::string(Bits() << Store::open(folder_.path())->info().triangles); }}});
  store::Manifest manifest = store::read_manifest(*store::files_of(folder_.path()), "s");
  manifest.shards[0].pages[1].tiles = 0;
  store::publish(folder_.path(), manifest);
  fail_calls({{"open of a manifest that is refused in the middle",
               [&] { return refusal_of([&] { static_cast<void>(Store::open(folder_.path())); }); }}});
}

TEST_F(StoreAllocations, VerifyingFindingASourceAndMakingAPagerReturnWhereverOneFails) {
  TriangleId some = 0;
  store_->for_each_triangle(store_->info().bounds, [&](auto, auto ids) { some = ids[0]; });
  fail_calls({
      {.name = "verify_store",
       .bits = [&] { return std::string(Bits() << verify_store(folder_.path()).whole()); },
       .later = true,
       .dense = 50},
      {"source", [&] { return std::string(Bits() << Store::open(folder_.path())->source(some).number); }},
      {"a pager",
       [&] {
         const Pager pager(store_, {.memory = Pager::least_memory, .loaders = 3});
         return std::string(Bits() << pager.stats().tiles);
       }},
  });
}

TEST_F(StoreAllocations, ALoadingThreadGoesOnWhereverOneFails) {
  const auto load = [&] {
    const Spare spare;
    const auto bytes = std::make_shared<made::TroubledBytes>(folder_.path());  // which has no file open yet
    const auto opened = store::open_store(bytes, "s");
    bytes->hold();
    Pager pager(opened, {.memory = Pager::least_memory});
    const auto until = [&](const std::function<bool()>& done) {
      return made::update_until(pager, {0.3, 0.0}, pager.bounds().center(), done);
    };
    EXPECT_TRUE(until([&] { return bytes->waiting() > 0; }));
    bytes->let_go();
    std::string name;
    const auto loaded = [&] {
      name = pager.object_name(0);
      return pager.stats().tiles == opened->info().tiles;
    };
    EXPECT_TRUE(until([&] { return loaded() || (failing_allocation > 0 && allocations >= failing_allocation); }));
    failing_allocation = 0;
    EXPECT_TRUE(until([&] { return loaded() && name == "square"; }));
    return std::string("all");
  };
  fail_calls({{.name = "a thread that loads", .bits = load, .throws = false, .dense = 12, .steps = 2, .most = 59}});
}

#endif

/// Throws where it should answer.
class ThrowingBytes : public store::StoreBytes {
 public:
  explicit ThrowingBytes(const std::filesystem::path& folder) : files_(store::files_of(folder)) {}
  std::vector<std::byte> whole(const std::string& file, std::uint64_t limit) override {
    return files_->whole(file, limit);
  }
  const char* read(const std::string& file, std::uint64_t offset, std::span<std::byte> out,
                   const std::stop_token& /*stop*/) override {
    switch (throws.load()) {
      case 1:
        throw std::runtime_error("the tape is torn in metre " + std::to_string(++count_));
      case 2:
        throw std::bad_alloc();
      case 3:
        throw 42;
      default:
        return files_->read(file, offset, out);
    }
  }
  std::atomic<int> throws{0};

 private:
  std::shared_ptr<store::StoreBytes> files_;
  std::atomic<int> count_{0};
};

TEST_F(StoreAllocations, BytesThatThrowAreLikeBytesThatCannotBeRead) {
  const auto bytes = std::make_shared<ThrowingBytes>(folder_.path());
  const auto opened = store::open_store(bytes, "s");
  for (const int throws : {1, 2, 3}) {
    bytes->throws = throws;
    Pager pager(opened, {.memory = Pager::least_memory, .loaders = 2});
    const Vec3 middle = pager.bounds().center();
    ASSERT_TRUE(made::update_until(pager, {0.3, 0.0}, middle, [&] { return pager.stats().failures > 3; }));
    const std::string why = pager.stats().last_failure;
    EXPECT_NE(why.find(throws == 1 ? "the tape is torn in metre" : "cannot be used: "), std::string::npos) << why;
    EXPECT_TRUE(pager.sweep({0.3, 0.0}, middle + Vec3(0.0, 0.0, 20.0), {0.0, 0.0, -40.0}).unknown);
    static_cast<void>(pager.object_name(0));
    bytes->throws = 0;
    ASSERT_NO_FATAL_FAILURE(made::load_all(pager));
  }
}

}  // namespace
