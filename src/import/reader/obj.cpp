#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "import/reader/display/obj_looks.h"
#include "import/reader/file_bytes.h"
#include "import/reader/formats.h"
#include "import/reader/numbers.h"
#include "import/reader/vertex_pool.h"
#include "roam/error.h"

// Wavefront Technologies, "Object Files (.obj)", appendix B1 of the Advanced Visualizer manual, 1995.

namespace roam::reader {
namespace {

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, MeshSink& sink)
      : sink_(sink),
        bytes_(path, [&sink](std::uint64_t read) { sink.report_progress(read); }),
        lines_(bytes_),
        stem_(path.stem().string()) {
    if (sink.parts() != nullptr) looks_.emplace(path, sink);
    if (sink.in_pieces()) sink.share_vertices();
  }

  void read() {
    std::string_view line;
    while (lines_.next(line)) {
      number_ = lines_.number();
      // Most lines are parsed without a copy.
      if (line.ends_with('\\')) line = continued(line);
      take_line(line);
    }
    say_what_was_skipped();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(fmt::format("{}:{}", bytes_.path(), number_), fmt::format("{}.", what));
  }

  std::string_view continued(std::string_view line) {
    joined_.clear();
    while (line.ends_with('\\')) {
      joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
      if (joined_.size() > FileBytes::window_limit) fail("a continued line without end; the file is damaged");
      if (!lines_.next(line)) return joined_;
    }
    joined_.append(line);
    return joined_;
  }

  void take_line(std::string_view line) {
    const std::string_view keyword = take_word(line);
    if (keyword == "v") return take_vertex(line);
    if (keyword == "f" || keyword == "fo") return take_face(line);
    if (looks_) looks_->take_line(keyword, line);
    if (keyword.empty() || keyword.front() == '#' || keyword == "vn" || keyword == "vt") return;
    if (keyword == "g") return take_names(group_, line);
    if (keyword == "o") {
      group_.clear();
      return take_names(object_, line);
    }
    if (keyword == "usemtl") return take_names(material_, line);
    if (keyword == "curv" || keyword == "surf" || keyword == "curv2") ++free_form_;
  }

  void take_vertex(std::string_view rest) {
    Vec3 v{0.0};
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = take_word(rest);
      if (word.empty()) fail("a vertex needs three coordinates");
      if (!parse(word, v[k])) fail(fmt::format("'{}' is no coordinate", shown(word)));
    }
    if (sink_.in_pieces()) {
      sink_.add_vertex(v);
    } else {
      vertices_.add(v);
    }
    if (looks_) looks_->take_vertex_colour(rest);
  }

  void take_names(std::string& name, std::string_view rest) {
    name = trimmed(rest);
    begun_ = false;
  }

  /// The index of the vertex of a corner such as 7, -1, 7/2, 7//3 or 7/2/3.
  std::uint64_t vertex_of(std::string_view corner) const {
    const std::string_view number = corner.substr(0, corner.find('/'));
    std::int64_t index = 0;
    if (!parse(number, index) || index == 0) fail(fmt::format("'{}' is no corner of a face", shown(corner)));
    const auto count = static_cast<std::int64_t>(sink_.in_pieces() ? sink_.vertex_count() : vertices_.size());
    if (index > count || index < -count) {
      fail(fmt::format("a face refers to vertex {}, but {} vertices come before it", index, count));
    }
    return static_cast<std::uint64_t>(index > 0 ? index - 1 : count + index);
  }

  std::uint32_t corner_of(std::string_view corner) {
    const std::uint64_t vertex = vertex_of(corner);
    if (sink_.in_pieces()) return sink_.use_vertex(static_cast<std::uint32_t>(vertex));
    // A vertex with different looks in two faces becomes two vertices.
    if (looks_) return sink_.add_shared_vertex(vertices_[vertex], looks_->of(vertex, corner));
    return vertices_.index_in_object(vertex, [this](const Vec3& v) { return sink_.add_vertex(v); });
  }

  void take_face(std::string_view rest) {
    if (!begun_) begin_object();
    corners_.clear();
    for (std::string_view word = take_word(rest); !word.empty() && word.front() != '#'; word = take_word(rest)) {
      corners_.push_back(corner_of(word));
    }
    if (corners_.size() < 3) {
      if (small_faces_++ == 0) first_small_face_ = number_;
      return;
    }
    for (std::size_t i = 2; i < corners_.size(); ++i) sink_.add_triangle(corners_[0], corners_[i - 1], corners_[i]);
  }

  void begin_object() {
    // A material names an object only if nothing else does.
    const bool named = !object_.empty() || !group_.empty();
    const std::array<std::string, 2> names{named ? object_ : material_, group_};
    if (sink_.begin_object(names, stem_)) vertices_.begin_object();
    begun_ = true;
  }

  void say_what_was_skipped() const {
    if (small_faces_ > 0) {
      sink_.report_note(fmt::format("{}: {}, the first in line {}.", bytes_.path(), skipped_faces_text(small_faces_),
                                    first_small_face_));
    }
    if (free_form_ > 0) {
      sink_.report_note(fmt::format("{}: {} free-form curves and surfaces were skipped; only polygons are read.",
                                    bytes_.path(), free_form_));
    }
  }

  MeshSink& sink_;
  FileBytes bytes_;
  Lines lines_;
  std::string stem_;
  std::string joined_;
  std::uint64_t number_ = 0;
  VertexPool vertices_;
  std::optional<ObjLooks> looks_;
  std::string object_, group_, material_;
  bool begun_ = false;
  std::vector<std::uint32_t> corners_;
  std::uint64_t small_faces_ = 0, first_small_face_ = 0, free_form_ = 0;
};

}  // namespace

void read_obj(const std::filesystem::path& path, MeshSink& sink) {
  ObjReader(path, sink).read();
  sink.count_file();
}

}  // namespace roam::reader
