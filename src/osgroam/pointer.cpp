#include "osgroam/pointer.h"

#include <algorithm>
#include <cmath>
#include <osgViewer/View>

#include "osgRoam/Controls.h"

namespace osgRoam {
namespace {

/// Distance from the centre of the window, in its heights, beyond which the pointer is returned. Returning it in every
/// frame would cause traffic.
constexpr double leash = 0.25;

/// Pixels: distance from the centre at which a warped pointer may arrive, because windows round positions.
constexpr double rounding = 2.0;

double ratio(double value, double least, double greatest) {
  return greatest != least ? (value - least) / (greatest - least) : 0.5;
}

double aspect(const osgGA::GUIEventAdapter& event) {
  if (event.getWindowWidth() > 0 && event.getWindowHeight() > 0) {
    return static_cast<double>(event.getWindowWidth()) / event.getWindowHeight();
  }
  return 1.0;
}

osgViewer::View* viewer_view(osgGA::GUIActionAdapter& viewer) {
  return dynamic_cast<osgViewer::View*>(viewer.asView());
}

}  // namespace

double notches_of(const osgGA::GUIEventAdapter& event) {
  const auto motion = event.getScrollingMotion();
  if (motion == osgGA::GUIEventAdapter::SCROLL_UP) return 1.0;
  if (motion == osgGA::GUIEventAdapter::SCROLL_DOWN) return -1.0;
  if (motion != osgGA::GUIEventAdapter::SCROLL_2D || !std::isfinite(event.getScrollingDeltaY())) return 0.0;
  return std::clamp(static_cast<double>(event.getScrollingDeltaY()), -1.0, 1.0);
}

Pointer::~Pointer() {
  show();
  give_back_key();
}

Pointer::Place Pointer::place(const osgGA::GUIEventAdapter& event) {
  const double y = ratio(event.getY(), event.getYmin(), event.getYmax());
  const bool upwards = event.getMouseYOrientation() == osgGA::GUIEventAdapter::Y_INCREASING_UPWARDS;
  return {ratio(event.getX(), event.getXmin(), event.getXmax()) * aspect(event), upwards ? y : 1.0 - y};
}

bool Pointer::push(const osgGA::GUIEventAdapter& event) {
  const Place now = place(event);
  const double since = event.getTime() - click_time_;
  const bool left = event.getButton() == osgGA::GUIEventAdapter::LEFT_MOUSE_BUTTON;
  const bool again = left && clicked_once_ && !dragging_ && since >= 0.0 && since <= double_click_time &&
                     std::hypot(now.x - clicked_.x, now.y - clicked_.y) <= double_click_distance;
  clicked_once_ = left && !again;
  clicked_ = now;
  click_time_ = event.getTime();
  dragging_ = true;
  if (!grabbed_) last_ = now;
  return again;
}

Pointer::Movement Pointer::move(const osgGA::GUIEventAdapter& event) {
  const Place now = place(event);
  middle_ = {0.5 * aspect(event), 0.5};
  if (!grabbed_ && (!dragging_ || event.getEventType() != osgGA::GUIEventAdapter::DRAG)) return {};
  if (grabbed_ && !known_) {
    known_ = true;
    last_ = now;
    return {};
  }
  if (grabbed_ && warped_) {
    // Events from before the warp still arrive. The first that is nearer to the centre is from after it.
    const double from_middle = std::hypot(now.x - middle_.x, now.y - middle_.y);
    if (from_middle < std::hypot(now.x - last_.x, now.y - last_.y)) {
      warped_ = false;
      const double pixel = event.getWindowHeight() > 0 ? 1.0 / event.getWindowHeight() : 0.0;
      last_ = from_middle <= rounding * pixel ? now : middle_;
    }
  }
  const Movement movement{last_.x - now.x, now.y - last_.y};
  last_ = now;
  return movement;
}

void Pointer::want_grab(bool on) {
  wanted_ = on;
  if (on) return;
  grabbed_ = false;
  show();
}

void Pointer::keep_grab(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& viewer, const Controls& controls,
                        bool release_down) {
  if (!wanted_) {
    // The viewer closes on the key's release, and checks it before its handlers run. So return the key only after that.
    if (!release_down) give_back_key();
  } else if (!grabbed_) {
    start(event, viewer, controls);
  } else if (known_ && !warped_) {
    if (std::hypot(last_.x - middle_.x, last_.y - middle_.y) > leash) warp(event, viewer);
  }
}

void Pointer::start(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& viewer, const Controls& controls) {
  grabbed_ = true;
  known_ = dragging_ = false;
  if (osgViewer::View* view = viewer_view(viewer)) {
    osg::GraphicsContext* context = view->getCamera()->getGraphicsContext();
    if (!context && event.getGraphicsContext()) {
      context = const_cast<osg::GraphicsContext*>(event.getGraphicsContext());
    }
    if (auto* window = dynamic_cast<osgViewer::GraphicsWindow*>(context)) {
      window->useCursor(false);
      hidden_in_ = window;
    }
    osgViewer::ViewerBase* base = view->getViewerBase();
    const Controls::Command* command =
        base && !kept_open_.valid() ? controls.lookup(base->getKeyEventSetsDone(), false) : nullptr;
    if (command && command->name == "release") {
      closing_key_ = base->getKeyEventSetsDone();
      kept_open_ = base;
      base->setKeyEventSetsDone(0);
    }
  }
  warp(event, viewer);
}

void Pointer::warp(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& viewer) {
  warped_ = known_;
  viewer.requestWarpPointer(0.5f * (event.getXmin() + event.getXmax()), 0.5f * (event.getYmin() + event.getYmax()));
}

void Pointer::show() {
  osg::ref_ptr<osgViewer::GraphicsWindow> window;
  if (hidden_in_.lock(window)) window->useCursor(true);
  hidden_in_ = nullptr;
}

void Pointer::give_back_key() {
  // An observer, because many viewers live on the stack, where no reference keeps them.
  osgViewer::ViewerBase* viewer = kept_open_.get();
  if (viewer && viewer->getKeyEventSetsDone() == 0) viewer->setKeyEventSetsDone(closing_key_);
  kept_open_ = nullptr;
}

}  // namespace osgRoam
