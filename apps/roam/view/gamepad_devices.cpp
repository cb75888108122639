// The devices behind Gamepads. Without a library, they are at rest.
#include <algorithm>
#include <cerrno>
#include <cstdlib>

#include "view/gamepad.h"

#ifdef ROAM_WITH_SDL
#include <SDL.h>
#include <dlfcn.h>
#endif
#ifdef ROAM_WITH_SPNAV
#include <poll.h>
#include <spnav.h>

#include <chrono>
#endif

namespace roam::app {

#ifdef ROAM_WITH_SDL
/// SDL, loaded when a window opens: it brings some forty libraries, which no other verb needs.
class SdlLibrary {
 public:
  SdlLibrary() : library_(::dlopen("libSDL2-2.0.so.0", RTLD_NOW | RTLD_LOCAL)) {}
  // It stays loaded: libraries that it brings have threads.
  [[nodiscard]] bool is_there() const { return library_ != nullptr && !lacks_; }

 private:
  template <class Function>
  Function* find(const char* name) {
    void* const found = library_ == nullptr ? nullptr : ::dlsym(library_, name);
    lacks_ = lacks_ || found == nullptr;
    return reinterpret_cast<Function*>(found);
  }
  void* library_;
  bool lacks_ = false;

 public:
#define ROAM_SDL(name) decltype(::SDL_##name)* const name = find<decltype(::SDL_##name)>("SDL_" #name)
  ROAM_SDL(SetHint);
  ROAM_SDL(InitSubSystem);
  ROAM_SDL(QuitSubSystem);
  ROAM_SDL(FlushEvents);
  ROAM_SDL(NumJoysticks);
  ROAM_SDL(IsGameController);
  ROAM_SDL(GameControllerOpen);
  ROAM_SDL(GameControllerClose);
  ROAM_SDL(GameControllerUpdate);
  ROAM_SDL(GameControllerGetAttached);
  ROAM_SDL(GameControllerGetAxis);
  ROAM_SDL(GameControllerGetButton);
#undef ROAM_SDL
};

struct Gamepads::Sdl {
  Sdl() {
    if (!sdl.is_there()) return;
    sdl.SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    sdl.SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
    // The kernel's drivers are enough; SDL's own would claim USB devices.
    sdl.SetHint(SDL_HINT_JOYSTICK_HIDAPI, "0");
    ready = sdl.InitSubSystem(SDL_INIT_GAMECONTROLLER) == 0;
  }
  ~Sdl() {
    if (pad != nullptr) sdl.GameControllerClose(pad);
    if (ready) sdl.QuitSubSystem(SDL_INIT_GAMECONTROLLER);
  }
  Sdl(const Sdl&) = delete;
  Sdl& operator=(const Sdl&) = delete;

  PadState state() {
    if (!ready) return {};
    sdl.GameControllerUpdate();
    // Nobody reads the events.
    sdl.FlushEvents(SDL_FIRSTEVENT, SDL_LASTEVENT);
    if (pad != nullptr && sdl.GameControllerGetAttached(pad) == SDL_FALSE) {
      sdl.GameControllerClose(pad);
      pad = nullptr;
    }
    for (int i = 0; pad == nullptr && i < sdl.NumJoysticks(); ++i) {
      if (sdl.IsGameController(i) == SDL_TRUE) pad = sdl.GameControllerOpen(i);
    }
    return pad == nullptr ? PadState{} : read();
  }

  [[nodiscard]] PadState read() const {
    const auto axis = [&](SDL_GameControllerAxis which) {
      constexpr double range = 32767.0;
      return std::clamp(sdl.GameControllerGetAxis(pad, which) / range, -1.0, 1.0);
    };
    PadState state;
    state.present = true;
    state.left = {axis(SDL_CONTROLLER_AXIS_LEFTX), axis(SDL_CONTROLLER_AXIS_LEFTY)};
    state.right = {axis(SDL_CONTROLLER_AXIS_RIGHTX), axis(SDL_CONTROLLER_AXIS_RIGHTY)};
    state.left_trigger = axis(SDL_CONTROLLER_AXIS_TRIGGERLEFT);
    state.right_trigger = axis(SDL_CONTROLLER_AXIS_TRIGGERRIGHT);
    constexpr SDL_GameControllerButton buttons[pad_buttons] = {SDL_CONTROLLER_BUTTON_A,
                                                               SDL_CONTROLLER_BUTTON_B,
                                                               SDL_CONTROLLER_BUTTON_X,
                                                               SDL_CONTROLLER_BUTTON_Y,
                                                               SDL_CONTROLLER_BUTTON_BACK,
                                                               SDL_CONTROLLER_BUTTON_START,
                                                               SDL_CONTROLLER_BUTTON_LEFTSTICK,
                                                               SDL_CONTROLLER_BUTTON_RIGHTSTICK,
                                                               SDL_CONTROLLER_BUTTON_LEFTSHOULDER,
                                                               SDL_CONTROLLER_BUTTON_RIGHTSHOULDER};
    for (std::size_t i = 0; i < pad_buttons; ++i) {
      state.buttons[i] = sdl.GameControllerGetButton(pad, buttons[i]) != 0;
    }
    return state;
  }

  SdlLibrary sdl;
  bool ready = false;
  SDL_GameController* pad = nullptr;
};
#else
struct Gamepads::Sdl {
  [[nodiscard]] PadState state() { return {}; }
};
#endif

#ifdef ROAM_WITH_SPNAV
struct Gamepads::Spacenav {
  Spacenav() { open(); }
  ~Spacenav() {
    if (ready) spnav_close();
  }
  Spacenav(const Spacenav&) = delete;
  Spacenav& operator=(const Spacenav&) = delete;

  void open() {
    tried_at = std::chrono::steady_clock::now();
    ready = spnav_open() != -1;
    last = {.present = ready};
  }

  /// Whether the daemon has ended. A puck that was pushed then would never come to rest.
  [[nodiscard]] static bool is_lost() {
    pollfd connection{spnav_fd(), POLLIN, 0};
    return poll(&connection, 1, 0) < 0 ? errno != EINTR : (connection.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
  }

  PuckState state() {
    if (ready && is_lost()) {
      spnav_close();
      ready = false;
      last = {};
    }
    constexpr std::chrono::seconds pause(10);  // libspnav loses 48 bytes at each try without the daemon
    if (!ready && std::chrono::steady_clock::now() - tried_at >= pause) open();
    constexpr double range = 350.0;  // of the daemon's numbers
    spnav_event event;
    while (ready && spnav_poll_event(&event) != 0) {
      if (event.type != SPNAV_EVENT_MOTION) continue;
      const auto share = [](int value) { return std::clamp(value / range, -1.0, 1.0); };
      const spnav_event_motion& motion = event.motion;
      last = {true, share(motion.x), share(motion.y), share(motion.z), -share(motion.ry), -share(motion.rx)};
    }
    return last;
  }

  bool ready = false;
  PuckState last;
  std::chrono::steady_clock::time_point tried_at;
};
#else
struct Gamepads::Spacenav {
  [[nodiscard]] PuckState state() { return {}; }
};
#endif

Gamepads::Gamepads() : sdl_(std::make_unique<Sdl>()), spacenav_(std::make_unique<Spacenav>()) {}
Gamepads::~Gamepads() = default;

bool Gamepads::supported() {
#if defined(ROAM_WITH_SDL) || defined(ROAM_WITH_SPNAV)
  return true;
#else
  return false;
#endif
}

void Gamepads::need_no_bus() { ::setenv("DBUS_SESSION_BUS_ADDRESS", "disabled:", 0); }

PadState Gamepads::pad() { return sdl_->state(); }

PuckState Gamepads::puck() { return spacenav_->state(); }

}  // namespace roam::app
