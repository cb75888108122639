#pragma once
/// \file
/// Floors with holes: convex pieces in the plan, minus convex pieces.

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "walker_scenes.h"

namespace floors {

using roam::Mesh;
using roam::Vec3;

/// Convex, counter-clockwise seen from above; z is ignored.
using Piece = std::vector<Vec3>;

inline double side(const Vec3& a, const Vec3& b, const Vec3& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// The part of a piece to the left (sign 1) or right (-1) of the line from a to b.
inline Piece half(const Piece& piece, const Vec3& a, const Vec3& b, double sign) {
  Piece part;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec3& p = piece[i];
    const Vec3& q = piece[(i + 1) % piece.size()];
    const double at_p = sign * side(a, b, p), at_q = sign * side(a, b, q);
    if (at_p >= 0.0) part.push_back(p);
    if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0)) part.push_back(p + (at_p / (at_p - at_q)) * (q - p));
  }
  return part;
}

inline double area(const Piece& piece) {
  double sum = 0.0;
  for (std::size_t i = 2; i < piece.size(); ++i) sum += 0.5 * side(piece[0], piece[i - 1], piece[i]);
  return sum;
}

/// An axis-aligned rectangle.
inline Piece rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0, 0.0}, {x1, y0, 0.0}, {x1, y1, 0.0}, {x0, y1, 0.0}};
}

/// A straight strip through a place, `width` wide and far longer than any scene. `turn`: angle of its direction from
/// +y, in degrees counter-clockwise.
inline Piece strip(double x, double y, double width, double turn) {
  const double a = turn * std::numbers::pi / 180.0, half_width = 0.5 * width, half_length = 20.0;
  const Vec3 across(std::cos(a), std::sin(a), 0.0), along(-std::sin(a), std::cos(a), 0.0), at(x, y, 0.0);
  return {at - half_width * across - half_length * along, at + half_width * across - half_length * along,
          at + half_width * across + half_length * along, at - half_width * across + half_length * along};
}

/// A regular polygon about a circle.
inline Piece round(double x, double y, double radius, int sides) {
  Piece piece;
  const double out = radius / std::cos(std::numbers::pi / sides);
  for (int i = 0; i < sides; ++i) {
    const double a = (2.0 * i + 1.0) * std::numbers::pi / sides;
    piece.emplace_back(x + out * std::cos(a), y + out * std::sin(a), 0.0);
  }
  return piece;
}

/// A floor over a rectangle in cells of about `cell`.
class Floor {
 public:
  Floor(double x0, double y0, double x1, double y1, double cell = 0.7) {
    const int nx = int(std::ceil((x1 - x0) / cell)), ny = int(std::ceil((y1 - y0) / cell));
    const auto at = [](double a, double b, int i, int n) { return a + (b - a) * i / n; };
    for (int i = 0; i < nx; ++i) {
      for (int j = 0; j < ny; ++j)
        pieces_.push_back(
            rectangle(at(x0, x1, i, nx), at(y0, y1, j, ny), at(x0, x1, i + 1, nx), at(y0, y1, j + 1, ny)));
    }
  }

  Floor& without(const Piece& hole) {
    std::vector<Piece> left;
    for (Piece rest : pieces_) {
      for (std::size_t i = 0; i < hole.size(); ++i) {
        const Vec3& a = hole[i];
        const Vec3& b = hole[(i + 1) % hole.size()];
        keep(left, half(rest, a, b, -1.0));
        rest = half(rest, a, b, 1.0);
      }
    }
    pieces_ = std::move(left);
    return *this;
  }

  /// Adds the floor to `mesh`, at the heights that `height` returns.
  void add_to(Mesh& mesh, const std::function<double(double, double)>& height) const {
    const auto lifted = [&](const Vec3& p) { return Vec3(p.x, p.y, height(p.x, p.y)); };
    for (const Piece& p : pieces_) {
      for (std::size_t i = 2; i < p.size(); ++i)
        scenes::add_triangle(mesh, lifted(p[0]), lifted(p[i - 1]), lifted(p[i]));
    }
  }
  void add_to(Mesh& mesh, double height) const {
    add_to(mesh, [&](double, double) { return height; });
  }

 private:
  static void keep(std::vector<Piece>& pieces, const Piece& piece) {
    constexpr double nothing = 1e-12;  // m^2: the remains of rounding along a cut
    if (area(piece) > nothing) pieces.push_back(piece);
  }

  std::vector<Piece> pieces_;
};

}  // namespace floors
