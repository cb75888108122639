#pragma once
/// \file
/// One path, one reader: from starting it to its last frame or its failure.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "import/processor_budget.h"
#include "import/reader_process.h"
#include "import/scene_scope.h"
#include "import/stream_receiver.h"
#include "roam/import.h"

namespace roam::reader {

/// What is to be read and how.
struct Reading {
  std::filesystem::path program;  ///< roam-reader
  std::filesystem::path path;     ///< existing file or folder
  SceneScope scope{};             ///< of the path
  std::uint64_t path_bytes = 0;   ///< its size
  const ImportOptions* options = nullptr;
  std::optional<Georeference> frame{};  ///< of the paths before, if there is one
  /// What the reader is to send.
  enum class Wanted { meshes, pieces, display, pages, list };
  Wanted wanted = Wanted::meshes;
  std::string tile{};            ///< of a folder, the only one that is wanted; empty: all
  std::optional<Vec3> origin{};  ///< of the parts of the paths before
  /// Called about every tenth of a second with the bytes read and triangles received of this path.
  std::function<void(std::uint64_t, std::uint64_t)> report_progress;
};

/// The walls around a reader, as one says that reads nothing. Throws roam::Error when it cannot be run.
[[nodiscard]] Confinement confinement_of(const std::filesystem::path& program);

/// Starts the reader; of pages one that takes requests.
[[nodiscard]] std::unique_ptr<ReaderProcess> start(const Reading& reading);

/// Gives what the reader says to `receiver`, until that has ended. `budget` is that of the process. Throws what
/// read_one throws.
void receive(const Reading& reading, ReaderProcess& process, StreamReceiver& receiver, ProcessorBudget budget);

/// Gives what the reader says of the path to `receiver`, and sets matched[i] where ignore pattern i matched. Throws
/// roam::Error, and whatever report_progress and the receiver throw; the reader is gone either way.
void read_one(const Reading& reading, StreamReceiver& receiver, std::vector<bool>& matched);

}  // namespace roam::reader
