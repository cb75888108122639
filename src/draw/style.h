#pragma once
/// \file
/// Colours, pens, areas and letters: every sheet takes them from here. Sizes are pixels of the sheet.

#include <array>
#include <optional>

namespace roam::draw {

struct Colour {
  double red = 0.0, green = 0.0, blue = 0.0, alpha = 1.0;

  bool operator==(const Colour&) const = default;
  [[nodiscard]] constexpr Colour at(double opacity) const { return {red, green, blue, opacity}; }
};

struct Font {
  double size = 0.0;  ///< height of the letters
  bool bold = false;
};

/// How a line, an area or a disc looks.
struct Style {
  double width = 0.0;  ///< of the stroke; 0: none
  Colour stroke{};
  std::optional<Colour> fill{};
  double keep_off = 0.0;         ///< how strictly labels stay off its lines, if there is room beside them
  std::array<double, 4> dash{};  ///< lengths of strokes and gaps; all 0: solid

  bool operator==(const Style&) const = default;
};

/// An area without an edge.
[[nodiscard]] constexpr Style area_style(const Colour& colour) { return {0.0, {}, colour}; }

inline constexpr Colour paper{1.0, 1.0, 1.0}, ink{0.11, 0.13, 0.17}, pale_ink{0.36, 0.39, 0.45};
inline constexpr Colour blue{0.10, 0.38, 0.72}, green{0.08, 0.47, 0.25}, orange{0.75, 0.38, 0.05};
inline constexpr Colour red{0.78, 0.06, 0.10}, purple{0.55, 0.10, 0.50};

inline constexpr Font title_font{40.0, true}, heading_font{29.0, true};
inline constexpr Font text_font{23.0, false}, caption_font{23.0, true};
inline constexpr double label_size = 22.0, measure_size = 25.0;  ///< of labels, whose first line is bold
inline constexpr Font small_font{20.0, false}, small_bold_font{20.0, true};

// The scene.
inline constexpr Style wall_style{2.2, {0.13, 0.15, 0.20}, {}, 0.5};
inline constexpr Style below_style{1.4, {0.66, 0.70, 0.76}, {}, 0.5};
inline constexpr Style above_style{1.4, pale_ink, {}, 0.5, {10.0, 7.0}};
inline constexpr Style floor_style{0.8, {0.93, 0.92, 0.86}, Colour{0.93, 0.92, 0.86}};
inline constexpr Style face_style{0.8, {0.85, 0.87, 0.90}, Colour{0.85, 0.87, 0.90}};

// The body and its way.
inline constexpr Style body_style{1.8, blue, blue.at(0.16), 1.0};
inline constexpr Style misfit_style{2.0, red, red.at(0.16), 1.0};
inline constexpr Style disc_style{2.0, green, {}, 1.0};
inline constexpr Style disc_line_style{5.0, green};
inline constexpr Style band_style = area_style(blue.at(0.16));
inline constexpr Style way_style{4.0, blue, {}, 3.0};
inline constexpr Style ghost_style{4.0, {0.45, 0.25, 0.65}, {}, 3.0};
inline constexpr Style touch_style{1.0, paper, Colour{0.86, 0.10, 0.32}};
inline constexpr Style from_start_style = area_style({0.10, 0.55, 0.30, 0.22});
inline constexpr Style from_target_style = area_style({0.90, 0.50, 0.05, 0.28});
/// The way by the room beside the body, from tight to wide.
inline constexpr std::array<Style, 5> gap_styles{{{4.0, {0.70, 0.05, 0.15}, {}, 3.0},
                                                  {4.0, {0.93, 0.42, 0.10}, {}, 3.0},
                                                  {4.0, {0.92, 0.70, 0.05}, {}, 3.0},
                                                  {4.0, {0.15, 0.62, 0.45}, {}, 3.0},
                                                  {4.0, {0.10, 0.38, 0.72}, {}, 3.0}}};

// Signs.
inline constexpr Style measure_style{2.8, purple, {}, 6.0};
inline constexpr Style drawn_out_style{1.4, purple};
inline constexpr Style section_line_style{1.4, pale_ink, {}, 1.0, {14.0, 5.0, 3.0, 5.0}};
inline constexpr Style frame_style{1.5, {0.78, 0.80, 0.84}};
inline constexpr Style grid_style{0.8, {0.90, 0.91, 0.93}};
inline constexpr Style tick_style{1.5, pale_ink};
inline constexpr Style scale_style{2.5, ink};
inline constexpr Style ground_style = area_style(paper.at(0.82));  ///< behind a label

}  // namespace roam::draw
