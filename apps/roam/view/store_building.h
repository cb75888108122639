#pragma once
/// \file
/// The collision store of a session's scene: recommended, built, handed over.

#include <filesystem>
#include <memory>
#include <optional>

#include "osgRoam/Manipulator.h"
#include "view/build_process.h"
#include "view/news.h"
#include "view/store_choice.h"
#include "view/view_report.h"

namespace roam::app {

/// Builds the store when the person wants it, and says how that goes. Needs no window. All members belong to one
/// thread, between two frames.
class StoreBuilding {
 public:
  /// `program`: see BuildProcess.
  StoreBuilding(const SceneAndStore& what, std::filesystem::path program, const osgRoam::Manipulator& roamer,
                News& news);

  /// Ends a build; does not wait for that, as the destructor does.
  void cancel();
  /// The store that the collision was looked for in.
  void consider(const StoreChoice& choice);
  /// Recommends a store, once.
  void recommend();
  /// Begins to build, or stops that. `used`: the store that the body collides with, or null. `place`: where the body
  /// is, or will probably be.
  void toggle(const Pager* used, const Vec3& place);
  /// In each frame with a body at `place`; says so when the build has failed.
  void follow(const Vec3& place);
  /// A pager on the new store, once, when it is built; else null.
  [[nodiscard]] std::shared_ptr<Pager> take();

  /// `status` must say whether the body collides with a store.
  void fill(Status& status) const;
  void fill(ViewReport& report) const;

 private:
  [[nodiscard]] std::string key() const;

  SceneAndStore what_;
  std::filesystem::path program_;
  const osgRoam::Manipulator& roamer_;
  News& news_;
  std::optional<BuildProcess> build_;
  bool stopped_ = false;  ///< by the person
  bool is_stale_ = false;
  bool recommended_ = false;
};

}  // namespace roam::app
