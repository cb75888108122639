// What the session learns about the size of the body.
#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "roam/profile.h"
#include "view/session.h"

namespace roam::app {

void Session::begin_learning() {
  Profile known;
  std::filesystem::path file;
  if (plan_.profile) {
    known = plan_.profile->profile;
    file = plan_.profile->file;
  } else {
    const WalkerSettings& body = roamer_->settings();
    known.scene = loaded_->identity;
    known.radius = body.radius;
    known.height = body.height;
    known.support_radius = body.support_radius;
    known.step = body.step;
    known.slope_degrees = body.slope_degrees;
    file = profile_path(options_.scene.scenes);
    // What was trained for another body than this one is not written over.
    if (options_.no_profile || std::filesystem::exists(file)) file.clear();
  }
  learning_.emplace(std::move(known), std::move(file), options_.adapt);
  roamer_->setRegions(learning_->profile().regions);
}

/// To be called whenever there is another walker.
void Session::take_sizes() {
  if (!learning_ || learning_->taken() == 0 || roamer_->walker() == nullptr) return;
  roamer_->walker()->resize(learning_->profile().radius, learning_->profile().support_radius);
}

void Session::take_lesson() {
  const bool asked = std::exchange(lesson_wanted_, false);
  if (!learning_ || roamer_->walker() == nullptr) return;
  if (const auto taken = learning_->take(*roamer_->walker(), asked)) {
    roamer_->setRegions(learning_->profile().regions);
    if (taken->placed) roamer_->placed();
    if (taken->told.warning) {
      note(taken->told.text);
    } else {
      tell(taken->told.text);
    }
  }
}

}  // namespace roam::app
