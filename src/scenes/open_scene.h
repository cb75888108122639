#pragma once
/// \file
/// What a verb moves bodies in: a scene that was read and indexed whole, or a store that is paged while one moves.

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
  /// Reads and indexes a scene, or opens a store, which must then be the only one that is named. Throws what load and
  /// Store::open throw, and UsageError for options that have no meaning for what is opened.
  OpenScene(const SceneOptions& options, Source source);

  [[nodiscard]] const Space& space() const;
  [[nodiscard]] std::uint64_t triangles() const;
  [[nodiscard]] std::uint64_t objects() const;
  [[nodiscard]] Box bounds() const;
  /// Of what bodies move in, which a world stores a little off.
  [[nodiscard]] Box walked_bounds() const { return store_ ? bounds() : loaded_.world.bounds(); }
  /// Null where the scene was read whole.
  [[nodiscard]] const Store* store() const { return store_.get(); }
  [[nodiscard]] const LoadedScene& loaded() const { return loaded_; }
  /// Bytes that a store may take.
  [[nodiscard]] std::uint64_t memory() const { return memory_; }
  /// Of the pager; nothing where the scene was read whole.
  [[nodiscard]] std::optional<PagerStats> paging() const;

  /// A free place to start from, see free_start.
  /// To be called before space().
  [[nodiscard]] Vec3 start(const WalkerSettings& settings, Mode mode);
  /// After the last step: gives a pager's memory back, for what follows. space() is gone then.
  void leave();
  /// Waits until a body there has ground to stand on, where it must be waited for.
  void wait_at(const Body& body, const Vec3& place);
  /// Waits until what a body can reach within a second at this velocity is known or cannot be read, `seconds` at most.
  /// Returns whether it is.
  bool wait_along(const Body& body, const Vec3& from, const Vec3& velocity, double seconds);
  /// To be called after every step: takes into use what has come. A walk that is computed faster than a person walks
  /// waits for what that person would have had, at most as long as the step lasts.
  void follow(const Walker& walker);

  /// How the object of a triangle of an answer is called, and which triangle of the scene it is.
  [[nodiscard]] SourceTriangle source(TriangleId triangle) const;
  /// Just SourceTriangle::scene.
  [[nodiscard]] TriangleId scene_triangle(TriangleId triangle) const;

  /// Why the unknown that a contact names is not known; waits a moment for what is found out beside.
  [[nodiscard]] std::string why_unknown(TriangleId unknown) const;

 private:
  std::uint64_t memory_;  ///< bytes for a store
  LoadedScene loaded_;
  std::shared_ptr<const Store> store_;
  std::unique_ptr<Pager> pager_;
};

/// Lets a scene be read as the store was that was made of it, in what its options do not say. Throws roam::Error where
/// this program does not know how.
void read_as(SceneOptions& scene, const Store& store);

}  // namespace roam::app
