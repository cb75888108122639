#include "generate/surface.h"

#include <algorithm>

#include "roam/generate.h"

namespace roam::generate {
namespace {

/// Sets `kept` to 1 for each cell of row `row` that is in no hole, else to 0. Returns whether all are kept. Rows
/// outside [row0, row1) keep none.
bool kept_cells(const Grid& grid, int row, int row0, int row1, std::vector<char>& kept) {
  if (row < row0 || row >= row1) {
    kept.assign(static_cast<std::size_t>(grid.cols), 0);
    return false;
  }
  kept.assign(static_cast<std::size_t>(grid.cols), 1);
  bool all = true;
  for (const Hole& h : grid.holes) {
    if (row < h.row0 || row >= h.row1) continue;
    std::fill(kept.begin() + h.col0, kept.begin() + h.col1, char{0});
    all = false;
  }
  return all;
}

std::uint64_t triangles(const Grid& grid, int row0, int row1) {
  std::int64_t cells = static_cast<std::int64_t>(row1 - row0) * grid.cols;
  for (const Hole& h : grid.holes) {
    const int rows = std::min(row1, h.row1) - std::max(row0, h.row0);
    if (rows > 0) cells -= static_cast<std::int64_t>(rows) * (h.col1 - h.col0);
  }
  return 2u * static_cast<std::uint64_t>(cells);
}

std::uint64_t vertices(const Grid& grid, int row0, int row1) {
  std::int64_t n = static_cast<std::int64_t>(row1 - row0 + 1) * grid.vertex_cols();
  for (const Hole& h : grid.holes) {
    const int a = std::max(row0, h.row0), b = std::min(row1, h.row1);
    if (a >= b) continue;
    // A vertex disappears with all its cells: inside the hole, and on the rim of the grid where the hole reaches it.
    const int rows = b - a - 1 + (a == row0) + (b == row1);
    const int cols = h.col1 - h.col0 - 1 + (!grid.closed && h.col0 == 0) + (!grid.closed && h.col1 == grid.cols);
    n -= static_cast<std::int64_t>(rows) * cols;
  }
  return static_cast<std::uint64_t>(n);
}

void emit_grid(const Grid& grid, int row0, int row1, Mesh& mesh) {
  const int n = grid.vertex_cols();
  constexpr std::uint32_t none = 0xffffffffu;
  std::vector<Vec3> points(static_cast<std::size_t>(n));
  std::vector<std::uint32_t> below(static_cast<std::size_t>(n), none), here(below);
  std::vector<char> kept_below, kept_here;
  bool all_below = kept_cells(grid, row0 - 1, row0, row1, kept_below);
  for (int row = row0; row <= row1; ++row) {
    const bool all_here = kept_cells(grid, row, row0, row1, kept_here);
    grid.points(row, points);
    const bool all_used = all_here || all_below;
    for (int c = 0; c < n; ++c) {
      const auto k = static_cast<std::size_t>(c);
      bool used = all_used;
      if (!used) {
        const std::size_t right = static_cast<std::size_t>(c == grid.cols ? c - 1 : c);
        const std::size_t left = static_cast<std::size_t>(c > 0 ? c - 1 : (grid.closed ? grid.cols - 1 : 0));
        used = kept_below[left] || kept_below[right] || kept_here[left] || kept_here[right];
      }
      here[k] = used ? static_cast<std::uint32_t>(mesh.vertices.size()) : none;
      if (used) mesh.vertices.push_back(points[k]);
    }
    if (row > row0) {
      for (int c = 0; c < grid.cols; ++c) {
        if (!all_below && !kept_below[static_cast<std::size_t>(c)]) continue;
        const auto k = static_cast<std::size_t>(c),
                   next = static_cast<std::size_t>(c + 1 == n ? (grid.closed ? 0 : c + 1) : c + 1);
        std::array<std::uint32_t, 4> q{below[k], here[k], here[next], below[next]};
        if (grid.flipped) std::swap(q[1], q[3]);
        // Alternate the diagonals, so that the mesh has no preferred direction.
        if ((row + c) & 1) {
          mesh.triangles.push_back({q[0], q[1], q[2]});
          mesh.triangles.push_back({q[0], q[2], q[3]});
        } else {
          mesh.triangles.push_back({q[1], q[2], q[3]});
          mesh.triangles.push_back({q[1], q[3], q[0]});
        }
      }
    }
    std::swap(below, here);
    std::swap(kept_below, kept_here);
    all_below = all_here;
  }
}

void emit_fan(const Fan& fan, Mesh& mesh) {
  std::vector<Vec3> rim(static_cast<std::size_t>(fan.corners));
  fan.points(rim);
  const auto center = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(fan.center);
  mesh.vertices.insert(mesh.vertices.end(), rim.begin(), rim.end());
  const auto n = static_cast<std::uint32_t>(fan.corners);
  for (std::uint32_t k = 0; k < n; ++k) {
    std::uint32_t a = center + 1 + k, b = center + 1 + (k + 1) % n;
    if (fan.flipped) std::swap(a, b);
    mesh.triangles.push_back({center, a, b});
  }
}

}  // namespace

std::vector<std::vector<Slice>> slice(const Part& part) {
  std::vector<std::vector<Slice>> meshes(1);
  std::uint64_t filled = 0;
  const auto add = [&](Slice s, std::uint64_t n) {
    if (n == 0) return;
    if (filled + n > piece_triangles && !meshes.back().empty()) {
      meshes.emplace_back();
      filled = 0;
    }
    meshes.back().push_back(s);
    filled += n;
  };
  for (std::size_t g = 0; g < part.grids.size(); ++g) {
    const Grid& grid = part.grids[g];
    const std::uint64_t all = triangles(grid, 0, grid.rows);
    const auto bands = static_cast<int>((all + piece_triangles - 1) / piece_triangles);
    if (bands <= 1) {
      add({static_cast<int>(g), 0, grid.rows}, all);
      continue;
    }
    const int height = std::max(1, static_cast<int>(piece_triangles) / (2 * grid.cols));
    for (int row = 0; row < grid.rows; row += height) {
      const int end = std::min(grid.rows, row + height);
      add({static_cast<int>(g), row, end}, triangles(grid, row, end));
    }
  }
  std::uint64_t corners = 0;
  for (const Fan& f : part.fans) corners += static_cast<std::uint64_t>(f.corners);
  add({-1, 0, 0}, corners);
  return meshes;
}

Count count(const Part& part, const std::vector<Slice>& slices) {
  Count c;
  for (const Slice& s : slices) {
    if (s.grid >= 0) {
      const Grid& grid = part.grids[static_cast<std::size_t>(s.grid)];
      c.triangles += triangles(grid, s.row0, s.row1);
      c.vertices += vertices(grid, s.row0, s.row1);
      continue;
    }
    for (const Fan& f : part.fans) {
      c.triangles += static_cast<std::uint64_t>(f.corners);
      c.vertices += static_cast<std::uint64_t>(f.corners) + 1;
    }
  }
  return c;
}

void emit(const Part& part, const std::vector<Slice>& slices, Mesh& mesh) {
  const Count c = count(part, slices);
  mesh.vertices.reserve(mesh.vertices.size() + c.vertices);
  mesh.triangles.reserve(mesh.triangles.size() + c.triangles);
  for (const Slice& s : slices) {
    if (s.grid >= 0) {
      emit_grid(part.grids[static_cast<std::size_t>(s.grid)], s.row0, s.row1, mesh);
    } else {
      for (const Fan& f : part.fans) emit_fan(f, mesh);
    }
  }
}

int loop_size(const Hole& hole) { return 2 * (hole.row1 - hole.row0 + hole.col1 - hole.col0); }

std::vector<Vec3> loop(const Grid& grid, const Hole& hole) {
  const int h = hole.row1 - hole.row0, w = hole.col1 - hole.col0;
  std::vector<Vec3> around(static_cast<std::size_t>(loop_size(hole)));
  std::vector<Vec3> row(static_cast<std::size_t>(grid.vertex_cols()));
  const auto at = [&](int k) -> Vec3& { return around[static_cast<std::size_t>(k)]; };
  for (int i = 0; i <= h; ++i) {
    grid.points(hole.row0 + i, row);
    const auto point = [&](int col) { return row[static_cast<std::size_t>(col % grid.vertex_cols())]; };
    if (i == 0) {
      for (int j = 0; j <= w; ++j) at(j) = point(hole.col0 + j);
    } else if (i == h) {
      for (int j = 0; j <= w; ++j) at(w + h + (w - j)) = point(hole.col0 + j);
    } else {
      at(w + i) = point(hole.col1);
      at(2 * w + h + (h - i)) = point(hole.col0);
    }
  }
  return around;
}

namespace {

/// The loop of a hole, computed at its first use. Only one thread uses a part.
auto lazy_loop(const Grid& grid, const Hole& hole) {
  return [grid, hole, points = std::make_shared<std::vector<Vec3>>()]() -> const std::vector<Vec3>& {
    if (points->empty()) *points = loop(grid, hole);
    return *points;
  };
}

}  // namespace

void add_pocket(Part& part, const Grid& grid, const Hole& hole, const Vec3& depth, int layers) {
  Grid sides{.rows = layers, .cols = loop_size(hole), .closed = true, .flipped = grid.flipped};
  sides.points = [rim = lazy_loop(grid, hole), depth, layers](int row, std::span<Vec3> out) {
    const Vec3 d = depth * (static_cast<double>(row) / layers);
    const std::vector<Vec3>& border = rim();
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = border[k] + d;
  };
  Grid bottom{.rows = hole.row1 - hole.row0, .cols = hole.col1 - hole.col0, .flipped = grid.flipped};
  bottom.points = [grid, hole, depth](int row, std::span<Vec3> out) {
    std::vector<Vec3> all(static_cast<std::size_t>(grid.vertex_cols()));
    grid.points(hole.row0 + row, all);
    for (std::size_t k = 0; k < out.size(); ++k) {
      out[k] = all[(k + static_cast<std::size_t>(hole.col0)) % all.size()] + depth;
    }
  };
  part.grids.push_back(std::move(sides));
  part.grids.push_back(std::move(bottom));
}

void add_passage(Part& part, const Grid& from, const Hole& hole, const Grid& to, const Hole& end, int layers) {
  Grid sides{.rows = layers, .cols = loop_size(hole), .closed = true, .flipped = from.flipped};
  sides.points = [a = lazy_loop(from, hole), b = lazy_loop(to, end), layers](int row, std::span<Vec3> out) {
    const double t = static_cast<double>(row) / layers;
    const std::vector<Vec3>&p = a(), &q = b();
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = row == layers ? q[k] : p[k] + (q[k] - p[k]) * t;
  };
  part.grids.push_back(std::move(sides));
}

}  // namespace roam::generate
