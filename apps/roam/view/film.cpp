#include "view/film.h"

#include <fmt/format.h>

#include <cmath>
#include <mutex>
#include <optional>

#include "roam/error.h"

namespace roam::app {

struct Film::State {
  std::mutex mutex;
  std::optional<graphics::Video> video;
  int width = 0, height = 0;
  std::string problem;

  /// `why` the film has no more pictures.
  void end(const std::string& name, double seconds, const std::string& why) {
    if (problem.empty()) problem = fmt::format("the film {} ends after {:.1f} s: {}", name, seconds, why);
  }
};

Film::Film(graphics::Frame& frame, const std::filesystem::path& path, int rate)
    : frame_(frame), path_(path), rate_(rate), state_(std::make_shared<State>()) {
  state_->width = frame.width();
  state_->height = frame.height();
  state_->video.emplace(path, state_->width, state_->height, rate);
}

/// The picture of the film that is shown at this time.
std::int64_t Film::index(double seconds) const {
  return static_cast<std::int64_t>(std::floor((seconds - begin_) * rate_ + graphics::Video::time_rounding));
}

bool Film::is_due(double seconds) const { return begin_ < 0.0 || index(seconds) >= next_; }

void Film::before_frame(double seconds) {
  if (begin_ < 0.0) begin_ = seconds;
  next_ = index(seconds) + 1;
  const std::string name = path_.string();
  const auto add = [state = state_, name, time = seconds - begin_](osg::ref_ptr<osg::Image> image) {
    const std::lock_guard lock(state->mutex);
    if (!state->video || !state->problem.empty()) return;
    if (image->s() != state->width || image->t() != state->height) {
      return state->end(name, time, "the size of the window has changed, and a film has one");
    }
    try {
      state->video->add(std::move(image), time);
    } catch (const Error& error) {
      state->problem = error.what();
    }
  };
  const auto fail = [state = state_, name, time = seconds - begin_](const std::string& reason) {
    const std::lock_guard lock(state->mutex);
    state->end(name, time, reason);
  };
  frame_.request_picture(true, add, fail);
}

std::string Film::problem() const {
  const std::lock_guard lock(state_->mutex);
  return state_->problem;
}

void Film::finish() {
  const std::lock_guard lock(state_->mutex);
  if (!state_->video) return;
  state_->video->finish();
  state_->video.reset();
}

}  // namespace roam::app
