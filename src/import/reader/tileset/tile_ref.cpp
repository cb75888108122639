#include "import/reader/tileset/tile_ref.h"

#include <span>

#include "import/display_part.h"
#include "import/stream.h"

namespace roam::reader {
namespace {

/// The first text of a token. Those of OpenSceneGraph's pages begin with an absolute path.
constexpr std::string_view own_page = "tile", page_of_children = "children";
constexpr std::uint8_t most_token_levels = 60;

void add(PayloadWriter& to, const glm::dmat4& matrix) {
  for (int i = 0; i < 16; ++i) to.add(matrix[i / 4][i % 4]);
}

glm::dmat4 take_matrix(PayloadReader& from) {
  glm::dmat4 matrix;
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = from.take<double>();
  return matrix;
}

}  // namespace

std::string token_of(const TilePage& page) {
  const TileRef& tile = page.tile;
  PayloadWriter to;
  to.add_text(page.of_children ? page_of_children : own_page).add_text(tile.file.string()).add(tile.number);
  to.add(static_cast<std::uint8_t>(tile.implicit.has_value()));
  const ImplicitTile implicit = tile.implicit.value_or(ImplicitTile{});
  to.add(implicit.level).add(implicit.x).add(implicit.y).add(implicit.z);
  add(to, tile.above);
  add(to, tile.earth);
  to.add(tile.refine).add(tile.error).add(static_cast<std::uint32_t>(tile.around.size()));
  for (const std::uint64_t file : tile.around) to.add(file);
  const auto bytes = to.bytes();
  if (bytes.size() > DisplayLevel::page_limit) return {};
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::optional<TilePage> tile_page_of(std::string_view token) {
  PayloadReader from(std::as_bytes(std::span(token)));
  const std::string kind = from.take_text();
  if (kind != own_page && kind != page_of_children) return std::nullopt;
  TilePage page;
  page.of_children = kind == page_of_children;
  TileRef& tile = page.tile;
  tile.file = from.take_text();
  tile.number = from.take<std::uint32_t>();
  const bool is_implicit = from.take<std::uint8_t>() != 0;
  ImplicitTile implicit;
  for (std::uint64_t* value : {&implicit.level, &implicit.x, &implicit.y, &implicit.z}) {
    *value = from.take<std::uint64_t>();
  }
  if (implicit.level > most_token_levels) return std::nullopt;
  if (is_implicit) tile.implicit = implicit;
  tile.above = take_matrix(from);
  tile.earth = take_matrix(from);
  tile.refine = from.take<std::uint8_t>() == 0 ? Refine::replace : Refine::add;
  tile.error = from.take<double>();
  const auto around = from.take<std::uint32_t>();
  if (around > DisplayLevel::page_limit) return std::nullopt;
  for (std::uint32_t i = 0; i < around; ++i) tile.around.push_back(from.take<std::uint64_t>());
  if (!from.complete() || tile.file.empty()) return std::nullopt;
  return page;
}

}  // namespace roam::reader
