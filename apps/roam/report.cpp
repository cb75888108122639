#include "report.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "exit_status.h"
#include "roam/error.h"
#include "tell.h"

namespace roam::app {

namespace {

void write(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  if (errno == EPIPE) throw BrokenPipe();
  throw Error(std::string("cannot write the result: ") + std::strerror(errno));
}

}  // namespace

void print(const Json& report) {
  // Names come from files and may be any bytes; what is no UTF-8 is shown as U+FFFD.
  write(report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void print(const std::string& text) { write(printable_lines(text)); }

}  // namespace roam::app
