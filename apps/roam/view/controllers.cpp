#include "view/controllers.h"

#include "view/session.h"

namespace roam::app {

bool Controllers::update() {
  if (session_.stage().headless() || !Gamepads::supported()) return false;
  if (!devices_) devices_ = std::make_unique<Gamepads>();
  const bool had = has_gamepad();
  take(devices_->pad(), devices_->puck());
  return has_gamepad() != had;
}

void Controllers::take(const PadState& pad, const PuckState& puck) {
  using Axes = osgRoam::Manipulator::Axes;
  osgRoam::Manipulator& roamer = session_.roamer();
  const bool asks = prompt_.is_asking();
  roamer.setAxes(session_.roamer_leads() && !asks
                     ? sum_of(axes_of(pad, sensitivity_, roamer.lookInverted()), axes_of(puck, sensitivity_))
                     : Axes{});
  for (std::size_t i = 0; i < pad_buttons; ++i) {
    const char* const command = command_of(static_cast<PadButton>(i));
    if (command == nullptr || asks || !pad.buttons[i] || before_.buttons[i]) continue;
    session_.press(command);
  }
  before_ = pad;
}

}  // namespace roam::app
