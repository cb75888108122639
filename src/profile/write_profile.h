#pragma once
/// \file
/// Writing a profile that somebody named, which is written through a link.

#include "files/place.h"
#include "files/whole_file.h"
#include "roam/profile.h"

namespace roam {

/// Profiles, whatever spaces they have, and empty files.
[[nodiscard]] files::FileKind profiles();
/// save_profile() of this naming, which replaces only files of this kind.
void write_profile(const Profile& profile, const std::filesystem::path& file, files::Naming naming,
                   files::FileKind replaced);

}  // namespace roam
