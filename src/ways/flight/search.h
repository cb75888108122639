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
  found,     ///< a way: certified
  none,      ///< there is no way: certified, by a search that trusts nothing but what it knows to be closed
  not_seen,  ///< a search that trusts only what it knows to be free found none
  unsure,    ///< ways are left that could be neither flown nor closed
  ended,     ///< by `goes_on`
};

/// The searches between two places. The nearer to the goal, and the wider a way is, the earlier it is followed (A*:
/// Hart, Nilsson and Raphael, 1968), from both ends in turn until they meet or all that is in reach of one is known: so
/// a yes costs about what lies along the way, and a no what lies around the end with less around it.
class FlySearch {
 public:
  /// `goes_on` is asked now and then with the number of cubes; false ends the search.
  FlySearch(const Survey& survey, const Measure& measure, double spacing, const Vec3& from, const Vec3& to,
            std::function<bool(std::uint64_t)> goes_on);

  /// Whether a sphere of `radius` gets through cubes that may hold its centre, split along the ways that are met `most`
  /// times at most. none: nobody of this radius or a larger one does.
  Flight look(double radius, int most);
  /// The same through cubes that are known to be free: what is narrower than they are is overlooked.
  Flight look_where_free(double radius);
  /// Of the last search that found one: through places that the sphere goes straight between.
  [[nodiscard]] const std::vector<Vec3>& way() const { return way_; }

  /// The least radius of which `look` can say that there is no way: cubes as large as the spacing reach through thin
  /// walls for smaller ones.
  [[nodiscard]] double least_closed() const;
  /// m: the side that cubes are split to for a radius, near what it may touch.
  [[nodiscard]] double side_for(double radius) const;
  /// Cubes that were looked at.
  [[nodiscard]] std::uint64_t places() const { return cells_.size(); }
  /// Where what the last search reached from the start comes nearest to what it reached from the goal: both are grown
  /// to about the same number of cubes first. None where they are far apart.
  [[nodiscard]] std::optional<std::array<Vec3, 2>> nearest_approach();

 private:
  /// What is known of a cube in the search from one of the ends.
  struct Visit {
    std::uint32_t search = 0;  ///< the number of the search that reached it
    bool done = false;
    CellId before = no_cell;
    float cost = 0.0F;
  };
  struct Open {
    double key = 0.0;
    std::uint64_t number = 0;  ///< of equals the first that was found
    CellId cell = no_cell;
    /// Of a heap whose first is followed next.
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
  CellId met_ = no_cell;  ///< where the sides meet
};

}  // namespace roam::ways
