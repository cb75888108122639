#pragma once
/// \file
/// What OpenSceneGraph says by itself, for people.

namespace roam::app {

/// From now on it goes to standard error, made printable: it may hold names of a scene's files.
void make_notices_printable();

}  // namespace roam::app
