#pragma once
/// \file
/// A drawing as plain values: the items of a sheet, from the bottom to the top. Pixels, y down.

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "draw/geometry.h"

namespace roam::draw {

struct Colour {
  double red = 0.0, green = 0.0, blue = 0.0, alpha = 1.0;
};

/// Lines, or areas where `closed`.
struct Lines {
  std::string what;  ///< the meaning: "walls", "way", "scale bar", ...
  std::vector<Polyline> lines;
  double width = 0.0;  ///< of the stroke; 0: none
  Colour stroke{};
  std::optional<Colour> fill{};
  bool closed = false;
  std::vector<double> dash{};
  Rect clip{};  ///< only the part inside is visible; empty: everything
};

struct Disc {
  std::string what;
  Point centre{0.0};
  double radius = 0.0;
  double width = 0.0;
  Colour stroke{};
  std::optional<Colour> fill{};
  Rect clip{};
};

struct Text {
  std::string what;
  std::string text;
  Point at{0.0};  ///< left end of its baseline
  double size = 0.0;
  bool bold = false;
  Colour colour{};
  Rect box{};  ///< the covered rectangle
};

struct Sheet {
  double width = 0.0;
  double height = 0.0;
  std::vector<std::variant<Lines, Disc, Text>> items;
};

/// The rectangle covered by a text whose baseline begins at (0, 0). All lines of one size are equally high.
using MeasureText = std::function<Rect(const std::string& text, double size, bool bold)>;

}  // namespace roam::draw
