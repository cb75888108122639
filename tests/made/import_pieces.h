#pragma once
// A scene imported in pieces, compared with the same scene imported at once.

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "import_files.h"

namespace roam::test {

/// The reassembled input of a sink.
struct Pieces {
  std::vector<std::string> names;   ///< of each object
  std::vector<std::size_t> counts;  ///< triangles of each object
  std::vector<Triangle> triangles;
  std::uint64_t vertices = 0;

  [[nodiscard]] PieceSink sink() {
    return [this](const Mesh& piece, bool continues) { take(piece, continues); };
  }

 private:
  void take(const Mesh& piece, bool continues) {
    ASSERT_GT(piece.triangles.size(), 0u);
    ASSERT_LE(piece.triangles.size(), piece_triangles);
    if (continues) {
      ASSERT_FALSE(names.empty());
      EXPECT_EQ(piece.name, names.back());
    } else {
      names.push_back(piece.name);
      counts.push_back(0);
    }
    counts.back() += piece.triangles.size();
    vertices += piece.vertices.size();
    std::vector<bool> used(piece.vertices.size());
    for (std::size_t i = 0; i < piece.triangles.size(); ++i) {
      for (const std::uint32_t corner : piece.triangles[i]) used.at(corner) = true;
      triangles.push_back(piece.triangle(i));
    }
    for (const bool vertex : used) EXPECT_TRUE(vertex) << "a vertex that no triangle uses";
  }
};

/// Without the vertices: the pieces have more.
inline void expect_same_report(const ImportReport& a, const ImportReport& b) {
  EXPECT_EQ(a.files, b.files);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.bad_vertices, b.bad_vertices);
  EXPECT_EQ(a.bad_triangles, b.bad_triangles);
  EXPECT_EQ(a.ignored_triangles, b.ignored_triangles);
  EXPECT_EQ(a.missing_pages, b.missing_pages);
  EXPECT_EQ(a.missing_page_files, b.missing_page_files);
  EXPECT_EQ(a.notes, b.notes);
  for (const auto list : {&ImportReport::bad_objects, &ImportReport::ignored_objects}) {
    ASSERT_EQ((a.*list).size(), (b.*list).size());
    for (std::size_t i = 0; i < (a.*list).size(); ++i) {
      EXPECT_EQ((a.*list)[i].name, (b.*list)[i].name);
      EXPECT_EQ((a.*list)[i].vertices, (b.*list)[i].vertices);
      EXPECT_EQ((a.*list)[i].triangles, (b.*list)[i].triangles);
    }
  }
  ASSERT_EQ(a.georeference.has_value(), b.georeference.has_value());
  if (a.georeference) {
    EXPECT_EQ(a.georeference->srs, b.georeference->srs);
    EXPECT_EQ(a.georeference->origin, b.georeference->origin);
  }
}

inline bool same_bits(const std::vector<Triangle>& a, const std::vector<Triangle>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Triangle)) == 0);
}

/// Expects that the pieces of these paths add up to the result of import_scene. Returns their number of vertices.
inline std::uint64_t expect_streams_as_imported(const std::vector<std::filesystem::path>& paths,
                                                const ImportOptions& options = {}) {
  const ImportedScene scene = import_scene(paths, options);
  Pieces pieces;
  const ImportReport report = stream_scene(paths, options, pieces.sink());
  expect_same_report(report, scene.report);
  EXPECT_EQ(report.vertices, pieces.vertices);
  EXPECT_TRUE(same_bits(pieces.triangles, triangles_of(scene)));
  EXPECT_EQ(pieces.names.size(), scene.meshes.size());
  for (std::size_t i = 0; i < std::min(pieces.names.size(), scene.meshes.size()); ++i) {
    EXPECT_EQ(pieces.names[i], scene.meshes[i].name);
    EXPECT_EQ(pieces.counts[i], scene.meshes[i].triangles.size());
  }
  return pieces.vertices;
}

}  // namespace roam::test
