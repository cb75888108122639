#pragma once
/// \file
/// The scene of a verb: read and indexed whole, or a store that is paged while bodies move.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "roam/pager.h"
#include "roam/walker.h"
#include "scenes/arrivals.h"
#include "scenes/scene_options.h"

namespace roam::app {

class OpenScene {
 public:
  /// Reads and indexes a scene, or opens a store, which must be the only one named. Throws the errors of load and
  /// Store::open, and UsageError for options without meaning for that scene.
  OpenScene(const SceneOptions& options, Source source);

  [[nodiscard]] const Space& space() const;
  [[nodiscard]] std::uint64_t triangles() const;
  [[nodiscard]] std::uint64_t objects() const;
  [[nodiscard]] Box bounds() const;
  /// Bounds of the space, which a world stores with a small error.
  [[nodiscard]] Box walked_bounds() const { return store_ ? bounds() : loaded_.world.bounds(); }
  /// Null if the scene was read whole.
  [[nodiscard]] const Store* store() const { return store_.get(); }
  [[nodiscard]] const LoadedScene& loaded() const { return loaded_; }
  /// Bytes for a store.
  [[nodiscard]] std::uint64_t memory() const { return memory_; }
  /// Statistics of the pager; none if the scene was read whole.
  [[nodiscard]] std::optional<PagerStats> paging() const;

  /// A free position to start from; see free_start. Call it before space().
  [[nodiscard]] Vec3 start(const WalkerSettings& settings, Mode mode);
  /// Call it after the last step: frees a pager's memory for later work. space() is invalid then.
  void leave();
  /// Waits until everything readable within `reach` (m) of a body is loaded, if it must be loaded; see TilesAround.
  /// Call it before and between the steps of a walk: then no step depends on the time that loading takes, as long as
  /// memory holds that reach, no read fails for good, and loading does not pause for long (see Arrivals).
  void wait_around(const Body& body, const Vec3& place, const Vec3& velocity, double reach);
  /// The pager of a store; null if the scene was read whole.
  [[nodiscard]] Pager* pager() { return pager_.get(); }

  /// The name of the object of a triangle of a result, and the triangle's number in the scene.
  [[nodiscard]] SourceTriangle source(TriangleId triangle) const;
  /// Only SourceTriangle::scene.
  [[nodiscard]] TriangleId scene_triangle(TriangleId triangle) const;

  /// The reason why the unknown part of a contact is not loaded. Waits a moment for other threads to find it.
  [[nodiscard]] std::string why_unknown(TriangleId unknown) const;

 private:
  std::uint64_t memory_;  ///< for a store
  LoadedScene loaded_;
  std::shared_ptr<const Store> store_;
  std::unique_ptr<Pager> pager_;
  std::optional<TilesAround> around_;  ///< of the pager's body
};

/// Sets the options that determine how a scene is read to those of its store. Throws roam::Error if this program does
/// not know them.
void read_as(SceneOptions& scene, const Store& store);

}  // namespace roam::app
