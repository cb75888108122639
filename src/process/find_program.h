#pragma once
/// \file
/// Where programs lie.

#include <filesystem>
#include <string>

namespace roam::process {

/// Whether it is a file that this user may run.
[[nodiscard]] bool can_run(const std::filesystem::path& program);
/// The program of that name in the folders of PATH, or an empty path.
[[nodiscard]] std::filesystem::path find_program(const std::string& name);
/// The folder of the running program; empty when the system does not tell.
[[nodiscard]] std::filesystem::path own_folder();

}  // namespace roam::process
