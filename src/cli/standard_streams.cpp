#include "cli/standard_streams.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "cli/exit_status.h"
#include "cli/report.h"
#include "cli/tell.h"
#include "files/descriptor.h"
#include "files/whole_file.h"
#include "roam/error.h"
#include "text/stream_of.h"

namespace roam::app {

void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest free number is given to what is opened next.
    if (::fcntl(stream, F_GETFD) < 0) (void)::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

std::string read_input(const std::filesystem::path& file, std::uint64_t limit) {
  if (!is_standard(file)) return files::read_named(file, limit);
  std::string text;
  std::array<char, 65536> piece;
  for (;;) {
    const ssize_t got = files::again([&] { return ::read(STDIN_FILENO, piece.data(), piece.size()); });
    if (got < 0) throw Error::at("-", std::string("cannot read standard input: ") + std::strerror(errno));
    if (got == 0) return text;
    text.append(piece.data(), static_cast<std::size_t>(got));
    if (text.size() > limit)
      throw Error::at("-", fmt::format("cannot read standard input: more than {} bytes; is it the right file?", limit));
  }
}

void write_output(std::string_view text) {
  while (!text.empty()) {
    const ssize_t put = files::again([&] { return ::write(STDOUT_FILENO, text.data(), text.size()); });
    if (put < 0 && errno == EPIPE) throw BrokenPipe();
    if (put < 0) throw Error::at("-", std::string("cannot write standard output: ") + std::strerror(errno));
    text.remove_prefix(static_cast<std::size_t>(put));
  }
}

void print_report(bool json, const Json& report, const std::string& text, const std::filesystem::path& file) {
  const std::string printable = printable_lines(text);
  if (!json && is_standard(file)) {
    std::fputs(printable.c_str(), stderr);
  } else if (!json) {
    print(text);
  } else {
    Json whole = report;
    for (std::string& line : parts_of(printable, '\n')) whole["text"].push_back(std::move(line));
    print(whole);
  }
}

void demand_one_output(const char* option, const std::filesystem::path& file, bool json) {
  if (json && is_standard(file))
    throw UsageError(Error::at(
        option, fmt::format("{} - and --json both write to standard output: name a file for {}", option, option)));
}

}  // namespace roam::app
