#include <fmt/format.h>

#include "words/measures.h"
#include "words/training.h"

namespace roam::words {
namespace {

const char* expected_words(Contradiction::Body body) {
  using Body = Contradiction::Body;
  return body == Body::outside_opening ? "be stopped" : body == Body::small_disc ? "fall" : "come through";
}

const char* body_kind(Contradiction::Body body) {
  using Body = Contradiction::Body;
  switch (body) {
    case Body::chosen:
      return "the chosen body";
    case Body::chosen_back:
      return "the chosen body, on its way back up over a crack";
    case Body::inside_opening:
      return "just inside the opening";
    case Body::outside_opening:
      return "just outside the opening";
    case Body::wide_disc:
      return "a support disc just wide enough";
    case Body::small_disc:
      return "a support disc just too small";
  }
  return "";
}

const char* what_it_did(Outcome outcome) {
  switch (outcome) {
    case Outcome::reached:
      return "came through and was";
    case Outcome::blocked:
      return "was blocked";
    case Outcome::left_scene:
      return "left the scene";
    case Outcome::fell:
      return "fell";
    case Outcome::held:
      return "did not fit";
  }
  return "";
}

}  // namespace

std::string contradiction(const Contradiction& contradiction) {
  const Trial& trial = contradiction.trial;
  const std::string size =
      trial.support_radius > trial.radius
          ? fmt::format("radius {:.3f} m on a support disc of {:.3f} m", trial.radius, trial.support_radius)
          : fmt::format("radius {:.3f} m", trial.radius);
  return fmt::format("On path {} a body with {} ({}) should {}, but {} at {}.", trial.path + 1, size,
                     body_kind(contradiction.body), expected_words(contradiction.body), what_it_did(trial.outcome),
                     at(trial.at));
}

}  // namespace roam::words
