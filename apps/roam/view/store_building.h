#pragma once
/// \file
/// The collision store of a session's scene: recommendation, build, handover.

#include <filesystem>
#include <memory>
#include <optional>

#include "osgRoam/Manipulator.h"
#include "view/build_process.h"
#include "view/news.h"
#include "view/store_choice.h"
#include "view/twice.h"
#include "view/view_report.h"

namespace roam::app {

/// Builds the store at the person's command, and reports the progress. Needs no window. Call all members from one
/// thread, between two frames.
class StoreBuilding {
 public:
  /// `program`: see BuildProcess.
  StoreBuilding(const SceneAndStore& what, std::filesystem::path program, const osgRoam::Manipulator& roamer,
                News& news);

  /// Cancels a build without waiting; the destructor waits.
  void cancel();
  /// Takes the result of the search for a store.
  void consider(const StoreChoice& choice);
  /// Recommends a store, once.
  void recommend();
  /// Begins a build, or cancels it. `used`: the store that the body collides with, or null. `place`: the body's
  /// position, or the expected one. A build begins with the second call within 5 s. The first one says where the store
  /// will be and how large, from the scene's `triangles`; 0: not known.
  void toggle(const Pager* used, const Vec3& place, std::uint64_t triangles);
  [[nodiscard]] bool is_building() const { return build_.has_value(); }
  /// Call it in each frame with a body at `place`; reports a failed build.
  void follow(const Vec3& place);
  /// A pager on the new store, once, after the build; else null.
  [[nodiscard]] std::shared_ptr<Pager> take();

  /// `status.paging` must be set if the body collides with a store.
  void fill(Status& status) const;
  void fill(ViewReport& report) const;

 private:
  [[nodiscard]] std::string key() const;
  void ask(std::uint64_t triangles);

  SceneAndStore what_;
  std::filesystem::path program_;
  const osgRoam::Manipulator& roamer_;
  News& news_;
  std::optional<BuildProcess> build_;
  Twice build_wish_{5.0};
  bool stopped_ = false;  ///< by the person
  bool is_stale_ = false;
  bool recommended_ = false;
};

}  // namespace roam::app
