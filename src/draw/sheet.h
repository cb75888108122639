#pragma once
/// \file
/// A drawing as plain values: the items of a sheet, from the bottom to the top. Pixels, y down.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "draw/geometry.h"
#include "draw/style.h"

namespace roam::draw {

/// Lines, or areas where `closed`.
struct Lines {
  std::string what;  ///< the meaning: "plan walls", "section way", "scale bar", ...
  std::vector<Polyline> lines;
  Style style{};
  bool closed = false;
  Rect clip{};  ///< only the part inside is visible; empty: everything
};

struct Disc {
  std::string what;
  Point centre{0.0};
  double radius = 0.0;
  Style style{};
  Rect clip{};
};

struct Text {
  std::string what;
  std::string text;
  Point at{0.0};  ///< left end of its baseline
  Font font{};
  Colour colour{};
  Rect box{};  ///< the covered rectangle
};

/// A part of a sheet that is to scale. Names of its items begin with its own.
struct SheetView {
  std::string name;
  Rect area;  ///< pixels
  Frame frame;
  std::optional<Turn> turn;  ///< of a plan
};

/// Lines that are coarser than usual, because they are many or memory is small.
struct CoarseLines {
  std::string what;
  double pixels = 0.0;       ///< that their ends were rounded to; 0: none are coarser
  double metres = 0.0;       ///< the same in the scene
  std::size_t left_out = 0;  ///< short segments
};

struct Sheet {
  double width = 0.0;
  double height = 0.0;
  std::vector<SheetView> views;
  std::vector<std::variant<Lines, Disc, Text>> items;
  CoarseLines coarsest;
  std::size_t runs_left_out = 0;  ///< parts of the way between teleports
};

}  // namespace roam::draw
