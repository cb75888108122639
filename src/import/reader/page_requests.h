#pragma once
/// \file
/// A reader that stays and reads the requested pages of a scene, one after the other.

#include <functional>
#include <optional>

#include "import/reader/frame_writer.h"
#include "import/reader/mesh_sink.h"
#include "import/scene_scope.h"

namespace roam::reader {

/// Reads requests from the standard input until its end: a u32 length and a token (page_token.h) of that many bytes.
/// For each request it writes a stream of its own (stream.h) with one part, starting with `greet`. Returns the exit
/// status of the process.
int serve_pages(FrameWriter& frames, const ReadingSettings& settings, const std::optional<Vec3>& origin,
                const SceneScope& scope, const std::function<void()>& greet);

}  // namespace roam::reader
