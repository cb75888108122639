#include "draw/dxf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace roam::draw {
namespace {

/// Pixels around a view in which its signs and its texts stand.
constexpr double sign_room = 14.0, text_room = 120.0;
/// Pixels per metre of a sheet without views.
constexpr double page_scale = 80.0;
/// Height of capital letters, as a share of the size of a font.
constexpr double capital = 0.72;

/// The nearest of the colours 1 to 9 and 30 of AutoCAD. Ink is 7, which is black on white and white on black.
int colour_number(const Colour& c) {
  struct Numbered {
    int number;
    double red, green, blue;
  };
  constexpr std::array<Numbered, 11> known{{{1, 0.85, 0.08, 0.1},
                                            {2, 0.92, 0.75, 0.05},
                                            {3, 0.1, 0.6, 0.25},
                                            {4, 0.1, 0.65, 0.65},
                                            {5, 0.1, 0.35, 0.8},
                                            {6, 0.55, 0.1, 0.5},
                                            {7, 0.1, 0.1, 0.12},
                                            {7, 1.0, 1.0, 1.0},
                                            {8, 0.42, 0.44, 0.48},
                                            {9, 0.75, 0.76, 0.78},
                                            {30, 0.93, 0.42, 0.1}}};
  const auto off = [&](const Numbered& n) {
    const double r = n.red - c.red, g = n.green - c.green, b = n.blue - c.blue;
    return r * r + g * g + b * b;
  };
  return std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) { return off(a) < off(b); })
      ->number;
}

/// "PLAN_WALLS" of "plan walls": release 12 knows no other letters.
std::string layer_name(const std::string& what) {
  std::string name;
  for (const char c : what) {
    const bool small = c >= 'a' && c <= 'z', plain = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    name += small ? static_cast<char>(c - 'a' + 'A') : plain ? c : '_';
  }
  return name.substr(0, 31);
}

/// Letters beyond ASCII as \U+XXXX; control characters as blanks. Percent signs beside each other begin a control code,
/// as %%c that of a diameter: each is written as the code of a percent sign, %%%.
std::string text_value(const std::string& utf8) {
  std::string text;
  for (std::size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<unsigned char>(utf8[i]);
    const std::size_t length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    const bool beside = (i > 0 && utf8[i - 1] == '%') || (i + 1 < utf8.size() && utf8[i + 1] == '%');
    if (first == '%' && beside) {
      text += "%%%";
    } else if (length == 1) {
      text += first < 0x20 ? ' ' : utf8[i];
    } else {
      unsigned code = first & (0xFFu >> (length + 1));
      for (std::size_t k = 1; k < length && i + k < utf8.size(); ++k) {
        code = code << 6 | (static_cast<unsigned char>(utf8[i + k]) & 0x3Fu);
      }
      text += code <= 0xFFFF ? fmt::format("\\U+{:04X}", code) : "?";
    }
    i += length;
  }
  return text;
}

/// A view and its place in the drawing.
struct Placed {
  const SheetView* view;
  bool in_scene = false;
  Point offset{0.0};

  [[nodiscard]] Point operator()(const Point& pixel) const {
    const Frame& f = view->frame;
    const Point p(f.view.lower.x + (pixel.x - view->area.lower.x) / f.scale_x,
                  f.view.upper.y - (pixel.y - view->area.lower.y) / f.scale_y);
    if (!in_scene) return p + offset;
    const Turn& t = *view->turn;
    return {t.cosine * p.x - t.sine * p.y + t.origin.x, t.sine * p.x + t.cosine * p.y + t.origin.y};
  }
  [[nodiscard]] double height_of(const Font& font) const { return capital * font.size / view->frame.scale_x; }
};

class Writer {
 public:
  explicit Writer(const Sheet& sheet) : sheet_(sheet) {
    if (sheet.views.empty()) placed_.push_back({&page_});
    place_views();
    for (const auto& item : sheet.items) std::visit([&](const auto& shape) { add(shape); }, item);
    for (const Placed& placed : placed_) {
      const double size = placed.height_of(heading_font);
      if (!placed.in_scene) {
        text("names", placed.view->name, placed(placed.view->area.lower) + Point(0.0, size), size, ink);
      }
    }
  }

  [[nodiscard]] std::string finish() const {
    std::string all = "999\nmade by roam\n0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$INSUNITS\n70\n6\n";
    const Rect box = box_.empty() ? Rect{Point(0.0), Point(0.0)} : box_;
    for (const auto& [name, p] : {std::pair{"$EXTMIN", box.lower}, {"$EXTMAX", box.upper}}) {
      all += fmt::format("9\n{}\n10\n{:.4f}\n20\n{:.4f}\n30\n0.0\n", name, p.x, p.y);
    }
    all +=
        "0\nENDSEC\n0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLTYPE\n70\n1\n0\nLTYPE\n2\nCONTINUOUS\n70\n0\n3\nSolid line\n"
        "72\n65\n73\n0\n40\n0.0\n0\nENDTAB\n";
    all += fmt::format("0\nTABLE\n2\nLAYER\n70\n{}\n", layers_.size());
    for (const auto& [name, colour] : layers_) {
      all += fmt::format("0\nLAYER\n2\n{}\n70\n0\n62\n{}\n6\nCONTINUOUS\n", name, colour);
    }
    all += "0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities_ + "0\nENDSEC\n0\nEOF\n";
    return all;
  }

 private:
  void place_views() {
    bool has_scene = false;
    for (const SheetView& view : sheet_.views) {
      placed_.push_back({&view, view.turn && !has_scene});
      has_scene = has_scene || view.turn;
    }
    Rect scene;
    for (const Placed& placed : placed_) {
      if (!placed.in_scene) continue;
      for (const Point& corner : placed.view->area.outline()) scene.include(placed(corner));
    }
    if (scene.empty()) scene.include({0.0, 0.0});
    const double gap = std::max(1.0, 0.05 * std::max(scene.width(), scene.height()));
    double top = scene.upper.y;
    for (Placed& placed : placed_) {
      if (placed.in_scene) continue;
      const Rect& shown = placed.view->frame.view;
      placed.offset = Point(scene.upper.x + gap, top) - Point(shown.lower.x, shown.upper.y);
      top -= shown.height() + gap;
    }
  }

  /// The view that an item belongs to; null: it is of the page.
  [[nodiscard]] const Placed* owner(const std::string& what, const Point& at, double room) const {
    if (sheet_.views.empty()) return &placed_.front();
    for (const char* of_page : {" heading", " explanation", " scale bar", " scale length", " axis name", " axis x",
                                " axis y", "label ground", " letter ground", "legend"}) {
      if (what.ends_with(of_page) || what == of_page) return nullptr;
    }
    const auto found = std::find_if(placed_.begin(), placed_.end(), [&](const Placed& placed) {
      return (what.starts_with(placed.view->name + " ") || what == "leader") &&
             placed.view->area.grown(room).contains(at);
    });
    return found == placed_.end() ? nullptr : &*found;
  }

  void begin(const char* type, const std::string& layer, const Colour& colour) {
    const std::string name = layer_name(layer);
    const int number = colour_number(colour), of_layer = layers_.try_emplace(name, number).first->second;
    entities_ += fmt::format("0\n{}\n8\n{}\n", type, name);
    if (number != of_layer) entities_ += fmt::format("62\n{}\n", number);
  }

  void point(const Point& p, int code = 10) {
    box_.include(p);
    entities_ += fmt::format("{}\n{:.4f}\n{}\n{:.4f}\n", code, p.x, code + 10, p.y);
  }

  void line(const std::string& layer, std::span<const Point> points, bool closed, const Colour& colour) {
    if (points.size() < 2) return;
    if (points.size() == 2) {
      begin("LINE", layer, colour);
      point(points[0]);
      point(points[1], 11);
      return;
    }
    begin("POLYLINE", layer, colour);
    entities_ += fmt::format("66\n1\n70\n{}\n10\n0.0\n20\n0.0\n30\n0.0\n", closed ? 1 : 0);
    for (const Point& p : points) {
      begin("VERTEX", layer, colour);
      point(p);
    }
    begin("SEQEND", layer, colour);
  }

  void text(const std::string& layer, const std::string& value, const Point& at, double height, const Colour& colour) {
    if (value.empty()) return;
    begin("TEXT", layer, colour);
    point(at);
    entities_ += fmt::format("40\n{:.4f}\n1\n{}\n", height, text_value(value));
  }

  /// Pieces of a line inside a rectangle, or the part of an area; an empty one takes all.
  static std::vector<Polyline> inside(Polyline line, bool closed, const Rect& clip_to) {
    if (clip_to.empty()) return {line};
    if (closed) {
      for (int axis = 0; axis < 2; ++axis) {
        keep_side(line, axis, clip_to.lower[axis], -1.0);
        keep_side(line, axis, clip_to.upper[axis], 1.0);
      }
      return {line};
    }
    std::vector<Polyline> pieces;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      Segment s{line[i], line[i + 1]};
      if (!clip(s, clip_to)) continue;
      if (!pieces.empty() && pieces.back().back() == s.a) {
        pieces.back().push_back(s.b);
      } else {
        pieces.push_back({s.a, s.b});
      }
    }
    return pieces;
  }

  void add(const Lines& shape) {
    const Colour& colour = shape.style.width > 0.0 || !shape.style.fill ? shape.style.stroke : *shape.style.fill;
    for (const Polyline& drawn : shape.lines) {
      if (drawn.empty()) continue;
      // A shape with a clip may lead out of its view and into it again.
      const Point at = shape.clip.empty() ? drawn.front() : shape.clip.center();
      const Placed* const placed = owner(shape.what, at, sign_room);
      if (placed == nullptr) continue;
      for (Polyline& piece : inside(drawn, shape.closed, shape.clip)) {
        for (Point& p : piece) p = (*placed)(p);
        line(shape.what, piece, shape.closed, colour);
      }
    }
  }

  static Point at(const Disc& disc, double angle) {
    return disc.centre + disc.radius * Point(std::cos(angle), std::sin(angle));
  }

  /// The visible parts of a circle: angles of pixels, from and to. The whole circle has one part, of two pi.
  static std::vector<std::pair<double, double>> seen(const Disc& disc) {
    constexpr double turn = 2.0 * std::numbers::pi;
    if (disc.clip.empty()) return {{0.0, turn}};
    std::vector<double> cuts;
    for (int axis = 0; axis < 2; ++axis) {
      for (const double side : {disc.clip.lower[axis], disc.clip.upper[axis]}) {
        const double cosine = (side - disc.centre[axis]) / disc.radius;
        if (!(std::abs(cosine) < 1.0)) continue;
        const double off = std::acos(cosine), middle = axis == 0 ? 0.0 : 0.25 * turn;
        for (const double cut : {middle - off, middle + off}) cuts.push_back(cut < 0.0 ? cut + turn : cut);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.push_back(cuts.empty() ? turn : cuts.front() + turn);
    if (cuts.size() == 1) cuts.insert(cuts.begin(), 0.0);
    std::vector<std::pair<double, double>> parts;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double angle = 0.5 * (cuts[i] + cuts[i + 1]);
      if (!disc.clip.contains(at(disc, angle))) continue;
      if (!parts.empty() && parts.back().second == cuts[i]) {
        parts.back().second = cuts[i + 1];
      } else {
        parts.emplace_back(cuts[i], cuts[i + 1]);
      }
    }
    return parts;
  }

  void add(const Disc& disc) {
    const Placed* const placed = owner(disc.what, disc.clip.empty() ? disc.centre : disc.clip.center(), sign_room);
    if (placed == nullptr) return;
    const Point centre = (*placed)(disc.centre);
    for (const auto& [from, to] : seen(disc)) {
      const bool whole = to - from >= 2.0 * std::numbers::pi;
      begin(whole ? "CIRCLE" : "ARC", disc.what,
            disc.style.width > 0.0 ? disc.style.stroke : disc.style.fill.value_or(ink));
      entities_ += fmt::format("10\n{:.4f}\n20\n{:.4f}\n40\n{:.4f}\n", centre.x, centre.y,
                               disc.radius / placed->view->frame.scale_x);
      if (whole) {
        box_.include(centre);
        continue;
      }
      // Pixels have y down: their angles run the other way.
      int code = 50;
      for (const double angle : {to, from}) {
        const Point end = (*placed)(at(disc, angle));
        box_.include(end);
        const double degrees = std::atan2(end.y - centre.y, end.x - centre.x) * 180.0 / std::numbers::pi;
        entities_ += fmt::format("{}\n{:.4f}\n", code++, degrees < 0.0 ? degrees + 360.0 : degrees);
      }
    }
  }

  void add(const Text& t) {
    const Placed* const placed = owner(t.what, t.at, text_room);
    if (placed != nullptr) text(t.what, t.text, (*placed)(t.at), placed->height_of(t.font), t.colour);
  }

  const Sheet& sheet_;
  /// Stands for the views if there are none.
  const SheetView page_{"",
                        {Point(0.0), {sheet_.width, sheet_.height}},
                        {{Point(0.0), Point(sheet_.width, sheet_.height) / page_scale}, page_scale, page_scale},
                        {}};
  std::vector<Placed> placed_;
  std::map<std::string, int> layers_;
  std::string entities_;
  Rect box_;
};

}  // namespace

std::string to_dxf(const Sheet& sheet) { return Writer(sheet).finish(); }

}  // namespace roam::draw
