// Simulates walkers in a store on a web server, each with a connection and a memory of its own: prints how much they
// load, and the time until a tile is there.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "charts.h"
#include "draw/picture_file.h"
#include "program.h"
#include "roam/error.h"
#include "roam/pager.h"
#include "roam/path_file.h"
#include "store/opened.h"
#include "store/pager/tracked_body.h"
#include "store/tile_reader.h"
#include "store/web_files.h"
#include "text/number.h"
#include "timing.h"

namespace {

using namespace roam::bench;
using roam::Vec3;
using Clock = std::chrono::steady_clock;

struct Options {
  std::string store, path, picture;
  std::vector<int> walkers{1000};
  double speed = 1.4, seconds = 60.0, ramp = 30.0;
};

constexpr double horizon = 3.0;                ///< s: as a pager's
constexpr double needed_within = 0.5;          ///< s: a body waits for nearer tiles
constexpr std::uint64_t memory = 6ull << 20;   ///< for tiles and pages in a pager of 8 MiB
constexpr std::chrono::milliseconds nap{100};  ///< between two looks of a walker that has all it needs

/// A page or a tile.
struct Item {
  roam::Box box;
  roam::store::CheckedRange range;
  std::uint64_t resident = 0;  ///< bytes in memory
};

std::vector<Item> items_of(const roam::Store::State& store) {
  std::vector<Item> items;
  roam::store::TileReader reader(store);
  for (std::size_t p = 0; p < store.pages.size(); ++p) {
    const auto& [shard, ref] = store.pages[p];
    items.push_back({ref.box, {store.packs[shard], ref.offset, ref.bytes, ref.hash}, ref.bytes});
    const roam::store::LoadedPage page = reader.page(p);
    for (const roam::store::TileEntry& tile : page.view.tiles) {
      items.push_back({box_of(tile), {store.packs[shard], tile.offset, tile.bytes, tile.hash}, shape_of(tile).bytes()});
    }
  }
  return items;
}

Clock::duration in_clock(double s) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
}

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// The measurements of all walkers, without those of the start.
struct Sums {
  std::mutex mutex;
  std::vector<double> until_there;  ///< s, from the moment at which a tile comes within the horizon
  double metres = 0.0, waited = 0.0;
  std::uint64_t bytes = 0, failures = 0;
};

class Walker {
 public:
  Walker(const std::vector<Item>& items, const std::vector<Vec3>& way, double start, const Options& options)
      : items_(items), way_(way), along_(start), speed_(options.speed), states_(items.size()) {
    bytes_ = roam::store::web_store(options.store, {}).bytes;
  }

  void run(Clock::time_point begin, Clock::time_point measured, Clock::time_point end, Sums& sums) {
    std::this_thread::sleep_until(begin);
    for (auto before = Clock::now(); before < end;) {
      const std::size_t next = look(before);
      const bool counts = before >= measured;
      const bool waits = next < items_.size() && keys_[next] < needed_within;
      if (next < items_.size()) {
        read(next, counts, sums);
      } else {
        std::this_thread::sleep_for(nap);
        looked_ = Clock::now();  // a pager would have looked meanwhile
      }
      const auto now = Clock::now();
      const double passed = seconds_between(before, now);
      before = now;
      if (!waits) along_ += speed_ * passed;
      if (!counts) continue;
      const std::lock_guard lock(sums.mutex);
      (waits ? sums.waited : sums.metres) += waits ? passed : speed_ * passed;
    }
  }

 private:
  struct State {
    bool here = false;
    Clock::time_point wanted{};
  };

  /// Where the way is after so many metres, to and fro.
  [[nodiscard]] std::pair<Vec3, Vec3> place() const {
    double length = 0.0;
    for (std::size_t i = 1; i < way_.size(); ++i) length += glm::distance(way_[i - 1], way_[i]);
    double at = std::fmod(along_, 2.0 * length);
    const double sign = at < length ? 1.0 : -1.0;
    if (at >= length) at = 2.0 * length - at;
    for (std::size_t i = 1;; ++i) {
      const Vec3 piece = way_[i] - way_[i - 1];
      const double size = glm::length(piece);
      if (at <= size || i + 1 == way_.size()) return {way_[i - 1] + at / size * piece, sign * speed_ / size * piece};
      at -= size;
    }
  }

  /// The nearest item that is needed and not here; items_.size(): none.
  std::size_t look(Clock::time_point now) {
    const auto [at, velocity] = place();
    const roam::paging::TrackedBody body(roam::Body::capsule(0.3, 1.8), at, velocity);
    keys_.resize(items_.size());
    if (looked_ == Clock::time_point{}) looked_ = now;
    std::size_t nearest = items_.size();
    for (std::size_t i = 0; i < items_.size(); ++i) {
      keys_[i] = body.time_to(items_[i].box);
      if (keys_[i] > horizon) states_[i].wanted = {};
      if (keys_[i] > horizon || states_[i].here) continue;
      if (states_[i].wanted == Clock::time_point{})
        states_[i].wanted = std::max(looked_, now - in_clock(horizon - keys_[i]));
      if (nearest == items_.size() || keys_[i] < keys_[nearest]) nearest = i;
    }
    looked_ = now;
    return nearest;
  }

  void read(std::size_t item, bool counts, Sums& sums) {
    while (used_ + items_[item].resident > memory) drop_farthest();
    const Item& wanted = items_[item];
    buffer_.resize(wanted.range.bytes);
    const bool failed = bytes_->read_checked(wanted.range.file, wanted.range.offset, buffer_, *wanted.range.hash, {});
    const double took = seconds_between(states_[item].wanted, Clock::now());
    states_[item] = {!failed, {}};
    if (!failed) used_ += wanted.resident;
    if (!counts) return;
    const std::lock_guard lock(sums.mutex);
    sums.until_there.push_back(took);
    sums.bytes += wanted.range.bytes;
    sums.failures += failed ? 1 : 0;
  }

  void drop_farthest() {
    std::size_t farthest = items_.size();
    for (std::size_t i = 0; i < items_.size(); ++i) {
      if (states_[i].here && (farthest == items_.size() || keys_[i] > keys_[farthest])) farthest = i;
    }
    if (farthest == items_.size()) throw std::runtime_error("a tile is larger than a walker's memory");
    states_[farthest] = {};
    used_ -= items_[farthest].resident;
  }

  const std::vector<Item>& items_;
  const std::vector<Vec3>& way_;
  double along_, speed_;
  std::vector<State> states_;
  std::vector<double> keys_;
  Clock::time_point looked_{};  ///< what came within the horizon since, did so during a read
  std::uint64_t used_ = 0;
  std::vector<std::byte> buffer_;
  std::shared_ptr<roam::store::StoreBytes> bytes_;
};

/// Prints what `count` walkers measure. Returns it as a bar; throws roam::Error if something did not come.
Bar measure(const Options& options, const std::vector<Item>& items, const std::vector<Vec3>& way, int count) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += glm::distance(way[i - 1], way[i]);
  std::vector<std::unique_ptr<Walker>> walkers;
  for (int i = 0; i < count; ++i) {
    // Spread over the way, in both directions.
    walkers.push_back(std::make_unique<Walker>(items, way, 2.0 * length * i / count, options));
  }
  Sums sums;
  const auto begin = Clock::now();
  const auto after = [&](double s) { return begin + in_clock(s); };
  std::printf("measuring begins in %g s\n", options.ramp);
  std::fflush(stdout);
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < count; ++i) {
      threads.emplace_back([&, i] {
        walkers[static_cast<std::size_t>(i)]->run(after(0.5 * options.ramp * i / count), after(options.ramp),
                                                  after(options.ramp + options.seconds), sums);
      });
    }
  }
  std::sort(sums.until_there.begin(), sums.until_there.end());
  const auto reads = static_cast<double>(sums.until_there.size());
  const double p50 = quantile(sums.until_there, 0.5), p99 = quantile(sums.until_there, 0.99);
  std::printf(
      "%d walkers, %g m/s, %g s: %.0f m, %.0f tiles and pages, %.1f MB; a metre: %.0f bytes, %.3f reads; until a tile "
      "is there: median %.1f ms, p99 %.1f ms, worst %.1f ms; waiting %.3f %% of the time; %llu failures\n",
      count, options.speed, options.seconds, sums.metres, reads, 1e-6 * static_cast<double>(sums.bytes),
      static_cast<double>(sums.bytes) / sums.metres, reads / sums.metres, 1e3 * p50, 1e3 * p99,
      1e3 * quantile(sums.until_there, 1.0), 100.0 * sums.waited / (count * options.seconds),
      static_cast<unsigned long long>(sums.failures));
  std::fflush(stdout);
  if (sums.failures != 0) throw roam::Error(options.store, std::to_string(sums.failures) + " tiles did not come");
  return {std::to_string(count) + (count == 1 ? " walker" : " walkers"), 1e6 * p50, 1e6 * p99, "", false};
}

int run(const Options& options) {
  std::optional<roam::draw::PictureFile> picture;
  if (!options.picture.empty()) picture.emplace(options.picture);
  const std::vector<Item> items = items_of(roam::Store::open(options.store)->state());
  const std::vector<Vec3> way = roam::positions(roam::load_path(options.path));
  std::vector<Bar> bars;
  for (const int count : options.walkers) bars.push_back(measure(options, items, way, count));
  if (picture) {
    const std::string title = "nginx, walkers at " + roam::number_text(options.speed) + " m/s";
    picture->write(bar_chart("Until a tile is there", {{title, std::move(bars)}}));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Simulates walkers in a store on a web server"};
  app.add_option("STORE", options.store, "the store's address")->required();
  app.add_option("--path", options.path, "the way that they walk, to and fro")->required();
  app.add_option("--walkers", options.walkers, "how many; several numbers: one after another")
      ->capture_default_str()
      ->check(CLI::Range(1, 20000));
  app.add_option("--picture", options.picture, "draw the times as bars (.svg or .png)")->type_name("FILE");
  app.add_option("--speed", options.speed, "metres per second")->capture_default_str()->check(CLI::Range(0.1, 100.0));
  app.add_option("--seconds", options.seconds, "measured")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--ramp", options.ramp, "seconds before, in which all of them start")->capture_default_str();
  return run_program(app, argc, argv, [&] { return run(options); });
}
