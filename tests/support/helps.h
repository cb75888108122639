#pragma once
/// Help of the program and all verbs, as it prints it.

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "program.h"

/// Of {"make", "city"}.
inline std::string help_of(std::vector<std::string> verb) {
  verb.push_back("--help");
  const ProgramResult result = run_program(ROAM_PROGRAM, verb);
  EXPECT_EQ(result.status, 0) << result.err;
  return result.out;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Names in the section "Verbs:" or "Kinds:".
inline std::vector<std::string> names_in(const std::string& help) {
  std::vector<std::string> names;
  bool listed = false;
  for (const std::string& line : lines_of(help)) {
    if (line == "Verbs:" || line == "Kinds:") {
      listed = true;
    } else if (line.empty()) {
      listed = false;
    } else if (listed && line.starts_with("  ") && line[2] != ' ') {
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
  }
  return names;
}

struct Help {
  std::string verb;  ///< "roam make city"
  std::string text;
};

/// The helps of the program, its verbs and their kinds. Those of bench are in another program.
inline std::vector<Help> all_helps() {
  std::vector<Help> helps{{"roam", help_of({})}};
  for (const std::string& verb : names_in(helps.front().text)) {
    helps.push_back({"roam " + verb, help_of({verb})});
    if (verb == "bench") continue;
    for (const std::string& kind : names_in(helps.back().text)) {
      helps.push_back({"roam " + verb + " " + kind, help_of({verb, kind})});
    }
  }
  EXPECT_GE(helps.size(), 14u);
  return helps;
}
