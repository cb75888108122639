#pragma once
/// A walk that is interrupted while it walks, however long its scene takes to read.

#include <string>
#include <vector>

#include "messages.h"
#include "program.h"

/// `arguments` start a walk that does not end by itself.
inline ProgramResult interrupted_walk(const std::string& program, const std::vector<std::string>& arguments) {
  ProgramResult result;
  for (const double after : {1.0, 5.0, 30.0}) {
    result = run_program(program, arguments, {.interrupt_after = after});
    if (!contains(result.err, "cancelled")) break;  // it had read its scene
  }
  return result;
}
