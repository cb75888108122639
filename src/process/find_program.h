#pragma once
/// \file
/// Paths of programs.

#include <filesystem>
#include <string>

namespace roam::process {

/// Whether the path is a file that this user may run.
[[nodiscard]] bool can_run(const std::filesystem::path& program);
/// The first program of that name in the absolute folders of PATH, or an empty path.
[[nodiscard]] std::filesystem::path find_program(const std::string& name);
/// The running program; empty if the system cannot say.
[[nodiscard]] std::filesystem::path own_program();
/// The folder of the shared library that this code is part of; empty if it is none, or if the system cannot say.
[[nodiscard]] std::filesystem::path library_folder();
/// The folder of the running program; empty if the system cannot say.
[[nodiscard]] std::filesystem::path own_folder();

}  // namespace roam::process
