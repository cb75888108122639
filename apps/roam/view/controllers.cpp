#include "view/controllers.h"

namespace roam::app {

Controllers::Controllers(Stage& stage, osgRoam::Manipulator& roamer, const Prompt& prompt, double sensitivity)
    : stage_(stage), roamer_(roamer), prompt_(prompt), sensitivity_(sensitivity) {}

bool Controllers::update(bool leads) {
  if (stage_.headless() || !Gamepads::supported()) return false;
  if (!devices_) devices_ = std::make_unique<Gamepads>();
  const bool had = has_gamepad();
  take(devices_->pad(), devices_->puck(), leads);
  return has_gamepad() != had;
}

void Controllers::take(const PadState& pad, const PuckState& puck, bool leads) {
  using Axes = osgRoam::Manipulator::Axes;
  // The keys of buttons would be text.
  const bool asks = prompt_.is_asking();
  roamer_.setAxes(leads && !asks
                      ? sum_of(axes_of(pad, sensitivity_, roamer_.lookInverted()), axes_of(puck, sensitivity_))
                      : Axes{});
  for (std::size_t i = 0; i < pad_buttons; ++i) {
    const char* const command = command_of(static_cast<PadButton>(i));
    if (command == nullptr || asks || !pad.buttons[i] || before_.buttons[i]) continue;
    press_key_of(roamer_.controls(), command, *stage_.viewer().getEventQueue());
  }
  before_ = pad;
}

}  // namespace roam::app
