#include "import/reader/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "import/reader/numbers.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

struct NamedType {
  std::string_view name;
  PlyType type;
};
constexpr std::array<NamedType, 16> types{{{"char", PlyType::int8},
                                           {"uchar", PlyType::uint8},
                                           {"short", PlyType::int16},
                                           {"ushort", PlyType::uint16},
                                           {"int", PlyType::int32},
                                           {"uint", PlyType::uint32},
                                           {"float", PlyType::float32},
                                           {"double", PlyType::float64},
                                           {"int8", PlyType::int8},
                                           {"uint8", PlyType::uint8},
                                           {"int16", PlyType::int16},
                                           {"uint16", PlyType::uint16},
                                           {"int32", PlyType::int32},
                                           {"uint32", PlyType::uint32},
                                           {"float32", PlyType::float32},
                                           {"float64", PlyType::float64}}};

/// A header has a few dozen lines; a file with more than this has no header.
constexpr std::uint64_t line_limit = 10000;

class HeaderParser {
 public:
  HeaderParser(FileBytes& bytes, Lines& lines) : bytes_(bytes), lines_(lines) {}

  PlyHeader parse_all() {
    if (next_line() != "ply") fail("this is no PLY file: its first line is not 'ply'");
    while (true) {
      std::string_view line = next_line();
      const std::string_view keyword = take_word(line);
      if (keyword == "end_header") break;
      if (keyword == "format") {
        take_format(line);
      } else if (keyword == "element") {
        take_element(line);
      } else if (keyword == "property") {
        take_property(line);
      } else if (keyword == "comment") {
        if (take_word(line) == "TextureFile") header_.texture_files.emplace_back(trimmed(line));
      } else if (!keyword.empty() && keyword != "obj_info") {
        fail(fmt::format("'{}' is no word of a PLY header", shown(keyword)));
      }
    }
    if (!has_format_) fail("the header has no line 'format'");
    return header_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(fmt::format("{}:{}", bytes_.path(), lines_.number()), fmt::format("{}.", what));
  }

  std::string_view next_line() {
    std::string_view line;
    if (lines_.number() >= line_limit || !lines_.next(line)) fail("the header has no line 'end_header'");
    return trimmed(line);
  }

  void take_format(std::string_view rest) {
    const std::string_view name = take_word(rest);
    if (name == "ascii") {
      header_.format = PlyFormat::ascii;
    } else if (name == "binary_little_endian") {
      header_.format = PlyFormat::little_endian;
    } else if (name == "binary_big_endian") {
      header_.format = PlyFormat::big_endian;
    } else {
      fail(fmt::format("the format '{}' is not one of PLY", shown(name)));
    }
    has_format_ = true;
  }

  void take_element(std::string_view rest) {
    PlyElement element;
    element.name = take_word(rest);
    std::int64_t count = 0;
    if (element.name.empty() || !parse(take_word(rest), count) || count < 0) {
      fail("'element' needs a name and a count");
    }
    element.count = static_cast<std::uint64_t>(count);
    header_.elements.push_back(std::move(element));
  }

  PlyType take_type(std::string_view& rest) const {
    const std::string_view name = take_word(rest);
    const auto* found = std::find_if(types.begin(), types.end(), [&](const NamedType& t) { return t.name == name; });
    if (found == types.end()) fail(fmt::format("'{}' is no type of PLY", shown(name)));
    return found->type;
  }

  void take_property(std::string_view rest) {
    if (header_.elements.empty()) fail("a property comes before the first element");
    PlyProperty property;
    std::string_view after_list = rest;
    if (take_word(after_list) == "list") {
      rest = after_list;
      property.list = true;
      property.count_type = take_type(rest);
      if (!is_integer(property.count_type)) fail("the length of a list is no integer");
    }
    property.type = take_type(rest);
    property.name = take_word(rest);
    if (property.name.empty()) fail("a property has no name");
    header_.elements.back().properties.push_back(std::move(property));
  }

  FileBytes& bytes_;
  Lines& lines_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

std::size_t bytes_of(PlyType type) {
  constexpr std::array<std::size_t, 8> bytes{1, 1, 2, 2, 4, 4, 4, 8};
  return bytes[static_cast<std::size_t>(type)];
}

std::size_t PlyElement::least_bytes() const {
  std::size_t bytes = 0;
  for (const PlyProperty& property : properties) bytes += bytes_of(property.list ? property.count_type : property.type);
  return bytes;
}

bool PlyElement::has_list() const {
  return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.list; });
}

int PlyElement::find(std::string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name == property) return static_cast<int>(i);
  }
  return -1;
}

PlyHeader read_ply_header(FileBytes& bytes, Lines& lines) { return HeaderParser(bytes, lines).parse_all(); }

}  // namespace roam::reader
