#pragma once
/// \file
/// Where the program roam-reader is.

#include <filesystem>

namespace roam::reader {

/// The program that `wanted` names, or, when that is empty, the first that exists of: the environment variable
/// ROAM_READER, beside the running program, ../libexec/roam from there, where it was installed to,
/// ../libexec/roam from the folders of PATH. Throws roam::Error that lists these places.
[[nodiscard]] std::filesystem::path find_reader(const std::filesystem::path& wanted);

}  // namespace roam::reader
