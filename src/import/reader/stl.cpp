#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "import/reader/file_bytes.h"
#include "import/reader/formats.h"
#include "import/reader/numbers.h"
#include "roam/error.h"
#include "text/byte_order_mark.h"

// 3D Systems, "Stereolithography Interface Specification", 1989.

namespace roam::reader {
namespace {

constexpr std::size_t header_bytes = 80;
constexpr std::size_t count_bytes = 4;
constexpr std::size_t facet_bytes = 50;
constexpr std::size_t normal_bytes = 12;

template <class T>
T little_endian(const char* bytes) {
  static_assert(std::endian::native == std::endian::little, "the readers of binary files expect such a machine");
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

/// Whether the file is binary. Such files may begin with "solid" too. The length decides; failing that, whether the
/// file reads as text.
bool is_binary(FileBytes& bytes) {
  const std::string_view start = bytes.window(header_bytes + count_bytes);
  if (start.size() >= header_bytes + count_bytes) {
    const std::uint64_t count = little_endian<std::uint32_t>(start.data() + header_bytes);
    if (bytes.size() == header_bytes + count_bytes + facet_bytes * count) return true;
  }
  std::string_view rest = start;
  while (!rest.empty() && std::isspace(static_cast<unsigned char>(rest.front()))) rest.remove_prefix(1);
  std::string word(without_byte_order_mark(rest).substr(0, 5));
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  return word != "solid" || start.find('\0') != std::string_view::npos;
}

void read_binary(FileBytes& bytes, const std::string& stem, MeshSink& sink) {
  const std::string_view start = bytes.window(header_bytes + count_bytes);
  if (start.size() < header_bytes + count_bytes) {
    throw Error(bytes.path(), fmt::format("this is no STL file: it is shorter than the {} bytes of a header.",
                                          header_bytes + count_bytes));
  }
  const std::uint64_t count = little_endian<std::uint32_t>(start.data() + header_bytes);
  const std::uint64_t held = (bytes.size() - header_bytes - count_bytes) / facet_bytes;
  if (held < count) {
    throw Error(
        bytes.path(),
        fmt::format("the header says {} triangles, but the file ends after {}; it is cut short, or no STL file.", count,
                    held));
  }
  if (bytes.size() > header_bytes + count_bytes + facet_bytes * count) {
    sink.report_note(fmt::format("{}: {} bytes after the last of the {} triangles that the header says were not read.",
                                 bytes.path(), bytes.size() - header_bytes - count_bytes - facet_bytes * count, count));
  }
  bytes.skip(header_bytes + count_bytes);
  sink.begin_object({}, stem);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string_view facet = bytes.window(facet_bytes);
    if (facet.size() < facet_bytes) {
      throw Error(bytes.path(), fmt::format("the file ends in triangle {} of {}; was it being written?", i, count));
    }
    std::array<float, 9> c;
    std::memcpy(c.data(), facet.data() + normal_bytes, sizeof(c));
    bytes.skip(facet_bytes);
    sink.add_polygon(std::array<Vec3, 3>{{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}}});
  }
}

class AsciiStl {
 public:
  AsciiStl(FileBytes& bytes, std::string stem, MeshSink& sink)
      : bytes_(bytes), lines_(bytes), stem_(std::move(stem)), sink_(sink) {}

  void read() {
    std::string_view line;
    while (lines_.next(line)) {
      // Usually a line has one statement, but more are allowed.
      for (std::string_view rest = line; !(skip_blanks(rest), rest.empty());) take_statement(rest);
    }
    if (inside_ != Inside::nothing) fail("the file ends inside a solid; it is cut short");
  }

 private:
  enum class Inside { nothing, solid, facet, loop };

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(fmt::format("{}:{}", bytes_.path(), lines_.number()), fmt::format("{}.", what));
  }

  static bool same(std::string_view word, std::string_view keyword) {
    return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                      [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
  }

  void step(Inside from, Inside to, std::string_view word) {
    if (inside_ != from) fail(fmt::format("'{}' is not expected here", word));
    inside_ = to;
  }

  void take_statement(std::string_view& rest) {
    const std::string_view word = take_word(rest);
    if (same(word, "vertex")) {
      step(Inside::loop, Inside::loop, word);
      return take_vertex(rest);
    }
    if (same(word, "facet")) {
      step(Inside::solid, Inside::facet, word);
      // The normal follows from the corners, and is often wrong.
      for (int words = 0; words < 4; ++words) take_word(rest);
    } else if (same(word, "outer")) {
      step(Inside::facet, Inside::loop, word);
      if (!same(take_word(rest), "loop")) fail("'outer' is not followed by 'loop'");
      corners_.clear();
    } else if (same(word, "endloop")) {
      step(Inside::loop, Inside::facet, word);
      finish_facet();
    } else if (same(word, "endfacet")) {
      step(Inside::facet, Inside::solid, word);
    } else if (same(word, "solid")) {
      step(Inside::nothing, Inside::solid, word);
      const std::array<std::string, 1> name{std::string(trimmed(rest))};
      sink_.begin_object(name, stem_);
      rest = {};
    } else if (same(word, "endsolid")) {
      step(Inside::solid, Inside::nothing, word);
      rest = {};
    } else {
      fail(fmt::format("'{}' is no word of STL", shown(word)));
    }
  }

  void take_vertex(std::string_view& rest) {
    Vec3 v{0.0};
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = take_word(rest);
      if (!parse(word, v[k])) fail(fmt::format("'{}' is no coordinate", shown(word)));
    }
    corners_.push_back(v);
  }

  void finish_facet() {
    if (corners_.size() < 3) fail("a facet needs three vertices");
    sink_.add_polygon(corners_);
  }

  FileBytes& bytes_;
  Lines lines_;
  std::string stem_;
  MeshSink& sink_;
  Inside inside_ = Inside::nothing;
  std::vector<Vec3> corners_;
};

}  // namespace

void read_stl(const std::filesystem::path& path, MeshSink& sink) {
  FileBytes bytes(path, [&sink](std::uint64_t read) { sink.report_progress(read); });
  const std::string stem = path.stem().string();
  if (is_binary(bytes)) {
    read_binary(bytes, stem, sink);
  } else {
    AsciiStl(bytes, stem, sink).read();
  }
  sink.count_file();
}

}  // namespace roam::reader
