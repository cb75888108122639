#pragma once
/// \file
/// OpenSceneGraph's own notices, made printable.

namespace roam::app {

/// Sends the notices to standard error, made printable, as they may contain names of a scene's files.
void make_notices_printable();

}  // namespace roam::app
