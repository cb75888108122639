#include <fmt/format.h>

#include <iterator>

#include "import/reader/numbers.h"
#include "import/reader/tileset/outline.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view start = "tile";

}  // namespace

std::string token_of(const TileContent& content, const fs::path& folder) {
  const fs::path inside = content.file.lexically_relative(folder);
  const bool is_inside = !inside.empty() && *inside.begin() != "..";
  const UpAxis up = content.place.gltf_up;
  std::string token = fmt::format("{} {}", start, up == UpAxis::x ? 'x' : up == UpAxis::z ? 'z' : 'y');
  for (int column = 0; column < 4; ++column) {
    for (int k = 0; k < 3; ++k) fmt::format_to(std::back_inserter(token), " {}", content.place.to_scene[column][k]);
  }
  return token + " " + (is_inside ? inside : content.file).string();
}

std::optional<TileContent> content_of(std::string_view token, const fs::path& folder) {
  if (take_word(token) != start) return std::nullopt;
  const std::string_view up = take_word(token);
  TileContent content;
  content.place.gltf_up = up == "x" ? UpAxis::x : up == "z" ? UpAxis::z : UpAxis::y;
  for (int column = 0; column < 4; ++column) {
    for (int k = 0; k < 3; ++k) {
      if (!parse(take_word(token), content.place.to_scene[column][k])) return std::nullopt;
    }
  }
  // The path, which may begin with blanks, is after one of them.
  if (token.size() < 2) return std::nullopt;
  content.file = (folder / fs::path(token.substr(1))).lexically_normal();
  return content;
}

}  // namespace roam::reader
