#include "draw/compose.h"

#include <fmt/format.h>

#include <cmath>

#include "draw/legend.h"
#include "draw/panel.h"

namespace roam::draw {
namespace {

constexpr double title_size = 40.0;
constexpr double heading_size = 28.0;
constexpr std::ptrdiff_t most_named_falls = 3;
constexpr double axes_width = 150.0;  ///< in the upper right corner

std::string heights_cut(const Contents& c) {
  const auto& cuts = c.levels.cuts;
  if (cuts.size() == 1) return fmt::format("cut at the height of the body's centre, z = {:.2f} m", cuts[0]);
  return fmt::format("cut at the height of the body's centre along the way, {} levels, z = {:.2f} to {:.2f} m",
                     cuts.size(), cuts.front(), cuts.back());
}

/// Composes from the top downward.
class Composer {
 public:
  Composer(const Contents& contents, const MeasureText& measure)
      : c_(contents), labels_(sheet_, measure), painter_(contents, sheet_, labels_) {
    sheet_.width = sheet_width;
  }

  Sheet compose() {
    title();
    axes();
    plan();
    if (!c_.frames.details.empty()) details();
    section();
    y_ = draw_legend(c_, sheet_, labels_, y_);
    sheet_.height = std::ceil(y_ + 0.6 * sheet_margin);
    return std::move(sheet_);
  }

 private:
  void text_lines(const std::string& what, const std::string& text, double size, bool bold, const Colour& colour) {
    for (const std::string& line : wrapped(text, content_width - axes_width, size, bold, labels_.measure())) {
      y_ += 1.25 * size;
      labels_.write(what, line, {sheet_margin, y_}, size, bold, colour);
    }
  }

  void title() {
    y_ = 0.5 * sheet_margin;
    text_lines("title", c_.title, title_size, true, ink);
    y_ += 8.0;
    const bool is_reached = !c_.report.interrupted && c_.report.result.outcome == Outcome::reached;
    text_lines("outcome", words::headline(c_.report), text_size, false,
               mark_colour(is_reached ? MarkKind::start : MarkKind::blocked));
    if (!is_reached) text_lines("why", words::explain(c_.report), text_size, false, mark_colour(MarkKind::blocked));
    y_ += 4.0;
    text_lines("facts", facts(), text_size, false, pale_ink);
  }

  [[nodiscard]] std::string facts() const {
    const words::EndedWalk& r = c_.report;
    const char* mode = r.mode == Mode::walk ? "on foot" : r.mode == Mode::fly ? "flying" : "as a ghost, through walls";
    std::string text = fmt::format("{}, radius {:g} m, height {:g} m", mode, r.settings.radius, r.settings.height);
    if (r.mode == Mode::fly && words::knows_clearance(r)) {
      text += fmt::format("  ·  its axis at least {:.3f} m from everything, certified", r.result.least_axis_clearance);
    }
    const auto falls = count_falls();
    if (falls > 1) text += fmt::format("  ·  fell {} times", falls);
    if (c_.survey.narrowest) text += "  ·  narrowest " + length_text(c_.survey.narrowest->width);
    return text;
  }

  /// A heading with its explanation on the left. `right` draws on the right, from the right end leftward.
  void heading(const std::string& what, const std::string& name, const std::string& explanation) {
    y_ += 58.0;
    const Rect box = labels_.write(what + " heading", name, {sheet_margin, y_}, heading_size, true, ink);
    labels_.write(what + " explanation", explanation, {box.upper.x + 22.0, y_}, small_size, false, pale_ink);
  }

  /// A scale bar of a round length that ends at the right border.
  void scale_bar(const std::string& what, double pixels_per_metre) {
    const double metres = round_length(260.0 / pixels_per_metre);
    const double right = sheet_width - sheet_margin, left = right - metres * pixels_per_metre;
    sheet_.items.emplace_back(Lines{.what = what + " bar",
                                    .lines = {{{left, y_ - 12.0}, {left, y_}, {right, y_}, {right, y_ - 12.0}}},
                                    .width = 2.5,
                                    .stroke = ink});
    labels_.write(what + " length", scale_text(metres), {0.5 * (left + right), y_ - 9.0}, small_size, false, ink,
                  Labels::Align::centre);
  }

  static std::string scale_text(double metres) {
    if (metres >= 1000.0) return fmt::format("{:g} km", metres * 1e-3);
    return metres >= 0.01 || metres == 0.0 ? fmt::format("{:g} m", metres) : fmt::format("{:g} mm", metres * 1e3);
  }

  void frame(const std::string& what, const Map& map) {
    sheet_.items.emplace_back(Lines{
        .what = what + " frame", .lines = {outline(map.panel())}, .width = 1.5, .stroke = frame_ink, .closed = true});
  }

  /// The directions of the scene's x and y on the sheet, whose y points down.
  void axes() {
    const Turn& turn = c_.frames.turn;
    const Point centre(sheet_width - sheet_margin - 0.45 * axes_width, sheet_margin + 50.0);
    constexpr double reach = 40.0;
    const std::array<std::pair<const char*, Point>, 2> directions{
        {{"x", {turn.cosine, turn.sine}}, {"y", {turn.sine, -turn.cosine}}}};
    for (const auto& [name, d] : directions) {
      const Point way(d.x, d.y), tip = centre + reach * way, side(-way.y, way.x);
      sheet_.items.emplace_back(
          Lines{.what = std::string("axis ") + name,
                .lines = {{centre, tip}, {tip - 9.0 * way + 5.0 * side, tip, tip - 9.0 * way - 5.0 * side}},
                .width = 2.2,
                .stroke = ink});
      const Point at = tip + 13.0 * way + Point(0.0, 6.0);
      labels_.write(std::string("axis name ") + name, name, at, small_size, false, ink, Labels::Align::centre);
    }
  }

  void plan() {
    y_ += 18.0;
    heading("plan", "Plan", heights_cut(c_));
    scale_bar("plan scale", c_.frames.plan.scale_x);
    y_ += 20.0;
    const Map map{c_.frames.plan, {sheet_margin, y_}};
    frame("plan", map);
    painter_.plan("plan ", map, c_.cuts.plans[0]);
    if (c_.frames.details.empty()) {
      painter_.label_marks("plan ", map, true, [&](std::size_t i) { return full_label(i); });
    } else {
      painter_.label_marks("plan ", map, true, [&](std::size_t i) { return lettered(i); });
    }
    y_ += map.frame.height();
  }

  [[nodiscard]] std::ptrdiff_t count_falls() const {
    return std::count_if(c_.marks.begin(), c_.marks.end(), [](const Mark& m) { return m.kind == MarkKind::fell; });
  }

  [[nodiscard]] std::vector<std::string> full_label(std::size_t i) const {
    const Mark& m = c_.marks[i];
    // A few falls are named; many are not.
    if (m.kind == MarkKind::fell && count_falls() > most_named_falls) return {};
    std::vector<std::string> lines{m.name};
    for (std::size_t from = 0; from < m.note.size();) {
      const std::size_t end = std::min(m.note.find('\n', from), m.note.size());
      lines.push_back(m.note.substr(from, end - from));
      from = end + 1;
    }
    return lines;
  }

  static std::string letter(std::size_t detail) { return {static_cast<char>('A' + detail)}; }

  /// At the mark that a detail is about: the detail's letter and the names of all marks in it. Nothing at the others.
  [[nodiscard]] std::vector<std::string> lettered(std::size_t i) const {
    for (std::size_t k = 0; k < c_.frames.details.size(); ++k) {
      const auto& marks = c_.frames.details[k].marks;
      if (marks[0] != i) continue;
      std::string text = letter(k);
      for (const std::size_t m : marks) text += (m == marks[0] ? "  " : ", ") + c_.marks[m].name;
      return {text};
    }
    const bool in_a_detail = std::any_of(c_.frames.details.begin(), c_.frames.details.end(), [&](const Detail& d) {
      return std::find(d.marks.begin(), d.marks.end(), i) != d.marks.end();
    });
    return in_a_detail ? std::vector<std::string>{} : full_label(i);
  }

  /// A letter on white in the upper left corner of a panel.
  void badge(const std::string& what, const std::string& text, const Point& corner) {
    const Rect ground{corner + Point(1.0), corner + Point(46.0)};
    sheet_.items.emplace_back(Lines{.what = "label ground", .lines = {outline(ground)}, .fill = paper, .closed = true});
    labels_.write(what, text, corner + Point(13.0, 34.0), heading_size, true, ink);
    labels_.block(ground);
  }

  void details() {
    y_ += 6.0;
    const auto& details = c_.frames.details;
    heading("details", "Details",
            "plan, cut at the height of the body's centre there, and section, heights not exaggerated");
    scale_bar("detail scale", details[0].plan.scale_x);
    y_ += 20.0;
    const double top = y_;
    double lowest = y_;
    const double step = details[0].plan.width() + 30.0;
    for (std::size_t k = 0; k < details.size(); ++k) {
      const double x = sheet_margin + static_cast<double>(k) * step;
      const std::string prefix = "detail " + letter(k) + " ";
      const Map plan{details[k].plan, {x, top}};
      frame(prefix + "plan", plan);
      painter_.plan(prefix + "plan ", plan, c_.cuts.plans[k + 1]);
      badge(prefix + "letter", letter(k), plan.corner);
      painter_.label_marks(prefix + "plan ", plan, true, [&](std::size_t i) { return full_label(i); });
      const Map section{details[k].section, {x, top + details[k].plan.height() + 10.0}};
      frame(prefix + "section", section);
      painter_.section(prefix + "section ", section);
      lowest = std::max(lowest, section.panel().upper.y);
    }
    y_ = lowest;
  }

  void section() {
    const Frame& f = c_.frames.section;
    std::string explanation = "unrolled along the way";
    explanation +=
        c_.frames.section_has_plan_scale ? ", lengths to the scale of the plan" : ", lengths to a scale of its own";
    explanation += c_.frames.exaggeration > 1.0
                       ? fmt::format(", heights exaggerated {:g} times", c_.frames.exaggeration)
                       : ", heights to the same scale";
    y_ += 10.0;
    heading("section", "Section", explanation);
    scale_bar("section scale", f.scale_x);
    y_ += 20.0;
    const Map map{f, {sheet_width - sheet_margin - f.width(), y_}};
    frame("section", map);
    height_axis(map);
    distance_axis(map);
    painter_.section("section ", map);
    painter_.label_marks("section ", map, false, [&](std::size_t i) {
      auto lines = c_.frames.details.empty() ? full_label(i) : lettered(i);
      if (!lines.empty()) lines.resize(1);
      return lines;
    });
    y_ += f.height() + 42.0;
  }

  /// Ticks at round heights, fewer if their numbers would touch.
  void height_axis(const Map& map) {
    const double step = round_length(64.0 / map.frame.scale_y * 1.9);
    const int digits = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    for (double k = std::ceil(map.frame.view.lower.y / step); k * step <= map.frame.view.upper.y; ++k) {
      const double z = k == 0.0 ? 0.0 : k * step;  // never "-0"
      const Point p = map({map.frame.view.lower.x, z});
      tick({p - Point(7.0, 0.0), p});
      sheet_.items.emplace_back(Lines{.what = "section grid",
                                      .lines = {{p, {map.panel().upper.x, p.y}}},
                                      .width = 0.8,
                                      .stroke = {0.90, 0.91, 0.93}});
      labels_.write("section height", fmt::format("{:.{}f} m", z, digits), p + Point(-12.0, 7.0), small_size, false,
                    pale_ink, Labels::Align::right);
    }
  }

  void distance_axis(const Map& map) {
    const double step = round_length(300.0 / map.frame.scale_x);
    const double bottom = map.panel().upper.y;
    for (double at = 0.0; at <= c_.way.length + 1e-9; at += step) {
      const Point p(map({at, 0.0}).x, bottom);
      tick({p, p + Point(0.0, 7.0)});
      labels_.write("section distance", scale_text(at), p + Point(0.0, 28.0), small_size, false, pale_ink,
                    Labels::Align::centre);
    }
  }

  void tick(const Polyline& line) {
    sheet_.items.emplace_back(Lines{.what = "tick", .lines = {line}, .width = 1.5, .stroke = pale_ink});
  }

  const Contents& c_;
  Sheet sheet_;
  Labels labels_;
  PanelPainter painter_;
  double y_ = 0.0;
};

}  // namespace

Sheet compose(const Contents& contents, const MeasureText& measure) { return Composer(contents, measure).compose(); }

}  // namespace roam::draw
