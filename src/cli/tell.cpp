#include "cli/tell.h"

#include <cstdio>

#include "text/printable.h"
#include "text/web_address.h"

namespace roam::app {
namespace {

/// Characters of a line, far more than any sentence needs. Longer text is not a sentence.
constexpr std::size_t longest_line = 1000;

}  // namespace

void tell(std::string_view sentence, std::string_view program) {
  // A message that cannot be written, such as to a log on a full disk, is lost. The exit status still reports the
  // failure.
  std::fputs((std::string(program) + ": " + printable(without_secrets(sentence), longest_line) + "\n").c_str(), stderr);
}

std::string printable_lines(std::string_view text) {
  std::string lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines += printable(without_secrets(text.substr(0, end)), longest_line);
    if (end == std::string_view::npos) break;
    lines += '\n';
    text.remove_prefix(end + 1);
  }
  return lines;
}

std::string printable_part(std::string_view text) { return printable(without_secrets(text), longest_sentence); }

}  // namespace roam::app
