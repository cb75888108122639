#include "view/film.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>

#include "cli/interrupt.h"
#include "roam/error.h"

namespace roam::app {

struct Film::State {
  std::filesystem::path path;
  int rate = 0;
  std::mutex mutex;
  std::optional<graphics::Video> video;  ///< from the first picture on: a window manager may size the window
  int width = 0, height = 0;
  bool finished = false;
  std::string problem;

  /// `why` the film has no more pictures.
  void end(double seconds, const std::string& why) {
    if (problem.empty()) problem = fmt::format("the film {} ends after {:.1f} s: {}", path.string(), seconds, why);
  }

  void add(osg::ref_ptr<osg::Image> image, double seconds) {
    if (finished || !problem.empty()) return;
    try {
      if (!video) {
        width = image->s();
        height = image->t();
        video.emplace(path, width, height, rate);
      }
      if (image->s() != width || image->t() != height) {
        return end(seconds, "the size of the window has changed, and a film has one");
      }
      video->add(std::move(image), seconds);
    } catch (const std::exception& error) {  // there may be neither memory nor a thread for it
      problem = error.what();
    }
  }
};

Film::Film(graphics::Frame& frame, const std::filesystem::path& path, int rate)
    : frame_(frame), rate_(rate), state_(std::make_shared<State>()) {
  graphics::Video::check(path, frame.width(), frame.height(), rate);
  state_->path = path;
  state_->rate = rate;
}

const std::filesystem::path& Film::path() const { return state_->path; }

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
    state->add(std::move(image), time);
  };
  const auto fail = [state = state_, time = seconds - begin_](const std::string& reason) {
    const std::lock_guard lock(state->mutex);
    state->end(time, reason);
  };
  frame_.request_picture(true, add, fail);
}

std::string Film::problem() const {
  const std::lock_guard lock(state_->mutex);
  return state_->problem;
}

void Film::finish() {
  const std::lock_guard lock(state_->mutex);
  state_->finished = true;
  if (!state_->video) {
    const std::string file = path().string();
    throw Error::at(file, state_->problem.empty() ? "the film " + file + " has no picture" : state_->problem);
  }
  state_->video->finish(graphics::Video::patience, [given = false]() mutable {
    if (!interrupted()) return false;
    // The report is written in this time, too.
    if (!std::exchange(given, true)) give_time_to_write(longest_writing);
    return true;
  });
}

}  // namespace roam::app
