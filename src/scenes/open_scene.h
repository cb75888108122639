#pragma once
/// \file
/// The scene of a verb: read and indexed whole, or a store that is paged while bodies move.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "roam/pager.h"
#include "roam/walker.h"
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
  /// Waits until ground is loaded below a body at `place`, if it must be loaded.
  void wait_at(const Body& body, const Vec3& place);
  /// Waits until everything that a body can reach within a second at this velocity is loaded or unreadable, at most
  /// `seconds`. Returns whether it is.
  bool wait_along(const Body& body, const Vec3& from, const Vec3& velocity, double seconds);
  /// Call it after every step: puts loaded tiles into use. A walk that is computed faster than real time waits for
  /// tiles that would have loaded in real time, at most as long as the step lasts.
  void follow(const Walker& walker);

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
};

/// Sets the options that determine how a scene is read to those of its store. Throws roam::Error if this program does
/// not know them.
void read_as(SceneOptions& scene, const Store& store);

}  // namespace roam::app
