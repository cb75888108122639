// Loading threads that cannot be started, and names that could not be read at first.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <cerrno>

#include "pager_made.h"
#include "store/pager/names.h"
#include "store/pager/residents.h"
#include "walker_scenes.h"

namespace {

/// The n-th thread that is started from now on fails; 0: none does.
std::atomic<int> failing_thread{0};

}  // namespace

// Takes the place of the C library's in this program.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*), void* with) {
  if (failing_thread > 0 && --failing_thread == 0) return EAGAIN;
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto real = reinterpret_cast<Create>(::dlsym(RTLD_NEXT, "pthread_create"));
  return real(thread, attributes, run, with);
}

namespace {

using namespace roam;

Mesh floor_of_tiles() {
  Mesh mesh;
  mesh.name = "floor";
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) scenes::add_floor(mesh, i, j, i + 1.0, j + 1.0, 0.0);
  }
  return mesh;
}

TEST(PagerThreads, ThatCannotBeStartedAreAnErrorAndThoseThatRunEnd) {
  const made::Folder folder("pager_threads");
  const Mesh mesh = floor_of_tiles();
  made::store(folder.path(), {&mesh, 1}, {});
  const auto store = Store::open(folder.path());
  for (const int n : {1, 2, 3, 4}) {
    failing_thread = n;
    try {
      const Pager pager(store, {.memory = 16u << 20, .loaders = 3});
      ADD_FAILURE() << "there are all threads, though one could not be started";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("loading thread " + std::to_string(n) + " of 4"), std::string::npos)
          << error.what();
    }
  }
  failing_thread = 0;
  Pager pager(store, {.memory = 16u << 20, .loaders = 3});
  made::load_all(pager);
}

/// Part files cannot be read as long as it is said so.
class NoParts : public store::StoreBytes {
 public:
  explicit NoParts(const std::filesystem::path& folder) : files_(store::files_of(folder)) {}
  std::atomic<bool> broken{true}, slow{false};
  std::vector<std::byte> whole(const std::string& file, std::uint64_t limit) override {
    return files_->whole(file, limit);
  }
  const char* read(const std::string& file, std::uint64_t offset, std::span<std::byte> out,
                   const std::stop_token& /*stop*/) override {
    while (slow && file.starts_with("parts/")) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (broken && file.starts_with("parts/")) return "not now";
    return files_->read(file, offset, out);
  }

 private:
  std::shared_ptr<store::StoreBytes> files_;
};

TEST(PagerNames, ThatCouldNotBeReadAreReadAgainWhenSomebodyAsks) {
  const made::Folder folder("pager_names");
  const Mesh mesh = floor_of_tiles();
  made::store(folder.path(), {&mesh, 1}, {});
  const auto bytes = std::make_shared<NoParts>(folder.path());
  Pager pager(store::open_store(bytes, "yard"), {.memory = 16u << 20});
  made::load_all(pager);
  const Impact below = pager.sweep({0.3, 0.0}, {5.0, 5.0, 2.0}, {0.0, 0.0, -3.0});
  ASSERT_TRUE(below.hit && !below.unknown);
  const auto named_within = [&](int tries) {
    for (int i = 0; i < tries; ++i) {
      if (pager.object_name(below.triangle) == "floor") return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  };
  EXPECT_FALSE(named_within(20));
  bytes->broken = false;
  EXPECT_TRUE(named_within(3000));
}

TEST(PagerNames, AreFoundByKindAndTheLastOneFirst) {
  paging::Names names;
  const TriangleId place = paging::unknown_bit | 5;
  for (const TriangleId id : {TriangleId{1}, TriangleId{2}, place}) EXPECT_EQ(names.ask(id), "");
  std::vector<TriangleId> found;
  const auto find = [&](TriangleId id) -> std::optional<std::string> {
    found.push_back(id);
    return std::to_string(id);
  };
  EXPECT_TRUE(names.serve(paging::Names::Kind::reason, find));
  EXPECT_FALSE(names.serve(paging::Names::Kind::reason, find));
  EXPECT_TRUE(names.serve(paging::Names::Kind::object, find));
  EXPECT_TRUE(names.serve(paging::Names::Kind::object, find));
  EXPECT_FALSE(names.serve(paging::Names::Kind::object, find));
  EXPECT_EQ(found, (std::vector<TriangleId>{place, 2, 1}));
  EXPECT_EQ(names.ask(1), "1");
}

TEST(PagerNames, ThatTakeLongKeepNoTileWaiting) {
  const made::Folder folder("pager_slow");
  const Mesh mesh = floor_of_tiles();
  made::store(folder.path(), {&mesh, 1}, {.page_tiles = 4, .tile_triangles = 50});
  const auto bytes = std::make_shared<NoParts>(folder.path());
  bytes->broken = false;
  bytes->slow = true;
  const auto store = store::open_store(bytes, "yard");
  TriangleId some = no_triangle;
  store->for_each_triangle(store->info().bounds, [&](auto, auto ids) { some = ids[0]; });
  Pager pager(store, {.memory = 16u << 20, .loaders = 1});
  EXPECT_EQ(pager.object_name(some), "");
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_TRUE(made::update_until(pager, {0.3, 0.0}, {10.0, 10.0, 1.0}, [&] { return pager.stats().tiles > 0; }));
  bytes->slow = false;
}

}  // namespace
