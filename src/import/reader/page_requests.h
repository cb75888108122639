#pragma once
/// \file
/// A reader that stays: it reads the pages of a scene that the program asks for, one after the other.

#include <functional>
#include <optional>

#include "import/reader/frame_writer.h"
#include "import/reader/mesh_sink.h"
#include "import/scene_scope.h"

namespace roam::reader {

/// Takes requests from the standard input until it ends: a u32 length and a token (page_token.h) of so many bytes.
/// Answers each with a stream of its own (stream.h), from what `greet` sends to its end, with one part. Returns the
/// exit status of the process.
int serve_pages(FrameWriter& frames, const ReadingSettings& settings, const std::optional<Vec3>& origin,
                const SceneScope& scope, const std::function<void()>& greet);

}  // namespace roam::reader
