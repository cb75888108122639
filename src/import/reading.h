#pragma once
/// \file
/// Reading of one path by one reader, from its start to its last frame or its failure.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "import/archive_entry.h"
#include "import/processor_budget.h"
#include "import/reader_process.h"
#include "import/scene_scope.h"
#include "import/stream_receiver.h"
#include "roam/import.h"

namespace roam::reader {

/// A request to a reader.
struct Reading {
  std::filesystem::path program;  ///< roam-reader
  std::filesystem::path path;     ///< existing file or folder
  SceneScope scope{};             ///< the scope of `path`
  std::uint64_t path_bytes = 0;   ///< size of `path`
  const ImportOptions* options = nullptr;
  std::optional<Georeference> frame{};  ///< of the previous paths, if there is one
  /// The kind of content that the reader sends.
  enum class Wanted { meshes, pieces, display, pages, list };
  Wanted wanted = Wanted::meshes;
  std::string tile{};                   ///< the only tile of a folder to read; empty: all
  std::optional<ArchiveEntry> entry{};  ///< the tile's, in an archive
  std::optional<Vec3> origin{};         ///< of the parts of the previous paths
  SceneBudget* scene = nullptr;         ///< that of all parts of the scene, if there are several readings
  /// Called about every tenth of a second with the bytes read and the triangles received for this path.
  std::function<void(std::uint64_t, std::uint64_t)> report_progress;
};

/// The walls of a reader that reads nothing, as it reports them. Throws roam::Error if it cannot run.
[[nodiscard]] Confinement confinement_of(const std::filesystem::path& program);

/// Starts the reader. For pages it accepts requests.
[[nodiscard]] std::unique_ptr<ReaderProcess> start(const Reading& reading);

/// Passes the frames of the reader to `receiver` until that has ended. `budget` is that of the process. Throws the
/// errors of read_one.
void receive(const Reading& reading, ReaderProcess& process, StreamReceiver& receiver, ProcessorBudget budget);

/// Reads the path: passes the frames of the reader to `receiver`, and sets matched[i] if ignore pattern i matched.
/// Throws roam::Error, and exceptions of report_progress and the receiver. The reader is gone in all cases.
void read_one(const Reading& reading, StreamReceiver& receiver, std::vector<bool>& matched);

}  // namespace roam::reader
