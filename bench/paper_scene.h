#pragma once
/// \file
/// The scene of the paper's experiments, prepared for the rows.

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
  double patience = 60.0;               ///< seconds for a way, at most
  double loading = 600.0;               ///< seconds until a row can move, at most
  std::uint64_t memory = 0;             ///< bytes for a row and the programs that it starts; 0: 3/4 of the free memory
  std::string wasm;                     ///< folder of the npm packages; empty: rows that need it are skipped
  std::string scratch;                  ///< folder; empty: the system's temporary one
};

/// A folder that exists as long as the object.
class ScratchFolder {
 public:
  /// In `parent`; if that is empty, in the system's temporary folder. Throws roam::Error.
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

/// Writes the inputs into `folder`, and the scene's file if it is generated. Throws roam::Error, and roam::Cancelled
/// after Ctrl-C.
[[nodiscard]] LaidOut lay_out(const PaperOptions& options, const std::set<Reads>& read, const std::string& folder);

/// The scene of roam's rows, mesh by mesh, in bounded memory. Throws as lay_out does.
void stream_laid_out(const PaperScene& scene, const std::function<void(const Mesh&)>& take);

}  // namespace roam::bench
