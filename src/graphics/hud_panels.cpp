#include "graphics/hud_panels.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace roam::graphics {
namespace {

// Over the darkest and the lightest picture the panel is so dark that the contrast of its text is above 7 : 1. That is
// the strictest level of the Web Content Accessibility Guidelines.
const osg::Vec4 panel_color(0.04f, 0.05f, 0.065f, 0.87f);
const osg::Vec4 text_color(1.0f, 1.0f, 1.0f, 1.0f);
const osg::Vec4 label_color(0.72f, 0.79f, 0.86f, 1.0f);
const osg::Vec4 warning_color(1.0f, 0.83f, 0.40f, 1.0f);
const osg::Vec4 accent_color(0.52f, 0.80f, 1.0f, 1.0f);
const osg::Vec4 recording_color(0.95f, 0.20f, 0.22f, 1.0f);
const osg::Vec4 groove_color(0.96f, 0.97f, 0.98f, 0.18f);
const osg::Vec4 rim_color(0.0f, 0.0f, 0.0f, 0.55f);

const osg::Vec4& color_of(Tone tone) { return tone == Tone::warning ? warning_color : text_color; }

osg::ref_ptr<osg::Geometry> plate(osg::StateSet* plates, const Rectangle& where, float radius, const osg::Vec4& color) {
  osg::ref_ptr<osg::Geometry> made = make_plate(where, radius, color);
  made->setStateSet(plates);
  return made;
}

/// A note with its remedy takes two or three lines, a reason with a place up to five.
constexpr std::size_t most_value_lines = 5;

float top_of_button(const Page& page) { return page.margin + page.line + std::round(0.6f * page.margin); }

float up_to(float value, float step) { return std::ceil(value / step) * step; }

/// Lines of like lengths: no last line of one word.
std::vector<std::string> break_evenly(const std::string& text, const Look& look, float width) {
  std::vector<std::string> lines = break_lines(text, look, width);
  for (float share = 0.95f; lines.size() > 1 && share > 0.4f; share -= 0.05f) {
    std::vector<std::string> narrower = break_lines(text, look, share * width);
    if (narrower.size() > lines.size()) break;
    lines = std::move(narrower);
  }
  return lines;
}

}  // namespace

Page Page::of(float width, float height) {
  // 12 pixels at 640 x 360, 15 at 1280 x 720, 20 at 1920 x 1080, 33 at 3840 x 2160: a constant share of a large window,
  // and a little more of a small one. A narrow window counts as one of 16 : 9.
  const float effective = std::min(height, width * 9.0f / 16.0f);
  Page page;
  page.width = width;
  page.height = height;
  page.right = width;
  page.letter = std::max(9, static_cast<int>(std::lround(6.0f + 0.0125f * effective)));
  page.letter = std::max(page.letter, effective >= 350.0f ? 12 : 9);
  page.margin = static_cast<float>(page.letter);
  page.line = std::round(1.45f * static_cast<float>(page.letter));
  constexpr int small_letter = 12;
  page.small = page.letter <= small_letter;
  return page;
}

void StatusPanel::lay_out(const Page& page, const std::vector<StatusLine>& lines) {
  std::vector<std::string> labels;
  labels.reserve(lines.size());
  for (const StatusLine& line : lines) labels.push_back(line.label);
  const bool rebuilt = page != page_ || labels != labels_;
  if (rebuilt) {
    page_ = page;
    labels_ = labels;
    width_ = 0;
    rebuild(lines);
  }
  if (rows_.empty()) {
    place_ = {};
    return;
  }
  for (std::size_t i = 0; i < lines.size(); ++i) break_value(i, lines[i].value);
  const std::vector<std::size_t> counts = share_lines();
  bool moved = rebuilt;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    Row& row = rows_[i];
    const std::size_t count = counts[i];
    moved = moved || count != row.lines;
    if (count != row.lines) row.shown = first_lines(i, count);
    row.lines = count;
    row.value->set(row.shown, color_of(lines[i].tone));
  }
  if (moved) place_rows();
  float widest = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) widest = std::max(widest, left_of(i) + rows_[i].value->width());
  // The width changes in steps and shrinks late, because a panel that follows each digit is restless.
  const float step = 3.0f * static_cast<float>(page.letter);
  const float wished = std::min(up_to(widest - page.margin, step), page.right - 2.8f * page.margin);
  const bool resized = wished > width_ || wished + 2 * step < width_;
  if (moved || resized) place_plate(resized ? wished : width_);
}

float StatusPanel::width_for(std::size_t row) const {
  // Less than half of the picture; more in small windows, where half would be a word a line.
  const float right = std::max(0.45f * page_.right, std::min(0.9f * page_.right, 30.0f * page_.margin));
  return right - (labels_[row].empty() ? 1.8f * page_.margin : value_left_);
}

float StatusPanel::left_of(std::size_t row) const {
  return labels_[row].empty() ? std::round(1.8f * page_.margin) : value_left_;
}

void StatusPanel::break_value(std::size_t row, const std::string& words) {
  Row& r = rows_[row];
  // Most rows are unchanged. Measuring them in every frame would take longer than drawing them.
  if (!r.broken.empty() && r.words == words) return;
  const Look look{page_.letter, false, text_color};
  r.words = words;
  r.broken = {words};
  const bool fits = words.find('\n') == std::string::npos && width_of(words, look) <= width_for(row);
  if (!fits) r.broken = break_lines(words, look, width_for(row));
  if (r.lines > 0) r.shown = first_lines(row, std::min(r.lines, r.broken.size()));
}

std::vector<std::size_t> StatusPanel::share_lines() const {
  // The message below stays free.
  const auto room = static_cast<std::size_t>(std::max(0.0f, 0.66f * page_.height - 2.0f * page_.margin) / page_.line);
  std::vector<std::size_t> counts(rows_.size(), 1);
  std::size_t left = room - std::min(room, rows_.size());
  for (std::size_t i = rows_.size(); i-- > 0;) {
    const std::size_t more = std::min({rows_[i].broken.size() - 1, most_value_lines - 1, left});
    counts[i] += more;
    left -= more;
  }
  return counts;
}

std::string StatusPanel::first_lines(std::size_t row, std::size_t count) const {
  const Look look{page_.letter, false, text_color};
  const std::vector<std::string>& broken = rows_[row].broken;
  std::string text;
  for (std::size_t k = 0; k < count; ++k) {
    std::string line = broken[k];
    // This makes the line too long, so that it ends with "…".
    if (k + 1 == count && count < broken.size()) line.append(1, ' ').append(broken[count]);
    if (k > 0) text += '\n';
    // A line without blanks is one long name.
    text += (line.find(' ') == std::string::npos ? shorten_name : shorten)(line, look, width_for(row));
  }
  return text;
}

void StatusPanel::rebuild(const std::vector<StatusLine>& lines) {
  group_->removeChildren(0, group_->getNumChildren());
  rows_.clear();
  plate_ = nullptr;
  if (lines.empty()) return;
  plate_ = plate(plates_.get(), {}, 0, panel_color);
  group_->addChild(plate_);

  const Look label_look{page_.letter, false, label_color};
  float widest = 0;
  for (const StatusLine& line : lines) widest = std::max(widest, width_of(line.label, label_look));
  value_left_ = std::round(1.8f * page_.margin + (widest > 0 ? widest + page_.margin : 0));
  for (const StatusLine& line : lines) {
    Row row;
    row.label = make_text(line.label, label_look, 0, 0);
    row.value = make_text({}, {page_.letter, false, color_of(line.tone), page_.line}, 0, 0);
    group_->addChild(row.label);
    group_->addChild(row.value);
    rows_.push_back(row);
  }
}

void StatusPanel::place_rows() {
  lines_ = 0;
  float y = std::round(page_.height - 1.55f * page_.margin - static_cast<float>(page_.letter));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i].label->set_place(std::round(1.8f * page_.margin), y);
    rows_[i].value->set_place(left_of(i), y);
    y -= page_.line * static_cast<float>(rows_[i].lines);
    lines_ += rows_[i].lines;
  }
}

void StatusPanel::place_plate(float width) {
  width_ = width;
  const float height = page_.line * static_cast<float>(lines_) + 0.8f * page_.margin;
  place_ = {page_.margin, page_.height - page_.margin - height, width + 0.8f * page_.margin, height};
  move_plate(*plate_, place_, 0.5f * page_.margin);
}

Placed make_message(const Page& page, const std::string& text, Tone tone, std::optional<double> progress, float limit,
                    osg::StateSet* plates) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  const Look look{static_cast<int>(std::lround(1.15f * static_cast<float>(page.letter))), false, color_of(tone)};
  const float line_height = std::round(1.45f * static_cast<float>(look.size));
  const float pad = page.margin;
  const float bar = std::max(3.0f, std::round(0.3f * page.margin));

  std::vector<std::string> lines = break_evenly(text, look, 0.78f * page.right);
  const float bar_height = progress ? bar + (lines.empty() ? 0.0f : 0.5f * pad) : 0.0f;
  // Above the button, and never over the middle of the picture.
  const float bottom = std::round(std::max(0.07f * page.height, top_of_button(page) + 0.5f * page.margin));
  const float room = std::min(0.3f * page.height, limit - bottom - bar_height - pad);
  if (room < line_height) return {};
  const auto most = static_cast<std::size_t>(room / line_height);
  // Whole sentences, as many as there is room for; of one that is too long the beginning.
  for (std::string rest = text; lines.size() > most && rest.find('\n') != std::string::npos;) {
    rest.resize(rest.rfind('\n'));
    lines = break_evenly(rest, look, 0.78f * page.right);
  }
  if (lines.size() > most) {
    for (std::size_t i = most; i < lines.size(); ++i) lines[most - 1].append(1, ' ').append(lines[i]);
    lines.resize(most);
  }
  float widest = progress ? 16.0f * page.margin : 0.0f;
  for (std::string& line : lines) {
    line = (line.find(' ') == std::string::npos ? shorten_name : shorten)(line, look, 0.9f * page.right);
    widest = std::max(widest, width_of(line, look));
  }
  const float text_height = line_height * static_cast<float>(lines.size());
  Rectangle panel;
  panel.width = std::round(widest + 2 * pad);
  panel.height = std::round(text_height + bar_height + pad);
  panel.x = std::round(0.5f * (page.right - panel.width));
  panel.y = bottom;
  group->addChild(plate(plates, panel, 0.5f * pad, panel_color));
  if (tone == Tone::warning) {
    group->addChild(plate(plates, {panel.x, panel.y, bar, panel.height}, 0.5f * bar, warning_color));
  }

  float y = panel.y + panel.height - 0.5f * pad - std::round(1.08f * static_cast<float>(look.size));
  for (const std::string& line : lines) {
    const float x = std::round(0.5f * (page.right - width_of(line, look)));
    group->addChild(make_text(line, look, x, std::round(y)));
    y -= line_height;
  }
  if (progress) {
    const float share = static_cast<float>(std::clamp(*progress, 0.0, 1.0));
    Rectangle groove{panel.x + pad, panel.y + std::round(0.5f * pad), panel.width - 2 * pad, bar};
    group->addChild(plate(plates, groove, bar, groove_color));
    groove.width *= share;
    if (groove.width >= 1) group->addChild(plate(plates, groove, bar, accent_color));
  }
  return {group, panel};
}

namespace {

/// A hint's lines. It is broken where its parts meet, which several blanks divide, and within a part if need be. As
/// many lines as `most`; a name without blanks that is too long loses its middle, so that the end that one types stays.
std::vector<std::string> break_hint(const std::string& text, const Look& look, float width, std::size_t most) {
  constexpr std::string_view between = "     ";
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(between, begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    begin = end + between.size();
    const std::string longer = lines.empty() ? part : lines.back() + std::string(between) + part;
    if (width_of(longer, look) <= width) {
      (lines.empty() ? lines.emplace_back() : lines.back()) = longer;
    } else {
      for (std::string& line : break_evenly(part, look, width)) lines.push_back(std::move(line));
    }
  }
  if (lines.size() > most) {
    for (std::size_t i = most; i < lines.size(); ++i) lines[most - 1].append(1, ' ').append(lines[i]);
    lines.resize(most);
  }
  for (std::string& line : lines) {
    line = (line.find(' ') == std::string::npos ? shorten_name : shorten)(line, look, width);
  }
  return lines;
}

}  // namespace

Placed make_hint(const Page& page, const std::string& text, double opacity, std::initializer_list<Rectangle> others,
                 osg::StateSet* plates) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  const auto faded = [&](osg::Vec4 color) {
    color.a() *= static_cast<float>(std::clamp(opacity, 0.0, 1.0));
    return color;
  };
  const Look look{static_cast<int>(std::lround(1.15f * static_cast<float>(page.letter))), false, faded(text_color)};
  const float line = std::round(1.45f * static_cast<float>(look.size));
  // Below a plan a long hint has the whole width, but it stays in the middle of the picture.
  const bool goes_below = page.below > 0.5f * page.height && width_of(text, look) > page.right - 4 * page.margin;
  const float right = goes_below ? page.width : page.right;
  const auto most = static_cast<std::size_t>(std::max(1.0f, 0.2f * page.height / line));
  const std::vector<std::string> lines = break_hint(text, look, right - 4 * page.margin, most);
  float width = 0;
  for (const std::string& words : lines) width = std::max(width, width_of(words, look));
  Rectangle panel;
  panel.width = std::round(width + 2 * page.margin);
  panel.height = std::round(line * static_cast<float>(lines.size()) + page.margin);
  panel.x = std::round(0.5f * (right - panel.width));
  panel.y = std::round(0.56f * page.height);
  if (goes_below) panel.y = std::min(panel.y, page.below - panel.height);
  const float gap = std::round(0.4f * page.margin);
  float top = 0.44f * page.height;
  for (std::size_t pass = 0; pass < others.size(); ++pass) {
    for (const Rectangle& other : others) {
      if (!overlap({panel.x, panel.y - gap, panel.width, panel.height + gap}, other)) continue;
      top = std::min(top, other.y - gap);
      panel.y = std::round(top - panel.height);
    }
  }
  group->addChild(plate(plates, panel, 0.5f * page.margin, faded(panel_color)));
  float y = panel.y + panel.height - 0.5f * page.margin - std::round(1.08f * static_cast<float>(look.size));
  for (const std::string& words : lines) {
    const float x = panel.x + std::max(page.margin, 0.5f * (panel.width - width_of(words, look)));
    group->addChild(make_text(words, look, std::round(x), std::round(y)));
    y -= line;
  }
  return {group, panel};
}

Placed make_recording(const Page& page, const std::string& text, osg::StateSet* plates) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  const Look look{page.letter, false, text_color};
  const float dot = std::round(0.75f * static_cast<float>(page.letter)), pad = page.margin;
  // The width changes in steps, because a panel that follows each digit is restless.
  const float width = up_to(width_of(text, look), 3.0f * static_cast<float>(page.letter));
  Rectangle panel;
  panel.width = std::round(width + dot + 2.5f * pad);
  panel.height = page.line + std::round(0.8f * pad);
  panel.x = std::round(page.width - page.margin - panel.width);
  panel.y = std::round(page.height - page.margin - panel.height);
  group->addChild(plate(plates, panel, 0.5f * pad, panel_color));
  const Rectangle mark{panel.x + pad, std::round(panel.y + 0.5f * (panel.height - dot)), dot, dot};
  group->addChild(plate(plates, mark, 0.5f * dot, recording_color));
  const float base = std::round(panel.y + 0.5f * panel.height - 0.36f * static_cast<float>(look.size));
  group->addChild(make_text(text, look, std::round(mark.x + dot + 0.5f * pad), base));
  return {group, panel};
}

Clickable make_button(const Page& page, const std::string& text, osg::StateSet* plates) {
  const Look look{page.letter, false, label_color};
  const float pad = std::round(0.6f * page.margin);
  const Rectangle panel{page.margin, page.margin, std::round(width_of(text, look) + 2 * pad),
                        top_of_button(page) - page.margin};
  osg::ref_ptr<osg::Group> group = new osg::Group;
  group->addChild(plate(plates, panel, 0.5f * pad, panel_color));
  const float base = std::round(panel.y + 0.5f * panel.height - 0.36f * static_cast<float>(look.size));
  group->addChild(make_text(text, look, panel.x + pad, base));
  return {group, {{panel, text}}, panel};
}

bool leaves_room(const Rectangle& plan, const Page& page) {
  constexpr float beside = 0.6f, below = 0.4f;  // of the picture
  return plan.x >= beside * page.width && plan.y >= below * page.height;
}

osg::ref_ptr<osg::Node> make_labels(const Page& page, const std::vector<HudLabel>& labels,
                                    const std::vector<Rectangle>& above, osg::StateSet* plates) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  const Look look{page.letter, true, text_color};
  std::vector<Rectangle> placed;
  for (const HudLabel& label : labels) {
    const float pad = std::round(0.4f * page.margin), width = width_of(label.text, look);
    const auto covers_point = [&](const Rectangle& r) {
      return label.x >= r.x && label.x <= r.x + r.width && label.y >= r.y && label.y <= r.y + r.height;
    };
    if (std::any_of(above.begin(), above.end(), covers_point)) continue;
    const Rectangle over{std::round(label.x - 0.5f * width - pad), std::round(label.y + pad), width + 2 * pad,
                         page.line};
    Rectangle panel = over;
    const auto is_free = [&](const Rectangle& at) {
      const auto overlaps = [&](const Rectangle& other) { return overlap(at, other); };
      return std::none_of(placed.begin(), placed.end(), overlaps) && std::none_of(above.begin(), above.end(), overlaps);
    };
    // Above its point, below it, on its right or left; else above all labels that it would hide: each is passed once.
    const Rectangle ways[] = {over,
                              {over.x, std::round(label.y - pad) - over.height, over.width, over.height},
                              {std::round(label.x + pad), over.y - pad, over.width, over.height},
                              {std::round(label.x - pad) - over.width, over.y - pad, over.width, over.height}};
    if (const auto found = std::find_if(std::begin(ways), std::end(ways), is_free); found != std::end(ways)) {
      panel = *found;
    } else {
      for (std::size_t i = 0; i < placed.size(); ++i) {
        const auto hidden =
            std::find_if(placed.begin(), placed.end(), [&](const Rectangle& other) { return overlap(panel, other); });
        if (hidden == placed.end()) break;
        panel.y = hidden->y + hidden->height + 1.0f;
      }
    }
    // The panels let a little of what is behind them through, which would make letters of both hard to read.
    if (std::any_of(above.begin(), above.end(), [&](const Rectangle& part) { return overlap(panel, part); })) continue;
    placed.push_back(panel);
    group->addChild(plate(plates, panel, 0.3f * page.margin, panel_color));
    const float base = std::round(panel.y + 0.5f * panel.height - 0.36f * static_cast<float>(look.size));
    group->addChild(make_text(label.text, look, panel.x + pad, base));
  }
  return group;
}

osg::ref_ptr<osg::Node> make_crosshair(const Page& page, osg::StateSet* plates) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  const float arm = std::max(5.0f, std::round(0.45f * static_cast<float>(page.letter)));
  const float thick = std::max(1.0f, std::round(static_cast<float>(page.letter) / 12.0f));
  const float x = std::floor(0.5f * page.width), y = std::floor(0.5f * page.height);
  for (const float rim : {1.0f, 0.0f}) {
    const osg::Vec4& color = rim > 0 ? rim_color : text_color;
    const float half = 0.5f * thick + rim, length = arm + rim;
    // The upright stroke has two pieces, so that no transparent pixel is drawn twice.
    group->addChild(plate(plates, {x - length, y - half, 2 * length, 2 * half}, 0, color));
    group->addChild(plate(plates, {x - half, y + half, 2 * half, length - half}, 0, color));
    group->addChild(plate(plates, {x - half, y - length, 2 * half, length - half}, 0, color));
  }
  return group;
}

void show_only(osg::Group& group, std::initializer_list<osg::ref_ptr<osg::Node>> nodes) {
  group.removeChildren(0, group.getNumChildren());
  for (const auto& node : nodes) {
    if (node) group.addChild(node);
  }
}

}  // namespace roam::graphics
