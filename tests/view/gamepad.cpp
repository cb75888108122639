// Gamepads and SpaceMice.
#include "view/gamepad.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <thread>

#ifdef ROAM_WITH_SDL
#include <SDL.h>
#endif

#include "view/controllers.h"
#include "view_stores.h"

namespace {

using namespace roam::app;
using Axes = osgRoam::Manipulator::Axes;

TEST(Gamepad, AtRestWishesNothing) {
  EXPECT_EQ(axes_of(PadState{}, 1.0, false), Axes{});
  PadState worn;
  worn.left = {0.12, -0.12};
  worn.right = {-0.1, 0.14};
  worn.left_trigger = 0.1;
  EXPECT_EQ(axes_of(worn, 1.0, false), Axes{}) << "sticks of worn gamepads do not return to 0";
  EXPECT_EQ(axes_of(PuckState{.right = 0.1, .turn_left = -0.1}, 1.0), Axes{});
}

TEST(Gamepad, WalksWithTheLeftStickAndLooksWithTheRightOne) {
  PadState pad;
  pad.left = {0.0, -1.0};  // pushed away
  Axes axes = axes_of(pad, 1.0, false);
  EXPECT_DOUBLE_EQ(axes.forward, 1.0);
  EXPECT_DOUBLE_EQ(axes.right, 0.0);
  pad.left = {1.0, 1.0};
  axes = axes_of(pad, 1.0, false);
  EXPECT_GT(axes.right, 0.5);
  EXPECT_LT(axes.forward, -0.5);
  EXPECT_LE(std::hypot(axes.right, axes.forward), 1.0 + 1e-9) << "a corner is no faster";
  pad = {};
  pad.right = {1.0, 0.0};
  EXPECT_LT(axes_of(pad, 1.0, false).turn_left, -1.0) << "to the right";
  EXPECT_DOUBLE_EQ(axes_of(pad, 2.0, false).turn_left, 2.0 * axes_of(pad, 1.0, false).turn_left);
  pad.right = {0.0, -1.0};
  EXPECT_GT(axes_of(pad, 1.0, false).look_up, 1.0);
  EXPECT_LT(axes_of(pad, 1.0, true).look_up, -1.0) << "inverted as the mouse";
}

TEST(Gamepad, MovesSmoothlyOutOfTheDeadZone) {
  PadState pad;
  double before = 0.0;
  for (double x = 0.0; x <= 1.0; x += 0.01) {
    pad.left = {x, 0.0};
    const double right = axes_of(pad, 1.0, false).right;
    EXPECT_GE(right, before);
    EXPECT_LT(right - before, 0.04) << x;
    before = right;
  }
  EXPECT_NEAR(before, 1.0, 0.03);
}

TEST(Gamepad, RisesWithItsTriggersAndHasTheKeysOfABody) {
  PadState pad;
  pad.right_trigger = 1.0;
  EXPECT_DOUBLE_EQ(axes_of(pad, 1.0, false).up, 1.0);
  pad.left_trigger = 1.0;
  EXPECT_DOUBLE_EQ(axes_of(pad, 1.0, false).up, 0.0);
  pad.buttons[static_cast<std::size_t>(PadButton::b)] = true;
  pad.buttons[static_cast<std::size_t>(PadButton::left_shoulder)] = true;
  EXPECT_TRUE(axes_of(pad, 1.0, false).crouch);
  EXPECT_TRUE(axes_of(pad, 1.0, false).fast);
  EXPECT_STREQ(command_of(PadButton::a), "jump");
  EXPECT_STREQ(command_of(PadButton::x), "gravity");
  EXPECT_EQ(command_of(PadButton::b), nullptr);
}

TEST(Gamepad, IsJoinedByASpaceMouse) {
  const Axes puck = axes_of(PuckState{.up = 0.5, .forward = 1.0, .turn_left = 1.0}, 1.0);
  EXPECT_DOUBLE_EQ(puck.forward, 1.0);
  EXPECT_GT(puck.up, 0.2);
  EXPECT_GT(puck.turn_left, 1.0);
  const Axes both = sum_of(puck, {.right = 0.25, .crouch = true});
  EXPECT_DOUBLE_EQ(both.right, 0.25);
  EXPECT_DOUBLE_EQ(both.forward, 1.0);
  EXPECT_TRUE(both.crouch);
}

/// What SpaceMice speak to, at a socket of its own.
class Daemon {
 public:
  explicit Daemon(const std::string& path) : socket_(socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    unlink(path.c_str());
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(listen(socket_, 1), 0);
  }
  ~Daemon() {
    close(client_);
    close(socket_);
  }
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  void push_forward() {
    client_ = accept(socket_, nullptr, nullptr);
    const std::array<std::int32_t, 8> motion{0, 0, 0, 350, 0, 0, 0, 10};
    EXPECT_EQ(write(client_, motion.data(), sizeof motion), static_cast<ssize_t>(sizeof motion));
  }

 private:
  int socket_ = -1, client_ = -1;
};

TEST(Gamepad, ComesToRestWhenTheDaemonOfSpaceMiceEnds) {
  const TestFolder folder;
  const std::string path = folder.file("spnav.sock");
  setenv("SPNAV_SOCKET", path.c_str(), 1);
  auto daemon = std::make_unique<Daemon>(path);
  Gamepads devices;
  if (devices.puck().present) {
    daemon->push_forward();
    EXPECT_EQ(devices.puck().forward, 1.0);
    daemon.reset();
    EXPECT_EQ(devices.puck().forward, 0.0) << "the body would run away";
    EXPECT_FALSE(devices.puck().present);
    daemon = std::make_unique<Daemon>(path);
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!devices.puck().present && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    EXPECT_TRUE(devices.puck().present) << "it has been started again";
  }
  unsetenv("SPNAV_SOCKET");
  if (!devices.puck().present) GTEST_SKIP() << "built without SpaceMice";
}

TEST(Gamepad, TypesNothingIntoAQuestion) {
  view_stores::Driven d;
  d.write_scene();
  d.begin();
  d.run(0.5);
  const osg::ref_ptr<Prompt> prompt = new Prompt(d.session->stage());
  Controllers controllers(*d.session, *prompt, 1.0);
  PadState pad;
  pad.present = true;
  pad.left = {0.0, -1.0};
  pad.buttons[static_cast<std::size_t>(PadButton::start)] = true;
  prompt->ask("Name", {}, [](const std::string&) {});
  controllers.take(pad, {});
  EXPECT_FALSE(d.session->stage().hud().help_shown());
  const double before = d.place().x;
  d.run(0.5);
  EXPECT_DOUBLE_EQ(d.place().x, before) << "nor does it lead";
}

TEST(Gamepad, TypesNothingIntoAList) {
  view_stores::Driven d;
  d.write_scene();
  d.options.size = "640x360";
  d.begin();
  const osg::ref_ptr<Prompt> prompt = new Prompt(d.session->stage());
  Controllers controllers(*d.session, *prompt, 1.0);
  d.session->run("layers");
  PadState pad;
  pad.present = true;
  pad.buttons[static_cast<std::size_t>(PadButton::x)] = true;
  controllers.take(pad, {});
  d.run(0.1);
  EXPECT_EQ(d.session->roamer().mode(), roam::Mode::fly);
  EXPECT_TRUE(contains(d.hud(), "[x] ceiling")) << "the letter of the button's key finds no ceiling: " << d.hud();
}

#ifdef ROAM_WITH_SDL
/// A gamepad of SDL's own, without hardware.
class Virtual {
 public:
  Virtual() {
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    EXPECT_EQ(SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER), 0) << SDL_GetError();
    index_ = SDL_JoystickAttachVirtual(SDL_JOYSTICK_TYPE_GAMECONTROLLER, SDL_CONTROLLER_AXIS_MAX,
                                       SDL_CONTROLLER_BUTTON_MAX, 0);
    if (index_ < 0) return;
    joystick_ = SDL_JoystickOpen(index_);
    // Triggers at rest are at the lower end of their range.
    set_axis(SDL_CONTROLLER_AXIS_TRIGGERLEFT, -32768);
    set_axis(SDL_CONTROLLER_AXIS_TRIGGERRIGHT, -32768);
  }
  ~Virtual() {
    unplug();
    SDL_QuitSubSystem(SDL_INIT_GAMECONTROLLER);
  }
  Virtual(const Virtual&) = delete;
  Virtual& operator=(const Virtual&) = delete;

  void unplug() {
    if (joystick_ != nullptr) SDL_JoystickClose(joystick_);
    if (index_ >= 0) SDL_JoystickDetachVirtual(index_);
    joystick_ = nullptr;
    index_ = -1;
  }
  [[nodiscard]] bool is_there() const { return index_ >= 0; }
  void set_axis(int axis, int value) { SDL_JoystickSetVirtualAxis(joystick_, axis, static_cast<Sint16>(value)); }
  void set_button(int button, bool down) {
    SDL_JoystickSetVirtualButton(joystick_, button, static_cast<Uint8>(down ? 1 : 0));
  }

 private:
  int index_ = -1;
  SDL_Joystick* joystick_ = nullptr;
};

TEST(Gamepad, IsReadWhileItIsPluggedIn) {
  Gamepads devices;
  EXPECT_TRUE(Gamepads::supported());
  EXPECT_FALSE(devices.pad().left_trigger > 0.0);
  Virtual pad;
  if (!pad.is_there()) GTEST_SKIP() << "this SDL has no virtual gamepads: " << SDL_GetError();
  (void)devices.pad();
  pad.set_axis(SDL_CONTROLLER_AXIS_LEFTY, -32768);
  pad.set_axis(SDL_CONTROLLER_AXIS_RIGHTX, 32767);
  pad.set_axis(SDL_CONTROLLER_AXIS_TRIGGERRIGHT, 32767);
  pad.set_button(SDL_CONTROLLER_BUTTON_A, true);
  const PadState state = devices.pad();
  EXPECT_TRUE(state.present);
  EXPECT_NEAR(state.left[1], -1.0, 1e-3);
  EXPECT_NEAR(state.right[0], 1.0, 1e-3);
  EXPECT_NEAR(state.right_trigger, 1.0, 1e-3);
  EXPECT_NEAR(state.left_trigger, 0.0, 1e-3);
  EXPECT_TRUE(state.is_down(PadButton::a));
  EXPECT_FALSE(state.is_down(PadButton::b));
  pad.unplug();
  (void)devices.pad();
  EXPECT_EQ(axes_of(devices.pad(), 1.0, false), Axes{}) << "a gamepad that is gone wishes nothing";
  EXPECT_FALSE(devices.pad().present);
}

TEST(Gamepad, TakesNeitherSignalsNorScreenNorSound) {
  struct sigaction before {
  }, after{};
  ASSERT_EQ(sigaction(SIGINT, nullptr, &before), 0);
  const Gamepads devices;
  ASSERT_EQ(sigaction(SIGINT, nullptr, &after), 0);
  EXPECT_EQ(before.sa_handler, after.sa_handler);
  EXPECT_EQ(SDL_WasInit(SDL_INIT_VIDEO | SDL_INIT_AUDIO), 0u);
}
#endif

}  // namespace
