#pragma once
/// \file
/// Standard input and output as files: the command line names them `-`.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "cli/report.h"

namespace roam::app {

/// Opens each of the three standard streams that is closed, so that no other file gets its number and with it what is
/// printed. Reading and writing it still fail. Call it before any file is opened.
void occupy_standard_streams();

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
