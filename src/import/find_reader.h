#pragma once
/// \file
/// Search for the program roam-reader.

#include <filesystem>

namespace roam::reader {

/// The program `wanted`. If that is empty, the program in the environment variable ROAM_READER; if that is empty too,
/// the first that can run of: beside the running program; ../libexec/roam from there; the reader of the package that
/// the program was built with; the installation of this build; ../libexec/roam from the folders of PATH. Throws
/// roam::Error if the named program cannot run, or with the list of these places.
[[nodiscard]] std::filesystem::path find_reader(const std::filesystem::path& wanted);

}  // namespace roam::reader
