#pragma once
/// \file
/// `roam build` as a child of the viewer.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "roam/pager.h"
#include "roam/store_build.h"
#include "view/loading.h"
#include "view/store_choice.h"

namespace roam::app {

/// Runs `roam build` with low priority, and then opens a pager on the new store. The parts nearest to the body are
/// built first. What is done when the build is cancelled, or when the viewer ends, stays in the store's folder; the
/// next build continues it.
///
/// A thread of its own waits for the child. All members belong to the thread that made the object.
class BuildProcess {
 public:
  /// Starts at once. `program` is roam; if empty, the running program. `place` is the body's centre.
  BuildProcess(std::filesystem::path program, const SceneAndStore& what, const WalkerSettings& walker,
               const Vec3& place);

  /// Ends the build; does not wait for that, as the destructor does.
  void cancel() { loading_.cancel(); }
  /// The phases are reading, indexing (shards), looking (loading what is around the body), done and failed.
  [[nodiscard]] LoadState state() const { return loading_.state(); }
  /// The store's folder.
  [[nodiscard]] const std::filesystem::path& output() const { return output_; }
  /// The body has moved to `place`.
  void follow(const Vec3& place);

  struct Built {
    std::shared_ptr<Pager> pager;    ///< has loaded what is around the body
    std::vector<std::string> notes;  ///< of the build, as sentences for the user
  };
  /// The result. Valid once state() is done; may be called once.
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
