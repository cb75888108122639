#pragma once
/// \file
/// The key by which the user's own collision stores are told from those that came with a scene.

#include <filesystem>
#include <optional>
#include <string>

#include "roam/store.h"

namespace roam::app {

/// $XDG_DATA_HOME/roam/store.key, else ~/.local/share/roam/store.key. Empty when neither variable is set.
[[nodiscard]] std::filesystem::path key_file();

struct UserKey {
  std::optional<StoreKey> key;
  std::string problem;  ///< why there is none: a clause without a full stop, which names the file and what to do
};

/// The user's key. Nothing where it is not there, is damaged, is not the user's own, or others may read or replace it.
[[nodiscard]] UserKey user_key();
/// The same. Where there is none yet it is made, and kept where only the user can read it.
[[nodiscard]] UserKey made_user_key();
/// A key that nobody keeps: what was not built with it is not built upon.
[[nodiscard]] StoreKey key_of_this_run();

}  // namespace roam::app
