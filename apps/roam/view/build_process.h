#pragma once
/// \file
/// `roam build` as a child process of the viewer.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "roam/pager.h"
#include "roam/store_build.h"
#include "view/loading.h"
#include "view/store_choice.h"

namespace roam::app {

/// Runs `roam build` with low priority, then opens a pager on the new store. It builds the parts nearest to the body
/// first. A cancelled build, or one that the viewer's end stops, leaves its work in the store's folder. The next build
/// continues it.
///
/// A separate thread waits for the child. Call all members from the thread that made the object.
class BuildProcess {
 public:
  /// Starts at once. `program`: path of roam; empty: the running program. `place`: the body's centre.
  BuildProcess(std::filesystem::path program, const SceneAndStore& what, const WalkerSettings& walker,
               const Vec3& place);

  /// Ends the build without waiting; the destructor waits.
  void cancel() { loading_.cancel(); }
  /// The phases are reading, indexing (shards), looking (loading tiles around the body), done and failed.
  [[nodiscard]] LoadState state() const { return loading_.state(); }
  /// The store's folder.
  [[nodiscard]] const std::filesystem::path& output() const { return output_; }
  /// Moves the body's position to `place`.
  void follow(const Vec3& place);

  struct Built {
    std::shared_ptr<Pager> pager;    ///< has loaded the tiles around the body
    std::vector<std::string> notes;  ///< the build's notes, as sentences for the user
  };
  /// The result. Call it once, after state() is done.
  [[nodiscard]] Built take();

 private:
  void load();
  [[nodiscard]] StoreBuildReport build();
  [[nodiscard]] Vec3 place();

  std::filesystem::path program_;
  SceneAndStore what_;
  std::filesystem::path output_;
  WalkerSettings walker_;
  Vec3 place_;
  Built built_;
  Loading loading_;
};

}  // namespace roam::app
