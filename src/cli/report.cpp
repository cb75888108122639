#include "cli/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "cli/exit_status.h"
#include "cli/tell.h"
#include "roam/error.h"
#include "roam/version.h"
#include "text/printable.h"

namespace roam::app {

namespace {

bool json_printed = false;

void write(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  if (errno == EPIPE) throw BrokenPipe();
  throw Error(std::string("cannot write the result: ") + std::strerror(errno));
}

/// JSON text with the same data, but without control characters. They occur only in its strings, apart from line ends.
std::string without_controls(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  while (!text.empty()) {
    const Character c = first_character(text);
    const std::size_t bytes = std::max<std::size_t>(c.bytes, 1);
    if (c.bytes > 0 && c.code != '\n' && is_control(c.code)) {
      const auto code = static_cast<std::uint32_t>(c.code);
      escaped += code < 0x10000 ? fmt::format("\\u{:04x}", code)
                                : fmt::format("\\u{:04x}\\u{:04x}", 0xD7C0 + (code >> 10), 0xDC00 + (code & 0x3FF));
    } else {
      escaped += text.substr(0, bytes);
    }
    text.remove_prefix(bytes);
  }
  return escaped;
}

/// Names come from files and may be any bytes; invalid UTF-8 is shown as U+FFFD.
void write(const Json& json, int indent) {
  Json stamped = {{"roam", ROAM_VERSION_STRING}, {"schema", json_schema}};
  stamped.update(json);
  write(without_controls(stamped.dump(indent, ' ', false, Json::error_handler_t::replace)) + "\n");
}

}  // namespace

Json to_json(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

Json to_json(const Box& box) { return {{"min", to_json(box.lower)}, {"max", to_json(box.upper)}}; }

Json to_json(const PagerStats& paging) {
  return {{"memory", paging.memory},
          {"used", paging.used},
          {"tiles", paging.tiles},
          {"pages", paging.pages},
          {"triangles", paging.triangles},
          {"wanted", paging.wanted},
          {"loads", paging.loads},
          {"evictions", paging.evictions},
          {"failures", paging.failures},
          {"failed", paging.failed},
          {"bytes_read", paging.bytes_read},
          {"worst_read_s", paging.longest_read},
          {"worst_decode_s", paging.longest_decode},
          {"ready_m", paging.ready_radius},
          {"last_failure", paging.last_failure}};
}

void print(const Json& report) {
  json_printed = true;
  write(report, 2);
}

void print_line(const Json& object) { write(object, -1); }

void print(const std::string& text) { write(printable_lines(text)); }

bool has_printed_json() { return json_printed; }

}  // namespace roam::app
