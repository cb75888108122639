#include "cli/failure.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "text/web_address.h"

namespace roam::app {

Json failure_report(const Error& error) {
  const std::string where = without_secrets(error.where());
  return {{"error",
           {{"message", without_secrets(error.what())},
            {"what", without_secrets(error.reason())},
            {"where", where.empty() ? Json(nullptr) : Json(where)}}}};
}

void print_failure(const Error& error, std::span<const std::string> arguments) {
  const auto has = [&](const char* option) {
    return std::find(arguments.begin(), arguments.end(), option) != arguments.end();
  };
  if (has("--json-lines")) return print_line(failure_report(error));
  if (has("--json") && !has_printed_json()) print(failure_report(error));
}

}  // namespace roam::app
