// A store that is not as it was written: refused, or no answer changes. Every bit of a small store, and damage at
// random. ROAM_TEST_DAMAGES says how many random ones, e.g. 100000.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

#include "clutter.h"
#include "pager_made.h"

namespace {

namespace fs = std::filesystem;
using roam::Box;
using roam::Mesh;
using roam::Pager;
using roam::Triangle;
using roam::TriangleId;
using roam::Vec3;

using Bytes = std::vector<std::byte>;
using Files = std::map<std::string, Bytes>;

/// A store in memory.
class MemoryBytes : public roam::store::StoreBytes {
 public:
  explicit MemoryBytes(Files files) : files_(std::move(files)) {}

  std::vector<std::byte> whole(const std::string& file, std::uint64_t limit) override {
    const auto it = files_.find(file);
    if (it == files_.end()) throw roam::Error("there is no " + file);
    if (it->second.size() > limit) throw roam::Error(file + " is too large");
    return it->second;
  }
  const char* read(const std::string& file, std::uint64_t offset, std::span<std::byte> out,
                   const std::stop_token& /*stop*/) override {
    const auto it = files_.find(file);
    if (it == files_.end()) return "the file is not there";
    if (offset > it->second.size() || out.size() > it->second.size() - offset) return "the file is too short";
    std::memcpy(out.data(), it->second.data() + offset, out.size());
    return nullptr;
  }

 private:
  Files files_;
};

Files files_in(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    Bytes& bytes = files[entry.path().lexically_relative(folder).string()];
    bytes.resize(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
  }
  return files;
}

void write(const fs::path& file, const Bytes& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

struct Sweep {
  Vec3 from, motion;
  roam::Impact answer;
};

class StoreDamageBits : public testing::Test {
 protected:
  StoreDamageBits() : folder_("store_damage") {
    clutter::Random random(1);
    const Mesh mesh = clutter::make(random, {120, 3.0, 0.3, 2.0, Vec3(0.0)});
    made::store(folder_.path(), {&mesh, 1}, {.page_tiles = 4, .tile_triangles = 12});
    good_ = files_in(folder_.path());
    const auto store = open(good_);
    triangles_ = *triangles_of(*store);
    Pager pager(store, {.memory = Pager::least_memory});
    load(pager);
    EXPECT_EQ(pager.stats().tiles, store->info().tiles) << "the comparison is of all";
    for (int i = 0; i < 120; ++i) {
      Sweep sweep{random.in_box(3.0), random.in_box(8.0), {}};
      sweep.answer = pager.sweep(body, sweep.from, sweep.motion);
      hits_ += sweep.answer.hit ? 1 : 0;
      sweeps_.push_back(sweep);
    }
    EXPECT_GT(hits_, 10);
    EXPECT_LT(hits_, 110);
  }

  static std::shared_ptr<const roam::Store> open(const Files& files) {
    return roam::store::open_store(std::make_shared<MemoryBytes>(files), "damaged");
  }
  /// Until everything is there, or something failed and no more has come for a while.
  static void load(Pager& pager) {
    const std::uint64_t all = pager.store().info().tiles;
    std::uint64_t came = 0;
    int still = 0;
    (void)made::update_until(
        pager, body, Vec3(0.0),
        [&] {
          const roam::PagerStats stats = pager.stats();
          still = stats.loads == came ? still + 1 : 0;
          came = stats.loads;
          return stats.tiles == all || (stats.failures > 0 && still > 10);
        },
        Vec3(20.0, 0.0, 0.0));
  }

  /// All, and where each comes from; nothing where the store says that it is damaged.
  static std::optional<std::vector<std::pair<Triangle, std::string>>> triangles_of(const roam::Store& store) {
    std::vector<std::pair<Triangle, std::string>> all;
    try {
      store.for_each_triangle(
          {Vec3(-1e3), Vec3(1e3)}, [&](std::span<const Triangle> triangles, std::span<const TriangleId> ids) {
            for (std::size_t i = 0; i < ids.size(); ++i) {
              const auto from = store.source(ids[i]);
              all.emplace_back(triangles[i], from.part + '/' + from.object + '/' + std::to_string(from.number) + '/' +
                                                 std::to_string(from.scene));
            }
          });
    } catch (const roam::Error& e) {
      EXPECT_STRNE(e.what(), "");
      return std::nullopt;
    }
    return all;
  }

  /// Whatever the files hold: an error, unknown, or what the whole store answers.
  void expect_no_wrong_answer(const Files& files, bool asks_pager) {
    std::shared_ptr<const roam::Store> store;
    try {
      store = open(files);
    } catch (const roam::Error& e) {
      EXPECT_STRNE(e.what(), "");
      ++refused_;
      return;
    }
    if (const auto triangles = triangles_of(*store)) {
      ASSERT_TRUE(*triangles == triangles_);
    } else {
      ++named_;
    }
    if (!asks_pager) return;
    std::optional<Pager> pager;
    try {
      pager.emplace(store, roam::PagerOptions{.memory = Pager::least_memory});
    } catch (const roam::Error&) {
      return;
    }
    load(*pager);
    for (const Sweep& s : sweeps_) {
      const roam::Impact now = pager->sweep(body, s.from, s.motion);
      ASSERT_TRUE(now.unknown || now.hit == s.answer.hit);
      if (!now.hit) continue;
      // What is unknown is met before what is behind it, and is never beyond it.
      if (s.answer.hit) {
        ASSERT_LE(now.time * glm::length(s.motion), s.answer.time * glm::length(s.motion) + hit_tolerance);
      }
      // How near a sweep stops depends on what it meets on its way there, by less than this.
      if (!now.unknown) {
        ASSERT_NEAR(now.time * glm::length(s.motion), s.answer.time * glm::length(s.motion), hit_tolerance);
      }
    }
    ++asked_;
  }

  static constexpr roam::Body body{0.2, 0.0};
  static constexpr double hit_tolerance = 1e-6;  // metres
  made::Folder folder_;
  Files good_;
  std::vector<std::pair<Triangle, std::string>> triangles_;
  std::vector<Sweep> sweeps_;
  int hits_ = 0, refused_ = 0, named_ = 0, asked_ = 0;
};

/// Whether verifying finds something.
bool found_damaged(const fs::path& folder) {
  try {
    return !roam::verify_store(folder).damage.empty();
  } catch (const roam::Error& e) {
    EXPECT_STRNE(e.what(), "");
    return true;
  }
}

TEST_F(StoreDamageBits, EveryFlippedBitIsFoundAndNoneChangesAnAnswer) {
  ASSERT_FALSE(found_damaged(folder_.path()));
  ASSERT_EQ(good_.size(), 4U);
  // Among the tests of every day each 61st bit: 61 is no multiple of the bits of a byte.
  const bool all = std::getenv("ROAM_TEST_DAMAGES") != nullptr;
  const std::size_t every = all ? 1 : 61, pager_every = all ? 20 : 5;
  std::size_t flips = 0, bytes = 0;
  for (const auto& [name, content] : good_) {
    bytes += content.size();
    for (std::size_t bit = 0; bit < content.size() * 8; bit += every) {
      Files files = good_;
      files[name][bit / 8] ^= std::byte{1} << (bit % 8);
      expect_no_wrong_answer(files, flips++ % pager_every == 0);
      ASSERT_FALSE(HasFatalFailure()) << "bit " << bit << " of " << name;
      write(folder_.path() / name, files[name]);
      ASSERT_TRUE(found_damaged(folder_.path())) << "bit " << bit << " of " << name;
    }
    write(folder_.path() / name, content);
  }
  EXPECT_LT(bytes, 20'000U);
  EXPECT_GT(named_, 0);
  EXPECT_GT(asked_, 10);
  std::cout << flips << " of " << bytes * 8 << " bits: " << refused_ << " times refused, " << named_
            << " times said by the tiles; " << asked_ << " times walked\n";
}

/// Damage as disks and people do it. Returns what was done.
std::string damage(clutter::Random& random, Files& files) {
  auto chosen = files.begin();
  std::advance(chosen, static_cast<int>(random.between(0.0, 0.999) * static_cast<double>(files.size())));
  Bytes& bytes = chosen->second;
  if (bytes.empty()) return "nothing more of " + chosen->first;
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.between(0.0, 1.0) * double(n)) % n; };
  const std::size_t at = below(bytes.size()), length = 1 + below(std::min<std::size_t>(bytes.size() - at, 512));
  const auto run = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  switch (below(7)) {
    case 0:
      for (std::size_t i = 0; i <= below(16); ++i) bytes[below(bytes.size())] = static_cast<std::byte>(below(256));
      return "bytes of " + chosen->first;
    case 1:
      for (std::size_t i = 0; i < length; ++i) run[static_cast<std::ptrdiff_t>(i)] = static_cast<std::byte>(below(256));
      return "a run of " + chosen->first;
    case 2:
      std::fill_n(run, length, std::byte{0});
      return "zeros in " + chosen->first;
    case 3:
      bytes.resize(at);
      return "the end of " + chosen->first;
    case 4:
      bytes.resize(bytes.size() + length, static_cast<std::byte>(below(256)));
      return "more of " + chosen->first;
    case 5: {
      // A block that was written to the wrong place.
      const Bytes block(run, run + static_cast<std::ptrdiff_t>(length));
      std::copy(block.begin(), block.end(),
                bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size() - length + 1)));
      return "a block of " + chosen->first;
    }
    default: {
      const std::string name = chosen->first;
      if (random.unit() < 0.1) {
        files.erase(chosen);
        return "no " + name;
      }
      bytes.erase(run, run + static_cast<std::ptrdiff_t>(length));
      return "bytes left out of " + name;
    }
  }
}

TEST_F(StoreDamageBits, DamageAtRandomChangesNoAnswer) {
  const char* text = std::getenv("ROAM_TEST_DAMAGES");
  const int count = text != nullptr ? std::atoi(text) : 1500;
  clutter::Random random(2);
  int harmless = 0;
  for (int i = 0; i < count; ++i) {
    Files files = good_;
    std::string what = damage(random, files);
    if (random.unit() < 0.2) what += ", " + damage(random, files);
    harmless += files == good_ ? 1 : 0;
    expect_no_wrong_answer(files, i % 10 == 0);
    ASSERT_FALSE(HasFatalFailure()) << i << ": " << what;
  }
  EXPECT_LT(harmless, count / 10);
  EXPECT_GT(refused_, count / 10);
  EXPECT_GT(named_, count / 20);
  std::cout << count << " damages: " << refused_ << " times refused, " << named_ << " times said by the tiles, "
            << asked_ << " times walked\n";
}

}  // namespace
