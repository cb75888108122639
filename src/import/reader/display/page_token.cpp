#include "import/reader/display/page_token.h"

#include <cmath>
#include <functional>
#include <span>

#include "import/display_part.h"
#include "import/stream.h"

namespace roam::reader {
namespace {

constexpr std::size_t name_limit = 256;

}  // namespace

std::uint64_t hash_of(const std::filesystem::path& file) { return std::hash<std::string>()(file.string()); }

std::string token_of(const PageContext& page) {
  PayloadWriter to;
  to.add_text(page.file.string()).add(page.offset);
  for (int i = 0; i < 16; ++i) to.add(page.to_world(i / 4, i % 4));
  to.add_text(std::string_view(page.name).substr(0, name_limit)).add(page.state);
  to.add(static_cast<std::uint32_t>(page.above.size()));
  for (const std::uint64_t file : page.above) to.add(file);
  const auto bytes = to.bytes();
  if (bytes.size() > DisplayLevel::page_limit) return {};
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::optional<PageContext> page_of(std::string_view token) {
  PayloadReader from(std::as_bytes(std::span(token)));
  PageContext page;
  page.file = from.take_text();
  page.offset = from.take<Vec3>();
  for (int i = 0; i < 16; ++i) page.to_world(i / 4, i % 4) = from.take<double>();
  page.name = from.take_text();
  page.state = from.take<std::uint32_t>();
  const auto above = from.take<std::uint32_t>();
  if (above > DisplayLevel::page_limit) return std::nullopt;
  for (std::uint32_t i = 0; i < above; ++i) page.above.push_back(from.take<std::uint64_t>());
  if (!from.complete() || page.file.empty()) return std::nullopt;
  return page;
}

}  // namespace roam::reader
