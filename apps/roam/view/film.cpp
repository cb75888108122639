#include "view/film.h"

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
  const auto add = [state = state_, time = seconds - begin_](osg::ref_ptr<osg::Image> image) {
    const std::lock_guard lock(state->mutex);
    if (!state->video || !state->problem.empty()) return;
    if (image->s() != state->width || image->t() != state->height) {
      state->problem = "the film has ended: the size of the window has changed";
      return;
    }
    try {
      state->video->add(std::move(image), time);
    } catch (const Error& error) {
      state->problem = error.what();
    }
  };
  const auto fail = [state = state_](const std::string& reason) {
    const std::lock_guard lock(state->mutex);
    state->problem = reason;
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
