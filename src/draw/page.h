#pragma once
/// \file
/// The layout of a sheet, from the top downward: texts, headings with scale bars and axes, panels, legends.

#include <span>
#include <string>

#include "draw/labels.h"
#include "draw/panel.h"
#include "draw/sheet.h"

namespace roam::draw {

inline constexpr double sheet_width = 2000.0;  ///< pixels
inline constexpr double sheet_margin = 60.0;
inline constexpr double content_width = sheet_width - 2.0 * sheet_margin;

/// The line above a panel.
struct Heading {
  std::string name;
  std::string explanation;
  double scale = 0.0;          ///< pixels per metre, for a scale bar; 0: none
  const Turn* turn = nullptr;  ///< of a plan, for arrows along the scene's x and y; null: none
  Font font = heading_font;
};

/// An explained style.
struct LegendEntry {
  std::string text;
  Style style;
  double disc = 0.0;    ///< radius of a disc as a sample, pixels; 0: a line or an area
  bool always = false;  ///< also if nothing was drawn so
};

/// Fills a sheet from the top downward. Heights and widths are pixels.
class Page {
 public:
  explicit Page(double width = sheet_width) : labels_(sheet_), y_(0.5 * sheet_margin) { sheet_.width = width; }
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  /// Moves the lower end of the page's contents down.
  void down(double pixels) { y_ += pixels; }

  /// The first text. Its middle is left out if it is long: the scene may be thousands of files.
  void title(const std::string& text);
  /// A text over the whole width, in as many lines as it needs.
  void paragraph(const std::string& what, const std::string& text, const Font& font, const Colour& colour);
  /// Leaves room for a line of headings: with arrows if `axes`.
  void begin_headings(bool axes) { y_ += axes ? 96.0 : 58.0; }
  /// A heading on that line, from `left` to `right`. `what` begins the names of its items.
  void heading(const std::string& what, const Heading& heading, double left, double right);
  /// The only heading of its line, over the whole width.
  void heading(const std::string& what, const Heading& only) {
    begin_headings(only.turn != nullptr);
    heading(what, only, sheet_margin, sheet_.width - sheet_margin);
  }
  /// A panel below the headings, from `left` (pixels). The next one stands beside it, until below() is called.
  /// `turn`: of a plan.
  [[nodiscard]] Panel panel(const std::string& name, const Frame& frame, double left, const Turn* turn = nullptr);
  /// Moves below a panel.
  void below(const Panel& panel) { y_ = panel.area().upper.y; }
  /// Explains the styles of what was drawn since the last legend.
  void legend(std::span<const LegendEntry> entries);

  /// Call it once.
  [[nodiscard]] Sheet finish();

 private:
  /// Draws arrows along the scene's x and y around a point.
  void axes(const std::string& what, const Turn& turn, const Point& centre);

  Sheet sheet_;
  Labels labels_;
  double y_;
  std::size_t explained_ = 0;  ///< items of the sheet before the last legend
};

/// A round length: "2 km", "0.5 m", "20 mm".
[[nodiscard]] std::string scale_text(double metres);

}  // namespace roam::draw
