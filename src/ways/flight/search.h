#pragma once
/// \file
/// Whether a sphere gets from one place in the air to another: searched in cubes from both ends.

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "ways/flight/cells.h"

namespace roam::ways {

/// How a search for one radius ended.
enum class Flight : std::uint8_t {
  found,      ///< a way: certified
  none,       ///< no way exists: certified by a search through every cube that is not known to be closed
  not_found,  ///< a search through cubes known to be free found no way
  unsure,     ///< some ways could neither be flown nor closed
  ended,      ///< `goes_on` returned false
};

/// Searches between two places. Prefers cubes near the goal and wide ways (A*: Hart, Nilsson and Raphael, 1968). Runs
/// from both ends in turn, until they meet or one end's reach is exhausted. So finding a way costs about the cubes
/// along it, and finding none costs the reach of the smaller side.
class FlySearch {
 public:
  /// Calls `goes_on` now and then with the number of cubes; false ends the search.
  FlySearch(const Survey& survey, const Measure& measure, double spacing, const Vec3& from, const Vec3& to,
            std::function<bool(std::uint64_t)> goes_on);

  /// Whether a sphere of `radius` gets through cubes that may hold its centre. Splits cubes along the ways that it
  /// finds, `most` times at most. `none` holds for all larger spheres too.
  Flight look(double radius, int most);
  /// The same through cubes that are known to be free. It overlooks passages narrower than these cubes.
  Flight search_free_cubes(double radius);
  /// The way of the last search that found one: places between which the sphere goes straight.
  [[nodiscard]] const std::vector<Vec3>& way() const { return way_; }

  /// The least radius for which `look` can return `none`. For smaller ones, cubes as large as the spacing reach through
  /// thin walls.
  [[nodiscard]] double least_closed() const;
  /// m: the side of cubes near surfaces that a sphere of `radius` may touch.
  [[nodiscard]] double side_for(double radius) const;
  /// The number of cubes so far.
  [[nodiscard]] std::uint64_t cubes() const { return cells_.size(); }
  /// The nearest pair of places that the last search reached from the start and from the goal. First grows both sides
  /// to about the same number of cubes. None if the sides are far apart.
  [[nodiscard]] std::optional<std::array<Vec3, 2>> nearest_approach();

 private:
  /// State of a cube in the search from one end.
  struct Visit {
    std::uint32_t search = 0;  ///< the number of the search that reached it
    bool done = false;
    CellId before = no_cell;
    float cost = 0.0F;
  };
  struct Open {
    double key = 0.0;
    std::uint64_t number = 0;  ///< order of discovery, among equal keys
    CellId cell = no_cell;
    /// Order of a heap whose first element is followed next.
    static bool later(const Open& a, const Open& b) { return a.key != b.key ? a.key > b.key : a.number > b.number; }
  };
  struct Side {
    Vec3 end{0.0}, goal{0.0};
    std::vector<Visit> visits;
    std::vector<Open> open;
    std::uint64_t done = 0;
  };

  bool begin(double radius, bool certain);
  /// Follows one more cube of a side. True: it met the other side.
  bool follow(Side& side, Side& other);
  Flight run();
  void reach(Side& side, CellId cell, CellId before, double cost);
  [[nodiscard]] bool reached(const Side& side, CellId cell) const;
  [[nodiscard]] bool is_fine(CellId cell) const;
  [[nodiscard]] bool may_hold(CellId cell);
  [[nodiscard]] double cost_of(CellId cell) const;
  [[nodiscard]] bool links(CellId a, CellId b) const;
  [[nodiscard]] bool goes(const Vec3& from, double free, const Vec3& to) const;
  [[nodiscard]] std::vector<CellId> met_cells() const;
  void set_way(const std::vector<CellId>& cells);
  bool split_unsure(const std::vector<CellId>& cells);

  const Survey& survey_;
  const Measure measure_;
  const double spacing_;
  FlyCells cells_;
  std::function<bool(std::uint64_t)> goes_on_;
  std::array<Side, 2> sides_;
  std::vector<Vec3> way_;
  double radius_ = 0.0, side_limit_ = 0.0;
  bool certain_ = false;
  std::uint32_t search_ = 0;
  std::uint64_t pushed_ = 0;
  CellId met_ = no_cell;  ///< the cube where the sides met
};

}  // namespace roam::ways
