// Where memory runs out, work on a store throws. The store in the folder is whole, the old one or the new one, and the
// same call completes it. Instrumented builds have an operator new of their own.
#include <gtest/gtest.h>

#include "fallible_calls.h"
#include "pager_made.h"
#include "store_builds.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

using namespace store_builds;

std::string bits_of(const std::string& store) {
  const Spare spare;
  std::string all;
  for (const auto& [name, text] : content(store))
    all += name + " " + std::to_string(std::hash<std::string>()(text)) + "\n";
  return all;
}

/// The first ones of a build and of a publication. Later ones may fail while JSON is freed, which ends the program: see
/// docs/guarantees.md.
constexpr long most_allocations = 300;

class StoreBuildAllocations : public testing::Test {
 protected:
  StoreBuildAllocations() {
    write_ply(a_, field(24, 0.5, {0.0, 0.0, 0.0}));
    write_ply(b_, field(16, 0.5, {40.0, 0.0, 0.0}));
    write_ply(c_, field(16, 0.5, {60.0, 0.0, 0.0}));
  }
  [[nodiscard]] std::string built(const std::string& second) const {
    roam::StoreBuildOptions how = options({a_, second}, store_);
    how.threads = 2;
    roam::build_store(how);
    return bits_of(store_);
  }

  const TestFolder folder_;
  const std::string a_ = folder_.file("a.ply"), b_ = folder_.file("b.ply"), c_ = folder_.file("c.ply"),
                    store_ = folder_.file("s");
};

TEST_F(StoreBuildAllocations, AStoreIsBegunOrNotAndGoesOn) {
  fail_calls({{.name = "build_store",
               .bits = [&] { return built(b_); },
               .after =
                   [&](bool failed) {
                     EXPECT_EQ(fs::exists(store_ + "/CURRENT"), !failed);
                     if (!failed) fs::remove_all(store_);  // a store that was begun is gone on with
                   },
               .dense = 5,
               .steps = 2,
               .most = most_allocations}});
}

TEST_F(StoreBuildAllocations, AnOldStoreStaysOrIsReplaced) {
  const std::string kept = folder_.file("kept");
  static_cast<void>(built(b_));
  const auto old = roam::Store::open(store_)->info().hash;
  fs::copy(store_, kept, fs::copy_options::recursive);
  fail_calls({{.name = "build_store of another scene",
               .bits = [&] { return built(c_); },
               .after =
                   [&](bool failed) {
                     EXPECT_TRUE(roam::verify_store(store_).whole());
                     EXPECT_EQ(roam::Store::open(store_)->info().hash == old, failed);
                     fs::remove_all(store_);
                     fs::copy(kept, store_, fs::copy_options::recursive);
                   },
               .dense = 5,
               .steps = 2,
               .most = most_allocations}});
}

TEST_F(StoreBuildAllocations, ACopyIsPublishedOrNotAndGoesOn) {
  const std::string whole = built(b_), copy = folder_.file("copy");
  fail_calls({{.name = "publish_store",
               .bits =
                   [&] {
                     roam::publish_store(store_, copy);
                     return bits_of(copy);
                   },
               .after =
                   [&](bool failed) {
                     // A copy that was begun is gone on with.
                     if (!fs::exists(copy + "/CURRENT")) {
                       EXPECT_TRUE(failed);
                       return;
                     }
                     EXPECT_TRUE(failed ? roam::verify_store(copy).whole() : bits_of(copy) == whole);
                     fs::remove_all(copy);
                   },
               .dense = 5,
               .steps = 2,
               .most = most_allocations}});
}

TEST_F(StoreBuildAllocations, ReadingThrowsAndThePagerGoesOn) {
  static_cast<void>(built(b_));
  const auto store = roam::Store::open(store_);
  roam::Pager pager(store, {.memory = roam::Pager::least_memory});
  made::load_all(pager);
  const roam::Box all = store->info().bounds;
  fail_calls({
      {"for_each_triangle",
       [&] {
         std::uint64_t count = 0, sum = 0;
         store->for_each_triangle(all, [&](auto, auto ids) {
           count += ids.size();
           for (const auto id : ids) sum += id;
         });
         return std::string(Bits() << count << sum);
       }},
      {"sample", [&] { return std::string(Bits() << store->sample(5).at(0)); }},
      {"is_authentic and is_store",
       [&] {
         return std::string(Bits() << store->is_authentic({}) << roam::Store::is_store(store_)
                                   << roam::Store::is_store(a_));
       }},
      {"stats and object_name of a pager",
       [&] {
         // Another thread finds the name, sooner or later.
         const std::string name = pager.object_name(3);
         EXPECT_TRUE(name.empty() || name == "a") << name;
         return pager.stats().last_failure + " and a text too long for no allocation";
       }},
  });
  EXPECT_TRUE(made::update_until(pager, {0.3, 0.0}, all.center(), [&] { return pager.object_name(3) == "a"; }));
}

}  // namespace
#endif
