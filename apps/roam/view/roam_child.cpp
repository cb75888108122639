#include "view/roam_child.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "process/find_program.h"
#include "process/lines.h"

namespace roam::app {

VerbEnd run_verb(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                 const std::function<bool()>& wanted, const std::function<void(const std::string&)>& take) {
  constexpr std::chrono::milliseconds patience{50};
  process::Lines lines;
  process::Child child(program.empty() ? process::own_program() : program, arguments,
                       {.descriptors = {{lines.theirs(), STDOUT_FILENO}}});
  lines.child_has_started();
  while (!lines.ended()) {
    if (!wanted()) {
      child.end();
      throw Cancelled();
    }
    if (const std::optional<std::string> line = lines.next(patience)) take(*line);
  }
  if (!child.wait(process::Child::usual_grace)) child.end();
  return {child.ending(), child.last_words()};
}

Error printed_error(const Json& error) {
  const Json& where = error.at("where");
  return Error::at(where.is_null() ? std::string() : where.get<std::string>(), error.at("message"));
}

Error silent_end(const std::string& verb, const VerbEnd& end) {
  const process::Ending& ending = end.ending;
  return Error(fmt::format("`roam {}` {} {}{}", verb, ending.signal != 0 ? "was ended by signal" : "ended with status",
                           ending.signal != 0 ? ending.signal : ending.exit_code,
                           end.last_words.empty() ? "" : ": " + end.last_words));
}

}  // namespace roam::app
