#pragma once
/// \file
/// `roam walk --certify`: the certificate of a walk, for `roam check`.

#include <filesystem>

#include "check/check.h"
#include "cli/output_file.h"
#include "roam/mesh.h"
#include "scenes/open_scene.h"
#include "verify/piece_log.h"

namespace roam::app {

/// Certificates, and empty files.
[[nodiscard]] FileKind certificates();

void add(checking::SceneSum& sum, const Mesh& mesh);

/// Writes the certificate of a walk to `file`, unless that is empty. Returns whether it was written. `source`: of the
/// scene whose store it was; null: not read to its end, and there is no certificate. Throws roam::Error if the file
/// cannot be written, if nothing is certified, or if the segments do not hold together: the body was put elsewhere on
/// its way.
bool certify(const std::filesystem::path& file, const OpenScene& scene, const verification::PieceLog& pieces,
             const checking::SceneSum* source);

}  // namespace roam::app
