#pragma once
/// \file
/// Pager: a space over a collision store, in fixed memory, that loads around one body. Target roam::store.
///
///     roam::Pager pager(roam::Store::open("dam.roam"), {.memory = 64ull << 20});
///     // Without this wait the walker is held until ground has loaded.
///     const roam::WalkerSettings person;
///     pager.wait(person.body(), start, roam::Vec3(0.0), 10.0);
///     roam::Walker walker(pager, person, roam::Mode::walk, start);
///     while (true) {
///       walker.step({.velocity = {1.4, 0.0, 0.0}}, 1.0 / 60.0);
///       pager.update(walker.body(), walker.position(), walker.velocity());  // between two steps
///     }
///
/// A tile is resident or unknown. The store records which of 8 x 8 x 8 cells of a tile's box may have triangles; in an
/// unknown tile these are solid, grown by Pager::margin. Unknown pages of the index are solid in their boxes. Tiles
/// that cannot be read or are damaged are solid, too; reading is retried with increasing delay.
///
/// Loading threads begin with the tiles that the body can reach first: in a ball around it and a cone ahead. Only
/// update() takes loaded tiles into use. The constructor allocates all memory. If it holds the whole store, results are
/// those of a World of its tiles; docs/stores.md lists the exceptions.
///
/// Threads: update(), wait() and the destructor belong to the thread that moves the body. Queries may run in any
/// threads, but not during update() and wait(). Queries never lock, wait, read or allocate. object() and stats() may be
/// called from any thread, and lock for a moment.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "roam/space.h"
#include "roam/store.h"

namespace roam {

struct PagerOptions {
  /// Bytes, >= Pager::least_memory: tiles, pages, tables, buffers, and the store's manifest and caches.
  std::uint64_t memory = 64ull << 20;
  int loaders = 0;       ///< loading threads, 1 to 16; 0: 1 for a folder, up to 8 for a web server
  double horizon = 3.0;  ///< seconds of motion ahead that are loaded
};

/// Contents and work of a pager.
struct PagerStats {
  std::uint64_t memory = 0;           ///< bytes allocated; constant
  std::uint64_t used = 0;             ///< bytes of it that hold tiles and pages
  std::uint64_t tiles = 0;            ///< resident
  std::uint64_t pages = 0;            ///< resident
  std::uint64_t triangles = 0;        ///< resident
  std::uint64_t wanted = 0;           ///< tiles and pages within the horizon that are not resident
  std::uint64_t reading = 0;          ///< tiles and pages that are being read now
  bool full = false;                  ///< memory does not hold all tiles and pages within the horizon
  std::uint64_t loads = 0;            ///< tiles and pages loaded so far
  std::uint64_t evictions = 0;        ///< tiles and pages evicted so far
  std::uint64_t failures = 0;         ///< failed reads and decodings so far
  std::uint64_t failed = 0;           ///< tiles and pages that are solid now because of a failure
  std::uint64_t failed_may_pass = 0;  ///< of them, those whose reason may pass, as a broken connection does
  std::uint64_t bytes_read = 0;       ///< from the store
  double longest_read = 0.0;          ///< s: longest read of a tile
  double longest_decode = 0.0;        ///< s: longest decoding of a tile
  double ready_radius = 0.0;          ///< m around the body within which all is known, as of the last update()
  std::string last_failure;           ///< sentence with tile, position and reason; empty: none
};

class Pager final : public LiveSpace {
 public:
  static constexpr std::uint64_t least_memory = 8ull << 20;
  /// Metres that a body keeps from unknown space, beyond its radius; see Patchwork::margin.
  static constexpr double margin = 1.99e-3;

  /// Starts the loading threads. Throws roam::Error if `store` is null, options are out of range, or the store's index
  /// needs more than half of the memory (the message says how much is enough).
  explicit Pager(std::shared_ptr<const Store> store, const PagerOptions& options = {});
  ~Pager() override;

  bool update(const Body& body, const Vec3& place, const Vec3& velocity) override;
  /// Updates until all that the body can reach within `ahead` seconds is known or failed, or memory holds no more of
  /// it, for at most `seconds`. Returns whether it is known or failed; if so, the speed limit takes no latency into
  /// account until the next update(). `goes_on` is called now and then; false ends the wait. Blocks: not for use
  /// in a frame.
  bool wait(const Body& body, const Vec3& place, const Vec3& velocity, double seconds, double ahead = 0.5,
            const std::function<bool()>& goes_on = {});

  /// The speed limit is (ready_radius - radius) / (latency + 1/60 s), with the latency of a read that starts now: a
  /// body slows down before unknown space instead of hitting it.
  [[nodiscard]] SpaceFacts facts() const override;
  /// The name alone. A loading thread reads it: "" until then, so call again later. For unknown space it is the reason.
  [[nodiscard]] Object object(TriangleId triangle) const override;

  [[nodiscard]] const Store& store() const;
  [[nodiscard]] PagerStats stats() const;

 protected:
  [[nodiscard]] FirstImpact find_first(const Query& query, Vicinity* vicinity) const override;
  void find_near(const Query& query, Collector& collector, Vicinity* vicinity) const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace roam
