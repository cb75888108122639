#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "cli/interrupt.h"
#include "cli/tell.h"
#include "graphics/large_picture.h"
#include "roam/error.h"
#include "view/stage.h"

namespace roam::app {

/// Whether the pictures that wait for their files take as much memory as they may.
bool Stage::is_writing_much() const {
  constexpr std::size_t most = 512u << 20, bytes_a_pixel = 3;
  const auto [width, height] = enlarged_size();
  return pictures_.size() * bytes_a_pixel * static_cast<std::size_t>(width) * static_cast<std::size_t>(height) > most;
}

std::vector<Picture> Stage::poll_pictures() {
  std::vector<Picture> told = std::exchange(failed_, {});
  std::erase_if(pictures_, [&](graphics::Screenshot& picture) {
    if (!picture.done()) return false;
    if (picture_scale_ > 1.0 && hint_.starts_with("Writing ")) end_hint(0.0);
    told.push_back({picture.path(), {}});
    try {
      picture.finish();
    } catch (const Error& error) {
      told.back().problem = error.what();
    }
    return true;
  });
  if (film_ && !film_stopped_) {
    if (std::string problem = film_->problem(); !problem.empty()) {
      film_stopped_ = true;
      told.push_back({film_->path(), std::move(problem)});
    }
  }
  return told;
}

osg::ref_ptr<osg::Image> Stage::large_picture(int width, int height) {
  osg::Camera& camera = *viewer_->getCamera();
  struct Detail {
    osg::Camera& camera;
    const float scale = camera.getLODScale();
    ~Detail() { camera.setLODScale(scale); }
  } const of_window{camera};
  camera.setLODScale(1.0f);
  // Without updates, which would add pages from one tile to the next.
  return graphics::draw_large_picture(*frame_, width, height, [this] {
    stop_if_interrupted();
    viewer_->renderingTraversals();
  });
}

std::array<int, 2> Stage::enlarged_size() const {
  constexpr double longest = 16384.0;  // pixels
  const double scale = std::min(picture_scale_, longest / std::max(frame_->width(), frame_->height()));
  const auto scaled = [&](int length) { return static_cast<int>(std::lround(scale * length)); };
  return {scaled(frame_->width()), scaled(frame_->height())};
}

/// The picture of the key, larger than the window.
void Stage::take_enlarged() {
  const char* const file = "roam.png";
  try {
    const auto [width, height] = enlarged_size();
    pictures_.emplace_back(large_picture(width, height), file, files::Naming::numbered);
  } catch (const Error& error) {
    end_hint(0.0);
    failed_.push_back({file, error.what()});
  }
}

void Stage::draw_picture(const std::filesystem::path& path, bool with_display) {
  if (!with_display && screenshot_ && *screenshot_ != std::array{frame_->width(), frame_->height()}) {
    draw();
    graphics::Screenshot(large_picture((*screenshot_)[0], (*screenshot_)[1]), path).finish();
  } else {
    graphics::Screenshot picture(*frame_, path, with_display);
    draw();
    picture.finish();
  }
  written_.push_back(path.string());
}

/// On the terminal, and in the window unless it is closed.
void Stage::say_what_is_finished() {
  std::string what;
  if (film_) what = written_.front();
  for (const graphics::Screenshot& picture : pictures_) {
    if (!picture.done()) what = "a picture";
  }
  if (what.empty() || headless()) return;
  tell("finishing " + what + " ...");
  if (!context_.window->isRealized()) return;
  ask({});
  hint("Finishing ...");
  fade_hint();
  viewer_->updateTraversal();
  viewer_->renderingTraversals();
}

void Stage::finish(Unwritten& unwritten) {
  if (is_still_next() || picture_wanted_) {  // asked for in the last frame, which was not drawn
    enlarged_in_ = interrupted() ? 0 : std::min(enlarged_in_, 1);
    if (is_still_next()) overlay_->set_marks({});
    hold_film(true);
    draw();
  }
  for (const Picture& failed : std::exchange(failed_, {})) {
    unwritten.attempt([&] { throw Error::at(failed.file.string(), failed.problem); });
  }
  say_what_is_finished();
  for (graphics::Screenshot& picture : pictures_) {
    unwritten.attempt([&] {
      viewer_->done() ? picture.finish(std::chrono::seconds(0)) : picture.finish();  // nothing more is drawn
      written_.push_back(picture.path().string());
    });
  }
  pictures_.clear();
  if (!film_) return;
  const std::string film = written_.front();
  written_.erase(written_.begin());
  unwritten.attempt([&] {
    film_->finish();
    written_.insert(written_.begin(), film);
    if (const std::string problem = film_->problem(); !problem.empty()) throw Error::at(film, problem);
  });
  film_.reset();
}

}  // namespace roam::app
