#include "graphics/plan_panel.h"

#include <algorithm>
#include <cmath>
#include <osg/BlendFunc>
#include <osg/Geometry>
#include <osg/LineWidth>
#include <osg/Scissor>
#include <string>

#include "graphics/hud_panels.h"
#include "graphics/lettering.h"
#include "math/round_length.h"

namespace roam::graphics {
namespace {

// The colours of the sheets that `roam walk --picture` draws, see draw/style.h.
const osg::Vec4 paper(1.0f, 1.0f, 1.0f, 0.92f);
const osg::Vec4 legend_paper(1.0f, 1.0f, 1.0f, 1.0f);
const osg::Vec4 rim(0.36f, 0.39f, 0.45f, 1.0f);
const osg::Vec4 wall(0.13f, 0.15f, 0.20f, 1.0f);
const osg::Vec4 below(0.66f, 0.70f, 0.76f, 1.0f);
const osg::Vec4 blue(0.10f, 0.38f, 0.72f, 1.0f);
const osg::Vec4 green(0.08f, 0.47f, 0.25f, 1.0f);
const osg::Vec4 orange(0.85f, 0.33f, 0.05f, 1.0f);
const osg::Vec4 ink(0.11f, 0.13f, 0.17f, 1.0f);

constexpr float small_share = 0.34f, large_share = 0.86f;  ///< of the picture's height

/// Null without points.
osg::ref_ptr<osg::Geometry> strokes(const std::vector<glm::vec2>& points, GLenum type, const osg::Vec4& color) {
  if (points.empty()) return nullptr;
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  corners->reserve(points.size());
  for (const glm::vec2& p : points) corners->push_back(osg::Vec3(p.x, p.y, 0.0f));
  osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
  colors->push_back(color);
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setUseDisplayList(false);
  geometry->setUseVertexBufferObjects(true);
  geometry->setCullingActive(false);
  geometry->setVertexArray(corners);
  geometry->setColorArray(colors, osg::Array::BIND_OVERALL);
  geometry->addPrimitiveSet(new osg::DrawArrays(type, 0, static_cast<GLsizei>(points.size())));
  return geometry;
}

/// "5 m", "0.5 m"
std::string metres(double length) {
  std::string text =
      length < 1.0 ? "0." + std::to_string(std::lround(10.0 * length)) : std::to_string(std::lround(length));
  return text + " m";
}

}  // namespace

PlanPanel::PlanPanel(Frame& frame)
    : frame_(frame),
      parent_(frame.flat()),
      group_(new osg::Group),
      sheet_(new osg::Group),
      legend_(new osg::Group),
      coming_(new osg::Group),
      map_(new osg::MatrixTransform),
      body_(new osg::MatrixTransform),
      lines_(new osg::Group),
      trail_(new osg::Group),
      way_(new osg::Group),
      names_(new osg::Group) {
  group_->setName("plan");
  osg::StateSet& state = *group_->getOrCreateStateSet();
  state.setRenderBinDetails(0, "TraversalOrderBin", osg::StateSet::OVERRIDE_RENDERBIN_DETAILS);
  state.setAttributeAndModes(new osg::BlendFunc);
  state.setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
  map_->addChild(lines_);
  map_->addChild(trail_);
  map_->addChild(way_);
  map_->getOrCreateStateSet()->setMode(GL_LINE_SMOOTH, osg::StateAttribute::ON);
  for (osg::Node* node : {static_cast<osg::Node*>(sheet_.get()), static_cast<osg::Node*>(map_.get()),
                          static_cast<osg::Node*>(names_.get()), static_cast<osg::Node*>(legend_.get()),
                          static_cast<osg::Node*>(coming_.get()), static_cast<osg::Node*>(body_.get())}) {
    group_->addChild(node);
  }
  group_->setNodeMask(0u);
  // Below the head-up display, which was added before.
  parent_->insertChild(0, group_);
}

PlanPanel::~PlanPanel() { parent_->removeChild(group_); }

void PlanPanel::set_lines(const PlanLines& lines) {
  base_ = lines.base;
  show_only(*lines_, {strokes(lines.below, GL_LINES, below), strokes(lines.walls, GL_LINES, wall)});
}

void PlanPanel::set_trail(const std::vector<glm::vec2>& trail) { show_only(*trail_, {strokes(trail, GL_LINES, blue)}); }

void PlanPanel::set_way(const std::vector<glm::vec2>& open, const std::vector<glm::vec2>& barred) {
  show_only(*way_, {strokes(open, GL_LINE_STRIP, green), strokes(barred, GL_LINE_STRIP, orange)});
}

void PlanPanel::set_places(const std::vector<PlanPlace>& places) {
  if (places == places_) return;
  places_ = places;
  lay_out_places();
}

void PlanPanel::lay_out_places() {
  const Page page = Page::of(static_cast<float>(frame_.width()), static_cast<float>(frame_.height()));
  names_->removeChildren(0, names_->getNumChildren());
  texts_.clear();
  for (const PlanPlace& place : places_) {
    texts_.push_back(make_text("\u25cf " + place.name, {page.letter, false, green}, 0.0f, 0.0f));
    names_->addChild(texts_.back());
  }
}

/// Puts each dot to its place. Names that would leave the panel are not shown.
void PlanPanel::move_places() {
  const Rectangle r = place();
  const double scale = 0.5 * static_cast<double>(r.width) / view_.half;
  const float letter = static_cast<float>(Page::of(static_cast<float>(width_), static_cast<float>(height_)).letter);
  for (std::size_t i = 0; i < texts_.size(); ++i) {
    const glm::dvec2 at = scale * (places_[i].at - view_.centre);
    const float x = r.x + 0.5f * r.width + static_cast<float>(std::clamp(at.x, -1e6, 1e6)) - 0.38f * letter;
    const float y = r.y + 0.5f * r.height + static_cast<float>(std::clamp(at.y, -1e6, 1e6)) - 0.36f * letter;
    const bool inside = x >= r.x && x + texts_[i]->width() <= r.x + r.width && y >= r.y && y + letter <= r.y + r.height;
    texts_[i]->setNodeMask(inside ? ~0u : 0u);
    texts_[i]->set_place(x, y);
  }
}

Rectangle PlanPanel::place() const {
  if (view_.size == PlanSize::none) return {};
  const auto width = static_cast<float>(frame_.width()), height = static_cast<float>(frame_.height());
  const Page page = Page::of(width, height);
  const float share = view_.size == PlanSize::large ? large_share : small_share;
  // A line below the upper edge stays free for the mark of a recording, and the middle for the crosshair.
  const float top = height - 2.0f * page.margin - 2.0f * page.line;
  const float side = std::round(std::min({share * height, 0.46f * width, std::max(1.0f, top - page.margin)}));
  return {std::round(width - page.margin - side), std::round(std::max(top - side, page.margin)), side, side};
}

void PlanPanel::lay_out() {
  width_ = frame_.width();
  height_ = frame_.height();
  laid_half_ = view_.half;
  laid_size_ = view_.size;
  const Rectangle r = place();
  const Page page = Page::of(static_cast<float>(width_), static_cast<float>(height_));
  const osg::ref_ptr<osg::StateSet> plates = plate_state();
  const auto plate = [&](const Rectangle& where, const osg::Vec4& color) {
    osg::ref_ptr<osg::Geometry> made = make_plate(where, 0.0f, color);
    made->setStateSet(plates);
    return made;
  };
  show_only(*sheet_, {plate({r.x - 1, r.y - 1, r.width + 2, r.height + 2}, rim), plate(r, paper)});
  // The scale at the lower left and the north at the upper right, over the walls and on paper of their own.
  const double length = round_length(0.5 * view_.half);
  const float letter = static_cast<float>(page.letter), pad = std::round(0.5f * page.margin);
  const float thick = std::max(2.0f, std::round(0.12f * letter));
  const Look look{page.letter, false, ink};
  const std::string words = metres(length);
  const Rectangle bar{r.x + pad, r.y + pad, std::round(static_cast<float>(length / view_.half) * 0.5f * r.width),
                      thick};
  const Rectangle scale{r.x, r.y, std::max(bar.width, std::ceil(width_of(words, look))) + 2 * pad,
                        std::round(letter + 3.0f * thick) + 1.5f * pad};
  const Rectangle north{r.x + r.width - 2.0f * letter, r.y + r.height - 1.6f * letter, 2.0f * letter, 1.6f * letter};
  show_only(*legend_, {plate(scale, legend_paper), plate(bar, ink),
                       make_text(words, look, bar.x, std::round(bar.y + 2.5f * thick)), plate(north, legend_paper),
                       make_text("N", look, std::round(north.x + 0.5f * (north.width - width_of("N", look))),
                                 std::round(north.y + 0.4f * letter))});
  const std::string coming = "is being drawn";
  show_only(*coming_, {make_text(coming, look, std::round(r.x + 0.5f * (r.width - width_of(coming, look))),
                                 std::round(r.y + 0.3f * r.height))});
  osg::StateSet& map_state = *map_->getOrCreateStateSet();
  map_state.setAttributeAndModes(new osg::Scissor(static_cast<int>(r.x), static_cast<int>(r.y),
                                                  static_cast<int>(r.width), static_cast<int>(r.height)));
  const float line = std::max(1.2f, 0.1f * static_cast<float>(page.letter));
  map_state.setAttribute(new osg::LineWidth(line));
  for (const auto& wide : {trail_, way_}) wide->getOrCreateStateSet()->setAttribute(new osg::LineWidth(2.0f * line));
  // The body: an arrow along its gaze, whose size does not depend on the scale.
  const float arm = 0.75f * static_cast<float>(page.letter);
  body_->removeChildren(0, body_->getNumChildren());
  body_->addChild(strokes({{arm, 0.0f}, {-0.7f * arm, 0.6f * arm}, {-0.35f * arm, 0.0f}, {-0.7f * arm, -0.6f * arm}},
                          GL_TRIANGLE_FAN, blue));
  lay_out_places();
}

void PlanPanel::set_view(const PlanView& view) {
  view_ = view;
  group_->setNodeMask(view.size == PlanSize::none ? 0u : ~0u);
  if (view.size == PlanSize::none) return;
  if (width_ != frame_.width() || height_ != frame_.height() || laid_half_ != view.half || laid_size_ != view.size) {
    lay_out();
  }
  coming_->setNodeMask(view.is_coming ? ~0u : 0u);
  const Rectangle r = place();
  const double scale = 0.5 * static_cast<double>(r.width) / view.half;  // pixels in a metre
  const glm::dvec2 middle(r.x + 0.5f * r.width, r.y + 0.5f * r.height), from = base_ - view.centre;
  map_->setMatrix(osg::Matrixd::scale(scale, scale, 1.0) *
                  osg::Matrixd::translate(middle.x + scale * from.x, middle.y + scale * from.y, 0.0));
  body_->setMatrix(osg::Matrixd::rotate(view.yaw, osg::Vec3d(0.0, 0.0, 1.0)) *
                   osg::Matrixd::translate(middle.x, middle.y, 0.0));
  move_places();
}

std::optional<glm::dvec2> PlanPanel::at(double x, double y) const {
  if (view_.size == PlanSize::none) return std::nullopt;
  const Rectangle r = place();
  const glm::dvec2 pixel(0.5 * (1.0 + x) * frame_.width(), 0.5 * (1.0 + y) * frame_.height());
  const glm::dvec2 share((pixel.x - r.x) / r.width, (pixel.y - r.y) / r.height);
  if (!(share.x >= 0.0 && share.x <= 1.0 && share.y >= 0.0 && share.y <= 1.0)) return std::nullopt;
  return view_.centre + view_.half * (2.0 * share - 1.0);
}

}  // namespace roam::graphics
