#pragma once
/// \file
/// Texts on a sheet, without overlaps.

#include <string>
#include <vector>

#include "draw/sheet.h"

namespace roam::draw {

inline constexpr Colour paper{1.0, 1.0, 1.0, 1.0};
inline constexpr Colour ink{0.11, 0.13, 0.17, 1.0};
inline constexpr Colour pale_ink{0.36, 0.39, 0.45};
// Heights of letters, pixels.
inline constexpr double text_size = 23.0;
inline constexpr double label_size = 22.0;
inline constexpr double small_size = 20.0;

/// The text with every byte that is not printable UTF-8 replaced by "?": file and object names may contain any bytes.
[[nodiscard]] std::string with_question_marks(const std::string& text);

/// The printable text in lines no wider than `width`, broken at spaces, or inside words that are too long.
[[nodiscard]] std::vector<std::string> wrapped(const std::string& text, double width, double size, bool bold,
                                               const MeasureText& measure);

/// Writes texts on a sheet. Remembers the places of texts and of other things that must stay clear.
class Labels {
 public:
  Labels(Sheet& sheet, MeasureText measure) : sheet_(sheet), measure_(std::move(measure)) {}

  [[nodiscard]] Rect measured(const std::string& text, double size, bool bold) const {
    return measure_(with_question_marks(text), size, bold);
  }
  [[nodiscard]] const MeasureText& measure() const { return measure_; }

  enum class Align : std::uint8_t { left, centre, right };
  /// Writes a line with its baseline at `at`, without looking for a free place.
  Rect write(const std::string& what, const std::string& text, const Point& at, double size, bool bold,
             const Colour& colour, Align align = Align::left);

  /// Keeps placed texts away from a rectangle.
  void block(const Rect& r) { taken_.push_back(r); }
  /// Keeps placed texts off lines if there is room beside them; a greater `weight` does so more strictly.
  void avoid(const std::vector<Polyline>& lines, double weight);

  /// A label of a place: its lines, the first one bold.
  struct Label {
    std::string what;
    std::vector<std::string> lines;
    double size = 0.0;
    Colour colour{};
  };
  /// Writes a label as near to `anchor` as possible inside `panel`, without covering texts or blocked rectangles. It
  /// has a pale ground, and a thin line to the anchor if it is not beside it. If the panel is full, writes nothing and
  /// returns false.
  bool place(const Label& label, const Point& anchor, const Rect& panel);

 private:
  [[nodiscard]] bool is_free(const Rect& r) const;
  [[nodiscard]] double covered(const Rect& r) const;

  Sheet& sheet_;
  MeasureText measure_;
  std::vector<Rect> taken_;
  std::vector<std::pair<Point, double>> avoided_;
};

}  // namespace roam::draw
