#include "view/list_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "osgroam/pointer.h"
#include "roam/error.h"

namespace roam::app {
namespace {

using Adapter = osgGA::GUIEventAdapter;

constexpr double notch_rows = 3.0;

}  // namespace

void ListPanel::draw() {
  graphics::Hud& hud = stage_.hud();
  graphics::HudList list = head();
  const std::size_t room = std::max<std::size_t>(1, hud.list_rows());
  first_ = std::min(first_, rows_.size() - std::min(rows_.size(), room));
  const std::size_t end = std::min(rows_.size(), first_ + room);
  if (end < rows_.size()) list.title += fmt::format("   wheel: {} more", rows_.size() - end);
  list.rows.assign(rows_.begin() + static_cast<std::ptrdiff_t>(first_),
                   rows_.begin() + static_cast<std::ptrdiff_t>(end));
  hud.set_list(std::move(list));
}

bool ListPanel::handle(const Adapter& event, osgGA::GUIActionAdapter& /*action*/) {
  graphics::Hud& hud = stage_.hud();
  // A button that was pressed here belongs to the list until its release, even if the list was closed meanwhile.
  if (event.getEventType() == Adapter::RELEASE) return std::exchange(is_down_, false);
  if (event.getEventType() == Adapter::PUSH) is_down_ = false;
  if (event.getHandled() || !shown_ || roamer_.mouseGrab() || hud.help_shown()) return false;
  const double x = event.getXnormalized(), y = event.getYnormalized();
  const bool here = hud.list_covers(x, y);
  switch (event.getEventType()) {
    case Adapter::PUSH:
    case Adapter::DOUBLECLICK:
      if (!here || event.getButton() == 0) return here;
      is_down_ = true;
      again_ = presses_.take(event, x, y);
      press(hud.list_at(x, y), event.getButton() == Adapter::RIGHT_MOUSE_BUTTON);
      return true;
    case Adapter::DRAG:
      return is_down_;
    case Adapter::MOVE:
      hud.set_list_focus(hud.list_at(x, y));
      return here;
    case Adapter::SCROLL:
      if (here) scroll(osgRoam::notches_of(event));
      return here;
    default:
      return false;
  }
}

void ListPanel::press(const std::string& part, bool right) {
  try {
    right ? click_right(part) : click(part);
  } catch (const Error& error) {
    news_.note(error.what());
  }
}

void ListPanel::scroll(double notches) {
  const double first = static_cast<double>(first_) - std::round(notch_rows * notches);
  first_ = static_cast<std::size_t>(std::clamp(first, 0.0, static_cast<double>(rows_.size())));
}

}  // namespace roam::app
