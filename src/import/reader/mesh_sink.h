#pragma once
/// \file
/// Where every format's reader puts its objects: turned upright, scaled, checked, filtered by name and sent.

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "import/reader/display/look.h"
#include "import/reader/display/part_pool.h"
#include "import/reader/frame_writer.h"
#include "import/reader/piece_cutter.h"
#include "roam/import.h"

namespace roam::reader {

/// What the program asked for; see ImportOptions.
struct ReadingSettings {
  std::optional<UpAxis> up;
  double metres_per_unit = 1.0;
  std::vector<std::string> ignore;
  std::optional<Georeference> frame;  ///< into which folders of tiles are placed
  std::uint64_t memory_limit = 0;
  std::string tile;        ///< of a folder, the only one that is read; empty: all
  bool only_list = false;  ///< the tiles of a folder are told, not read; of a file only its format is looked at
};

class MeshSink {
 public:
  /// `parts`: where triangles go with their looks when they are to be seen; null when they are to be walked on.
  /// `pieces`: where they go when they are wanted in pieces. At most one of the two.
  MeshSink(FrameWriter& frames, const ReadingSettings& settings, PartPool* parts, PieceCutter* pieces);

  /// Null when nobody asks how surfaces look.
  [[nodiscard]] PartPool* parts() const { return parts_; }
  /// Whether objects are sent in pieces.
  [[nodiscard]] bool in_pieces() const { return pieces_ != nullptr; }

  /// The up axis of a format whose own definition says one; the user's choice goes before it.
  void set_format_up(UpAxis up);
  /// Says in a note that the file states an up axis or a length of its unit (metres) that it is not read by; what it
  /// does not state is unset.
  void compare_with_stated(std::optional<UpAxis> up, std::optional<double> metres_per_unit, std::string_view file);
  /// Added to every vertex of the file before it is turned and scaled, in units of the file.
  void set_offset(const Vec3& offset) { offset_ = offset; }

  /// Begins an object. `names` are the object's own name and its ancestors', outermost first; empty ones do not count.
  /// It is called after the innermost that is not empty, else `fallback`; patterns of objects to ignore match any of
  /// `names`, or `fallback` where all of them are empty. Where the names are those of the current object, that one
  /// goes on and the answer is false.
  bool begin_object(std::span<const std::string> names, std::string_view fallback);

  /// How the triangles that follow look. Where nobody asks it is not looked at, and so are the looks of vertices.
  void set_look(const Look& look);
  /// Adds a vertex of the current object, in the frame and unit of the file; returns its index in this object.
  std::uint32_t add_vertex(const Vec3& vertex, const VertexLook& look = {});
  /// The same, but returns an earlier index when these very bits were seen shortly before.
  std::uint32_t add_shared_vertex(const Vec3& vertex, const VertexLook& look = {});
  /// Adds a triangle of vertices of the current object. One that has a bad vertex, or an index that add_vertex did not
  /// return, is left out and counted.
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  /// Adds a polygon, fanned from its first corner, whose vertices nothing refers to later by their indices; those that
  /// were seen shortly before are shared.
  void add_polygon(std::span<const Vec3> corners);
  /// Where objects are sent in pieces: vertices that are added from now on belong to the file, and every object may
  /// use them. They count for an object once use_vertex has named them.
  void share_vertices() { vertices_are_shared_ = true; }
  /// Says that the current object has a corner there; returns `index`.
  std::uint32_t use_vertex(std::uint32_t index);
  /// Tells a coordinate that the reader kept as a float though the file may say more; end() notes what that costs.
  void note_rounded(double coordinate) {
    // Written so that a NaN changes nothing; vertices are checked elsewhere.
    const double size = coordinate < 0.0 ? -coordinate : coordinate;
    if (size > largest_rounded_) largest_rounded_ = size;
  }
  /// How many vertices the current object has, or, where they are shared, the file so far.
  [[nodiscard]] std::uint32_t vertex_count() const { return vertex_count_; }
  /// Whether the current object is left out by name, so that its vertices need not be added.
  [[nodiscard]] bool ignored() const { return ignored_; }

  void count_file() { ++totals_.files; }
  void report_tile(std::string_view root, bool present) {
    frames_.send(FrameKind::tile, PayloadWriter().add_text(root).add(static_cast<std::uint8_t>(present)));
  }
  /// A file that is to be listed.
  void report_file(std::string_view file) { frames_.send(FrameKind::file, PayloadWriter().add_text(file)); }
  void report_missing_page(std::string_view file);
  void report_note(std::string_view sentence);
  /// The same sentence, said once however often it is found.
  void report_note_once(std::string_view sentence);
  void report_georeference(const Georeference& georeference);
  /// Tells how many bytes of the files are read in all; sends it now and then.
  void report_progress(std::uint64_t bytes_read);
  /// Adds to the bytes that are read, for readers of many files.
  void report_more_progress(std::uint64_t bytes) { report_progress(bytes_read_ + bytes); }

  /// Closes the current object and sends what is to be seen: what follows has other images. Nothing where nobody asks.
  void send_parts();
  /// Where the frame of the file lies in that of the scene: its zero, and the unit vectors along its axes.
  [[nodiscard]] std::array<Vec3, 4> placement() const;
  [[nodiscard]] const Vec3& offset() const { return offset_; }
  /// The group of the page (PartPool::begin_page) into which the triangles go that follow.
  void set_group(std::uint32_t group);
  /// Whether objects below nodes of these names are left out by name.
  [[nodiscard]] bool ignores(std::span<const std::string> names) { return matches_ignore(names); }

  /// The last words: closes the current object and sends the totals.
  void end();

 private:
  [[nodiscard]] Vec3 turned(const Vec3& v) const;
  [[nodiscard]] Vec3 placed(const Vec3& vertex) const;
  bool matches_ignore(std::span<const std::string> names);
  bool count_vertex(const Vec3& vertex, Vec3& place);
  [[nodiscard]] bool is_bad(std::uint32_t index) const;
  void finish_object();
  void say_what_was_rounded();
  void send_vertices();
  void send_triangles();
  void send_left_out(LeftOutReason reason, std::uint64_t vertices, std::uint64_t triangles);

  FrameWriter& frames_;
  const ReadingSettings& settings_;
  PartPool* parts_;
  PieceCutter* pieces_;
  bool vertices_are_shared_ = false;
  UpAxis up_;
  Vec3 offset_{0.0};
  Totals totals_;
  std::vector<std::uint8_t> matched_;
  std::set<std::string, std::less<>> said_;
  std::uint64_t bytes_read_ = 0;
  double largest_rounded_ = 0.0;  ///< in units of the file
  std::chrono::steady_clock::time_point progress_sent_{};

  // The current object.
  std::vector<std::string> names_;
  std::string name_;
  bool begun_ = false;
  bool announced_ = false;  ///< its frame is sent; not before it has something to say
  bool ignored_ = false;
  std::uint32_t vertex_count_ = 0;
  std::uint64_t bad_triangles_ = 0, ignored_triangles_ = 0;
  std::vector<std::uint32_t> bad_;              ///< indices of bad vertices, ascending; they are not sent
  std::unordered_set<std::uint32_t> bad_used_;  ///< of bad_, where vertices are shared: those of the current object
  std::vector<std::uint32_t> corners_;          ///< of a polygon
  std::vector<Vec3> vertices_;
  std::vector<VertexLook> looks_;  ///< of vertices_, where there are parts
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  Look look_;

  /// One remembered vertex for each hash of its bits.
  struct Remembered {
    Vec3 vertex{0.0};
    VertexLook look;
    std::uint32_t index = 0;
    std::uint32_t object = 0;
  };
  Remembered& memory_of(const Vec3& vertex);
  [[nodiscard]] bool holds(const Remembered& memory, const Vec3& vertex, const VertexLook& look) const;
  std::vector<Remembered> remembered_;
  std::uint32_t object_number_ = 0;
};

}  // namespace roam::reader
