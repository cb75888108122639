#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "import/reader/display/ply_looks.h"
#include "import/reader/file_bytes.h"
#include "import/reader/formats.h"
#include "import/reader/numbers.h"
#include "import/reader/ply_header.h"
#include "roam/error.h"

// Greg Turk, "The PLY Polygon File Format", 1994.

namespace roam::reader {
namespace {

/// Reads the values of a binary file in sequence.
class BinaryValues {
 public:
  BinaryValues(FileBytes& bytes, bool swap) : bytes_(bytes), swap_(swap) {}

  double number(PlyType type) {
    switch (type) {
      case PlyType::float32:
        return std::bit_cast<float>(raw<std::uint32_t>());
      case PlyType::float64:
        return std::bit_cast<double>(raw<std::uint64_t>());
      default:
        return static_cast<double>(integer(type));
    }
  }
  std::int64_t integer(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return static_cast<std::int8_t>(raw<std::uint8_t>());
      case PlyType::uint8:
        return raw<std::uint8_t>();
      case PlyType::int16:
        return static_cast<std::int16_t>(raw<std::uint16_t>());
      case PlyType::uint16:
        return raw<std::uint16_t>();
      case PlyType::int32:
        return static_cast<std::int32_t>(raw<std::uint32_t>());
      default:
        return raw<std::uint32_t>();
    }
  }
  void skip(PlyType type) {
    need(bytes_of(type));
    bytes_.skip(bytes_of(type));
  }
  [[nodiscard]] std::string where() const { return fmt::format("{}: byte {}", bytes_.path(), bytes_.offset()); }
  /// Least bytes of an element.
  static std::size_t least_bytes(const PlyElement& element) { return element.least_bytes(); }

  /// Passes records of `bytes` each to `take` until it returns false: as many as lie in memory, `most` at most. Returns
  /// how many `take` accepted.
  template <class Take>
  std::uint64_t records(std::size_t bytes, std::uint64_t most, Take&& take) {
    const std::string_view window = bytes_.window(bytes);
    const std::uint64_t held = std::min<std::uint64_t>(window.size() / bytes, most);
    std::uint64_t taken = 0;
    while (taken < held && take(window.data() + taken * bytes)) ++taken;
    bytes_.skip(taken * bytes);
    return taken;
  }
  /// The value at this address.
  template <class T>
  [[nodiscard]] T value(const char* at) const {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), at, sizeof(T));
    if (swap_) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }
  static constexpr bool in_records = true;

 private:
  std::string_view need(std::size_t count) {
    const std::string_view window = bytes_.window(count);
    if (window.size() < count) throw Error(where(), "the file ends in the middle of its data; it is cut short.");
    return window;
  }
  template <class T>
  T raw() {
    const T taken = value<T>(need(sizeof(T)).data());
    bytes_.skip(sizeof(T));
    return taken;
  }

  FileBytes& bytes_;
  bool swap_;
};

/// Reads the values of a text file in sequence, regardless of line ends.
class AsciiValues {
 public:
  AsciiValues(FileBytes& bytes, Lines& lines) : bytes_(bytes), lines_(lines) {}

  double number(PlyType) {
    const std::string_view word = next_word();
    double value = 0.0;
    if (!parse(word, value)) throw Error(where(), fmt::format("'{}' is no number.", shown(word)));
    return value;
  }
  std::int64_t integer(PlyType) {
    const std::string_view word = next_word();
    std::int64_t value = 0;
    if (!parse(word, value)) throw Error(where(), fmt::format("'{}' is no integer.", shown(word)));
    return value;
  }
  void skip(PlyType) { next_word(); }
  [[nodiscard]] std::string where() const { return fmt::format("{}:{}", bytes_.path(), lines_.number()); }
  /// A digit and a blank for each value.
  static std::size_t least_bytes(const PlyElement& element) { return 2 * element.properties.size(); }
  static constexpr bool in_records = false;

 private:
  std::string_view next_word() {
    std::string_view word = take_word(line_);
    while (word.empty()) {
      if (!lines_.next(line_)) throw Error(where(), "the file ends in the middle of its data; it is cut short.");
      word = take_word(line_);
    }
    return word;
  }

  FileBytes& bytes_;
  Lines& lines_;
  std::string_view line_;
};

template <class Values>
class PlyBody {
 public:
  PlyBody(FileBytes& bytes, const PlyHeader& header, Values values, MeshSink& sink)
      : bytes_(bytes), header_(header), values_(values), sink_(sink), wedges_(header, bytes.path(), sink) {}

  void read() {
    for (const PlyElement& element : header_.elements) {
      check_size(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (const int list = index_list(element); list >= 0) {
        read_faces(element, list);
      } else {
        skip(element);
      }
    }
    if (small_faces_ > 0) {
      sink_.report_note(fmt::format("{}: {}.", bytes_.path(), skipped_faces_text(small_faces_)));
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(values_.where(), fmt::format("{}.", what)); }

  /// Refuses a header that promises more elements than the file can hold, before they are read.
  void check_size(const PlyElement& element) const {
    const std::uint64_t left = bytes_.size() - std::min(bytes_.size(), bytes_.offset()) + 1;
    const std::size_t least = Values::least_bytes(element);
    if (least > 0 && element.count > left / least) {
      fail(fmt::format("the header says {} times '{}', but the file is too short for it; it is cut short",
                       element.count, element.name));
    }
  }

  /// The index of the property that lists the vertices of a face or strip, or -1.
  static int index_list(const PlyElement& element) {
    if (element.name != "face" && element.name != "tristrips") return -1;
    int found = -1;
    for (const char* name : {"vertex_indices", "vertex_index"}) {
      const int i = element.find(name);
      if (found < 0 && i >= 0 && element.properties[static_cast<std::size_t>(i)].list) found = i;
    }
    return found;
  }

  void read_vertices(const PlyElement& element) {
    const std::array<int, 3> at{element.find("x"), element.find("y"), element.find("z")};
    if (at[0] < 0 || at[1] < 0 || at[2] < 0) fail("the element 'vertex' has no x, y and z");
    const PlyLooks looks(element, header_, bytes_.path(), sink_);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if constexpr (Values::in_records) {
        if (sink_.parts() == nullptr) i += take_plain_vertices(element, at, element.count - i);
        if (i == element.count) return;
      }
      Vec3 v{0.0};
      VertexLook look;
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        const auto axis = static_cast<int>(std::find(at.begin(), at.end(), static_cast<int>(p)) - at.begin());
        if (axis < 3 && !property.list) {
          v[axis] = values_.number(property.type);
        } else if (looks.wants(p)) {
          looks.take(p, values_.number(property.type), look);
        } else {
          skip(property);
        }
      }
      if (wedges_.wanted()) {
        wedges_.add_vertex(v, look);
      } else {
        sink_.add_vertex(v, look);
      }
    }
  }

  /// Reads vertices directly from the buffer, if the coordinates are all floats or all doubles and there is no list.
  std::uint64_t take_plain_vertices(const PlyElement& element, const std::array<int, 3>& at, std::uint64_t most) {
    if (element.has_list()) return 0;
    std::array<std::size_t, 3> offset{};
    const PlyType type = element.properties[static_cast<std::size_t>(at[0])].type;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto position = static_cast<std::size_t>(at[k]);
      if (element.properties[position].type != type || is_integer(type)) return 0;
      for (std::size_t p = 0; p < position; ++p) offset[k] += bytes_of(element.properties[p].type);
    }
    const auto as = [&](auto zero) {
      using T = decltype(zero);
      return values_.records(element.least_bytes(), most, [&](const char* vertex) {
        sink_.add_vertex({values_.template value<T>(vertex + offset[0]), values_.template value<T>(vertex + offset[1]),
                          values_.template value<T>(vertex + offset[2])});
        return true;
      });
    };
    return type == PlyType::float32 ? as(float{}) : as(double{});
  }

  /// Reads triangles directly from the buffer, if a face is only the byte 3 and four bytes for each corner. Stops
  /// before the first other face.
  std::uint64_t take_plain_triangles(const PlyElement& element, std::uint64_t most) {
    const PlyProperty& corners = element.properties.front();
    const bool plain = element.properties.size() == 1 && bytes_of(corners.count_type) == 1 &&
                       (corners.type == PlyType::int32 || corners.type == PlyType::uint32);
    if (!plain || wedges_.wanted()) return 0;
    const std::uint32_t count = sink_.vertex_count();
    return values_.records(1 + 3 * sizeof(std::uint32_t), most, [&](const char* face) {
      const auto a = values_.template value<std::uint32_t>(face + 1);
      const auto b = values_.template value<std::uint32_t>(face + 5);
      const auto c = values_.template value<std::uint32_t>(face + 9);
      // The ordinary way of reading this face reports what is wrong with it.
      if (*face != 3 || std::max({a, b, c}) >= count) return false;
      sink_.add_triangle(a, b, c);
      return true;
    });
  }

  void read_faces(const PlyElement& element, int list) {
    const auto list_at = static_cast<std::size_t>(list);
    if (!is_integer(element.properties[list_at].type)) fail("the vertices of a face are no integers");
    const bool strips = element.name == "tristrips";
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if constexpr (Values::in_records) {
        if (!strips) i += take_plain_triangles(element, element.count - i);
        if (i == element.count) return;
      }
      if (wedges_.wanted()) {
        read_wedges(element, list_at);
        continue;
      }
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (p != list_at) {
          skip(property);
        } else if (strips) {
          read_strip(property);
        } else {
          read_polygon(property);
        }
      }
    }
  }

  /// Reads a face whose corners have texture coordinates. Their list may come before or after that of the vertices.
  void read_wedges(const PlyElement& element, std::size_t list_at) {
    corners_.clear();
    coordinates_.clear();
    std::int64_t image = 0;
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (p == list_at) {
        const std::int64_t length = length_of_list(property);
        if (length < 3) ++small_faces_;
        for (std::int64_t k = 0; k < length; ++k) corners_.push_back(checked(values_.integer(property.type)));
      } else if (wedges_.is_coordinates(property)) {
        const std::int64_t length = length_of_list(property);
        for (std::int64_t k = 0; k < length; ++k) coordinates_.push_back(values_.number(property.type));
      } else if (wedges_.is_image(property)) {
        image = values_.integer(property.type);
      } else {
        skip(property);
      }
    }
    wedges_.add_face(corners_, coordinates_, image);
  }

  std::int64_t length_of_list(const PlyProperty& property) {
    const std::int64_t length = values_.integer(property.count_type);
    if (length < 0) fail(fmt::format("a list of {} items", length));
    return length;
  }

  std::uint32_t checked(std::int64_t index) const {
    const std::uint64_t count = wedges_.wanted() ? wedges_.vertex_count() : sink_.vertex_count();
    if (index < 0 || static_cast<std::uint64_t>(index) >= count) {
      fail(fmt::format("a face refers to vertex {}, but {} vertices come before it (counted from 0)", index, count));
    }
    return static_cast<std::uint32_t>(index);
  }

  void read_polygon(const PlyProperty& property) {
    const std::int64_t length = length_of_list(property);
    if (length < 3) ++small_faces_;
    std::uint32_t first = 0, before = 0;
    for (std::int64_t k = 0; k < length; ++k) {
      const std::uint32_t corner = checked(values_.integer(property.type));
      if (k == 0) first = corner;
      if (k >= 2) sink_.add_triangle(first, before, corner);
      before = corner;
    }
  }

  /// Reads the list of all strips, which are separated by -1.
  void read_strip(const PlyProperty& property) {
    const std::int64_t length = length_of_list(property);
    std::array<std::uint32_t, 2> before{};
    std::int64_t in_strip = 0;
    for (std::int64_t k = 0; k < length; ++k) {
      const std::int64_t index = values_.integer(property.type);
      if (index == -1) {
        in_strip = 0;
        continue;
      }
      const std::uint32_t corner = checked(index);
      if (in_strip >= 2) {
        const bool odd = in_strip % 2 == 1;
        sink_.add_triangle(before[odd ? 1 : 0], before[odd ? 0 : 1], corner);
      }
      before = {before[1], corner};
      ++in_strip;
    }
  }

  void skip(const PlyProperty& property) {
    const std::int64_t length = property.list ? length_of_list(property) : 1;
    for (std::int64_t k = 0; k < length; ++k) values_.skip(property.type);
  }

  void skip(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) skip(property);
    }
  }

  FileBytes& bytes_;
  const PlyHeader& header_;
  Values values_;
  MeshSink& sink_;
  PlyWedges wedges_;
  std::vector<std::uint32_t> corners_;
  std::vector<double> coordinates_;
  std::uint64_t small_faces_ = 0;
};

}  // namespace

void read_ply(const std::filesystem::path& path, MeshSink& sink) {
  FileBytes bytes(path, [&sink](std::uint64_t read) { sink.report_progress(read); });
  Lines lines(bytes);
  const PlyHeader header = read_ply_header(bytes, lines);
  sink.begin_object({}, path.stem().string());
  if (header.format == PlyFormat::ascii) {
    PlyBody(bytes, header, AsciiValues(bytes, lines), sink).read();
  } else {
    const bool big = header.format == PlyFormat::big_endian;
    PlyBody(bytes, header, BinaryValues(bytes, big == (std::endian::native == std::endian::little)), sink).read();
  }
  sink.count_file();
}

}  // namespace roam::reader
