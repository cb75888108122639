#pragma once
/// \file
/// Standard input and output as files: the command line names them `-`.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "cli/report.h"

namespace roam::app {

[[nodiscard]] inline bool is_standard(const std::filesystem::path& file) { return file == "-"; }

/// The text of standard input for `-`, else of the file as files::read_named() reads it. Throws roam::Error if it
/// cannot be read or has more than `limit` bytes.
[[nodiscard]] std::string read_input(const std::filesystem::path& file, std::uint64_t limit);

/// Writes to standard output, unbuffered. Throws BrokenPipe if nobody reads it, roam::Error if it cannot be written.
void write_output(std::string_view text);

/// Prints a report: its text; with `json` the object, with the lines of the text as its last member, "text". Standard
/// output is taken while `file` is `-`, so the text then goes to standard error.
void print_report(bool json, const Json& report, const std::string& text, const std::filesystem::path& file = {});

/// Throws UsageError if `file` and a JSON report would both go to standard output.
void demand_one_output(const char* option, const std::filesystem::path& file, bool json);

}  // namespace roam::app
