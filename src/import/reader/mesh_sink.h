#pragma once
/// \file
/// The common output of all readers: turns objects upright, scales, checks and filters them, and sends them.

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

#include "import/archive_entry.h"
#include "import/reader/display/look.h"
#include "import/reader/display/part_pool.h"
#include "import/reader/frame_writer.h"
#include "import/reader/piece_cutter.h"
#include "import/reader/recent_vertices.h"
#include "roam/import.h"

namespace roam::reader {

/// The program's settings for reading; see ImportOptions.
struct ReadingSettings {
  std::optional<UpAxis> up;
  double metres_per_unit = 1.0;
  std::vector<std::string> ignore;
  std::optional<Georeference> frame;  ///< into which folders of tiles are moved
  std::uint64_t memory_limit = 0;
  std::string tile;        ///< the only part of a folder or tileset to read (ScenePart::tile); empty: all
  bool only_list = false;  ///< list the parts without reading them; of a file only check its format
};

class MeshSink {
 public:
  /// `parts`: destination of triangles with looks, for display; null for collision. `pieces`: destination of triangles
  /// in pieces. At most one of the two is not null.
  MeshSink(FrameWriter& frames, const ReadingSettings& settings, PartPool* parts, PieceCutter* pieces);

  /// Null unless looks are requested.
  [[nodiscard]] PartPool* parts() const { return parts_; }
  /// Whether objects are sent in pieces.
  [[nodiscard]] bool in_pieces() const { return pieces_ != nullptr; }

  /// Sets the up axis that the format defines. The user's choice takes precedence.
  void set_format_up(UpAxis up);
  /// Adds a note if the file states an up axis or a unit (metres) other than the one in use. Unset: the file states
  /// none.
  void compare_with_stated(std::optional<UpAxis> up, std::optional<double> metres_per_unit, std::string_view file);
  /// Added to every vertex of the file before turning and scaling, in units of the file.
  void set_offset(const Vec3& offset) { offset_ = offset; }

  /// Begins an object. `names` are those of the object and its ancestors, outermost first; empty ones do not count. The
  /// object has the innermost name that is not empty, else `fallback`. Ignore patterns match any of `names`, or
  /// `fallback` if all are empty. If the names equal those of the current object, continues it and returns false.
  bool begin_object(std::span<const std::string> names, std::string_view fallback);

  /// Sets the look of the triangles that follow. Ignored, like the looks of vertices, unless looks are requested.
  void set_look(const Look& look);
  /// Adds a vertex to the current object, in the frame and unit of the file. Returns its index in this object.
  std::uint32_t add_vertex(const Vec3& vertex, const VertexLook& look = {});
  /// The same, but returns the earlier index if a vertex with these very bits was added shortly before.
  std::uint32_t add_shared_vertex(const Vec3& vertex, const VertexLook& look = {});
  /// Adds a triangle of the current object. A triangle with a bad vertex, or with an index that add_vertex did not
  /// return, is left out and counted.
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  /// Adds a polygon, fanned from its first corner. Its vertices cannot be referenced later. Vertices added shortly
  /// before are shared.
  void add_polygon(std::span<const Vec3> corners);
  /// For objects in pieces: vertices added from now on belong to the file, and every object may use them. Only those
  /// named by use_vertex count for an object.
  void share_vertices() { vertices_are_shared_ = true; }
  /// Marks a vertex as used by the current object. Returns `index`.
  std::uint32_t use_vertex(std::uint32_t index);
  /// Records a coordinate that the reader rounded to float. end() adds a note if the loss is large.
  void note_rounded(double coordinate) {
    // A NaN changes nothing; vertices are checked elsewhere.
    const double size = coordinate < 0.0 ? -coordinate : coordinate;
    if (size > largest_rounded_) largest_rounded_ = size;
  }
  /// The number of vertices of the current object, or of the file so far if they are shared.
  [[nodiscard]] std::uint32_t vertex_count() const { return vertex_count_; }
  /// Whether the current object is ignored, so that its vertices need not be added.
  [[nodiscard]] bool ignored() const { return ignored_; }

  void count_file() { ++totals_.files; }
  void report_tile(std::string_view root, bool present) {
    frames_.send(
        FrameKind::tile,
        PayloadWriter().add_text(root).add(static_cast<std::uint8_t>(present)).add_text("").add(ArchiveEntry()));
  }
  /// Reports a file of a tileset's part. `entry`: all zero unless it is in an archive.
  void report_part(std::string_view file, std::string_view part, const ArchiveEntry& entry) {
    frames_.send(FrameKind::tile, PayloadWriter().add_text(file).add(std::uint8_t{1}).add_text(part).add(entry));
  }
  /// Reports a file for a list.
  void report_missing_page(std::string_view file);
  void report_note(std::string_view sentence);
  /// The same, but reports each sentence only once.
  void report_note_once(std::string_view sentence);
  void report_georeference(const Georeference& georeference);
  /// Sets the bytes of the files read in all, and sends them from time to time.
  void report_progress(std::uint64_t bytes_read);
  /// The same for readers of many files: adds `bytes`.
  void report_more_progress(std::uint64_t bytes) { report_progress(bytes_read_ + bytes); }

  /// Closes the current object and sends its parts, because the next file has other images. Nothing without parts.
  void send_parts();
  /// The frame of the file in that of the scene: its origin, and the images of the unit vectors along its axes.
  [[nodiscard]] std::array<Vec3, 4> placement() const;
  [[nodiscard]] const Vec3& offset() const { return offset_; }
  /// Sets the group of the page (PartPool::begin_page) for the triangles that follow.
  void set_group(std::uint32_t group);
  /// Whether these names are ignored, and so all objects below.
  [[nodiscard]] bool ignores(std::span<const std::string> names) { return matches_ignore(names); }

  /// Closes the current object and sends the totals. The last call.
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
  bool announced_ = false;  ///< its frame is sent, which happens with its first content
  bool ignored_ = false;
  std::uint32_t vertex_count_ = 0;
  std::uint64_t bad_triangles_ = 0, ignored_triangles_ = 0;
  std::vector<std::uint32_t> bad_;              ///< indices of bad vertices, ascending; these vertices are not sent
  std::unordered_set<std::uint32_t> bad_used_;  ///< if vertices are shared, those of bad_ that the current object uses
  std::vector<std::uint32_t> corners_;          ///< of a polygon
  std::vector<Vec3> vertices_;
  std::vector<VertexLook> looks_;  ///< of vertices_, if there are parts
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  Look look_;

  RecentVertices recent_;
  std::uint32_t object_number_ = 0;
};

}  // namespace roam::reader
