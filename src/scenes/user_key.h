#pragma once
/// \file
/// The key that distinguishes the user's own collision stores from those that came with a scene.

#include <filesystem>
#include <optional>
#include <string>

#include "roam/error.h"
#include "roam/store.h"

namespace roam::app {

/// $XDG_DATA_HOME/roam/store.key, else ~/.local/share/roam/store.key. Empty when neither variable is set.
[[nodiscard]] std::filesystem::path key_file();

struct UserKey {
  std::optional<StoreKey> key;
  Error problem{""};  ///< why there is none: a clause without a full stop, which names the file and what to do
};

/// The user's key. None if it does not exist, is damaged, is not the user's own, or if others may read or replace it.
[[nodiscard]] UserKey user_key();
/// The same, but makes a key if there is none, and stores it where only the user can read it. Throws roam::Error if the
/// disk is full or fails: later there may be a key, by which what was built meanwhile is not known.
[[nodiscard]] UserKey made_user_key();
/// A random key that is not stored anywhere, so a build with it continues no earlier build.
[[nodiscard]] StoreKey key_of_this_run();

}  // namespace roam::app
