#pragma once
/// \file
/// A space over a collision store, in fixed memory: tiles come before the body needs them, and go when it does not. It
/// serves one body: others in it find what is near that one. Target roam::store.
///
///     roam::Pager pager(roam::Store::open("dam.roam"), {.memory = 64ull << 20});
///     // Until there is ground to stand on. Who does not wait is held until there is.
///     const roam::WalkerSettings person;
///     pager.wait(person.body(), start, roam::Vec3(0.0), 10.0);
///     roam::Walker walker(pager, person, roam::Mode::walk, start);
///     while (true) {
///       walker.step({.velocity = {1.4, 0.0, 0.0}}, 1.0 / 60.0);
///       pager.update(walker.body(), walker.position(), walker.velocity());  // between two steps
///     }
///
/// Every tile is resident or unknown. An unknown tile is solid where its triangles may be: in the occupied cells of a
/// grid of 8 x 8 x 8 over its box, grown by Pager::margin; a page of the index that is not there is solid in its box.
/// So is what cannot be read or is damaged, for as long as that lasts: it is tried again for ever, ever more seldom.
///
/// Queries never lock, wait, read or allocate. object_name() and stats() are no queries: they lock for a moment. What
/// the loading threads bring is taken into use by update() and at no other time, and what they are to bring next
/// follows from the body it was told of: first what the body could reach first, in a ball around it and in a cone
/// ahead. All memory is taken when the pager is made.
///
/// Where memory holds all of a store, answers are those of a World of its tiles, to the bit where the order in which
/// tiles are visited does not come in: docs/stores.md says where it does, and by how much.
///
/// update(), wait() and the destructor belong to the thread that moves the body. Queries may run at the same time as
/// each other, from any threads, but not during update() and wait(). stats() may be called from any thread.

#include <cstdint>
#include <memory>
#include <string>

#include "roam/space.h"
#include "roam/store.h"

namespace roam {

struct PagerOptions {
  /// Bytes, >= Pager::least_memory: tiles, pages, tables, buffers, and what the store keeps of its manifest and of what
  /// was asked for last.
  std::uint64_t memory = 64ull << 20;
  int loaders = 1;       ///< loading threads, 1 to 16
  double horizon = 3.0;  ///< seconds of motion ahead that are loaded
};

/// What a pager holds and has done.
struct PagerStats {
  std::uint64_t memory = 0;     ///< bytes taken when it was made; never changes
  std::uint64_t used = 0;       ///< bytes of it that hold tiles and pages now
  std::uint64_t tiles = 0;      ///< resident
  std::uint64_t pages = 0;      ///< resident
  std::uint64_t triangles = 0;  ///< resident
  std::uint64_t wanted = 0;     ///< tiles and pages that the body could reach within the horizon and that have not come
  std::uint64_t loads = 0;      ///< tiles and pages that came, in all
  std::uint64_t evictions = 0;  ///< that went again
  std::uint64_t failures = 0;   ///< reads and decodings that failed, in all
  std::uint64_t failed = 0;     ///< tiles and pages that are solid now because they failed last
  std::uint64_t bytes_read = 0;  ///< from the store
  double worst_read_s = 0.0;     ///< longest wait for the bytes of one tile
  double worst_decode_s = 0.0;   ///< longest time to make one ready after its bytes came
  double ready_m = 0.0;          ///< how far around the body everything is known, as of the last update()
  std::string last_failure;      ///< for people: which tile, where, why; empty when none failed
};

class Pager final : public LiveSpace {
 public:
  static constexpr std::uint64_t least_memory = 8ull << 20;
  /// How much more than its radius a body keeps from what is unknown, metres; see Patchwork::margin.
  static constexpr double margin = 1.99e-3;

  /// Starts the loading threads. Throws roam::Error for options out of range, for a store whose index alone needs
  /// more than half of the memory (the message says how much would do), and where `store` is null.
  explicit Pager(std::shared_ptr<const Store> store, const PagerOptions& options = {});
  ~Pager() override;

  bool update(const Body& body, const Vec3& place, const Vec3& velocity) override;
  /// Updates until everything that the body could reach within `ahead` seconds is known or has failed, `seconds` at
  /// most. Returns whether it is. For programs that may wait: never for a frame.
  bool wait(const Body& body, const Vec3& place, const Vec3& velocity, double seconds, double ahead = 0.5);

  /// The speed limit is (ready - radius) / (latency + dt), so that a body comes to rest before what is unknown instead
  /// of against it. `ready` is how far around the body everything is known (PagerStats::ready_m), `latency` how long a
  /// read takes that is asked for now, s, and dt a step of 1/60 s. Slow, never through.
  [[nodiscard]] SpaceFacts facts() const override;
  /// The name alone. It is read by a loading thread: "" until it is there, so call again later. For what is unknown it is
  /// the reason.
  [[nodiscard]] Object object(TriangleId triangle) const override;

  [[nodiscard]] const Store& store() const;
  [[nodiscard]] PagerStats stats() const;

 protected:
  [[nodiscard]] FirstImpact ask_first(const Query& query, Vicinity* vicinity) const override;
  void ask_near(const Query& query, Collector& collector, Vicinity* vicinity) const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace roam
