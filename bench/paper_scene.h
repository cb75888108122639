#pragma once
/// \file
/// The scene of the paper's experiments, laid out for those who are to move in it.

#include <functional>
#include <set>

#include "paper_movers.h"
#include "roam/mesh.h"

namespace roam::bench {

struct PaperOptions {
  std::string scene;                    ///< a file; empty: the made gallery
  std::uint64_t triangles = 2'000'000;  ///< of the made gallery
  double radius = 0.5;                  ///< metres
  double split_radius = 0.7;            ///< metres: over a split of 1.25 m
  double patience = 60.0;               ///< seconds a way may take
  double loading = 600.0;               ///< seconds a row may take until it can move
  std::uint64_t memory = 0;             ///< bytes a row may take, with the programs it starts; 0: 3/4 of what is free
  std::string wasm;                     ///< folder of the npm packages; empty: rows that need it are left out
  std::string scratch;                  ///< folder; empty: the system's temporary one
};

/// A folder that is gone with it.
class ScratchFolder {
 public:
  /// In `parent`, or in the system's temporary folder when that is empty. Throws roam::Error.
  explicit ScratchFolder(const std::string& parent);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

struct LaidOut {
  std::string title;
  std::uint64_t triangles = 0;
  double prepared = 0.0;  ///< seconds that writing files and store took
  PaperScene scene;
};

/// Writes what is to be read into `folder`, and the scene's file where it is made. Throws roam::Error, and
/// roam::Cancelled after Ctrl-C.
[[nodiscard]] LaidOut lay_out(const PaperOptions& options, const std::set<Reads>& read, const std::string& folder);

/// The scene that roam's rows read, mesh by mesh, in bounded memory. Throws as lay_out does.
void stream_laid_out(const PaperScene& scene, const std::function<void(const Mesh&)>& take);

}  // namespace roam::bench
