#include "view/page_lod.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace roam::app {
namespace {

constexpr float infinite = std::numeric_limits<float>::max();

bool is_parallel(const osg::CullStack& camera) {
  const osg::RefMatrix* const projection = camera.getProjectionMatrix();
  return projection != nullptr && (*projection)(3, 3) != 0.0;
}

}  // namespace

PageLod::PageLod(const DisplayPages& pages, std::shared_ptr<PageRules> rules)
    : rules_(std::move(rules)),
      measure_(pages.measure),
      error_(pages.error),
      half_(pages.half.x, pages.half.y, pages.half.z) {
  setCenterMode(USER_DEFINED_CENTER);
  setCenter(osg::Vec3d(pages.center.x, pages.center.y, pages.center.z));
  setRadius(pages.radius);
}

void PageLod::add_range(float from, float to) {
  setRange(static_cast<unsigned>(levels_.size()), from, to);
  levels_.emplace_back(from, to);
}

float PageLod::value(const osg::Vec3d& eye, double pixels) const {
  const osg::Vec3d from_center = eye - osg::Vec3d(getCenter());
  if (measure_ == DisplayMeasure::metres) return static_cast<float>(from_center.length());
  // Not infinite, because ranges end below infinity.
  const auto at = [](double seen, double distance) {
    return static_cast<float>(std::min(distance > 0.0 ? seen / distance : seen * infinite, 0.5 * infinite));
  };
  if (measure_ == DisplayMeasure::pixels) return at(2.0 * getRadius() * pixels, from_center.length());
  if (rules_->allowed_error <= 0.0) return std::nextafter(infinite, 0.0f);
  osg::Vec3d outside;
  for (int k = 0; k < 3; ++k) outside[k] = std::max(0.0, std::abs(from_center[k]) - half_[k]);
  return at(error_ * pixels / rules_->allowed_error, outside.length());
}

void PageLod::choose(const osg::CullStack& camera) {
  const osg::Viewport* const viewport = camera.getViewport();
  if (viewport == nullptr || camera.getProjectionMatrix() == nullptr || !(camera.getLODScale() > 0.0f)) return;
  const double pixels = 0.5 * viewport->height() * std::abs((*camera.getProjectionMatrix())(1, 1));
  const float now = value(osg::Vec3d(camera.getEyeLocal()), pixels / static_cast<double>(camera.getLODScale()));
  for (unsigned i = 0; i < levels_.size(); ++i) {
    const auto [from, to] = levels_[i];
    const bool shown = from <= now && now < to;
    // At any distance, or at none. The base class divides by the length of the range.
    setRange(i, shown ? 0.0f : 0.5f * infinite, infinite);
    // The largest on the screen is read first; by distance it is as in the base class.
    setPriorityOffset(i, measure_ == DisplayMeasure::metres ? (to - now) / (to - from) : now);
    setPriorityScale(i, 0.0f);
  }
}

void PageLod::traverse(osg::NodeVisitor& visitor) {
  const osg::CullStack* const camera =
      visitor.getVisitorType() == osg::NodeVisitor::CULL_VISITOR ? visitor.asCullStack() : nullptr;
  if (camera == nullptr) return PagedLOD::traverse(visitor);
  if (is_parallel(*camera)) return draw_last(visitor);
  choose(*camera);
  PagedLOD::traverse(visitor);
  note_drawn(visitor);
}

/// The base class gives the number of the frame to each child that it draws.
void PageLod::note_drawn(const osg::NodeVisitor& visitor) {
  if (visitor.getFrameStamp() == nullptr) return;
  const unsigned now = visitor.getFrameStamp()->getFrameNumber();
  std::vector<unsigned> drawn;
  for (unsigned i = 0; i < getNumChildren(); ++i) {
    if (getFrameNumber(i) == now) drawn.push_back(i);
  }
  if (drawn == drawn_) return;
  drawn_ = std::move(drawn);
  ++rules_->changes;
}

/// Requests no page, and keeps none. In place of a page that has been dropped since, the last one that is there.
void PageLod::draw_last(osg::NodeVisitor& visitor) {
  const unsigned count = getNumChildren();
  bool is_drawn = false;
  for (const unsigned i : drawn_) {
    if (i >= count) continue;
    getChild(i)->accept(visitor);
    is_drawn = true;
  }
  if (!is_drawn && count > 0) getChild(count - 1)->accept(visitor);
}

bool PageLod::removeExpiredChildren(double time, unsigned int frame, osg::NodeList& removed) {
  return PagedLOD::removeExpiredChildren(std::min(time, rules_->drop_before), frame, removed);
}

}  // namespace roam::app
