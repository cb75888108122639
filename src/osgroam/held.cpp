#include "osgroam/held.h"

#include <cmath>

namespace osgRoam {
namespace {

/// "; N passes through walls", with the first key of the command; empty without a key.
std::string remedy(const Manipulator& roamer, const char* command, const char* effect) {
  const Controls::Command* const found = roamer.controls().find(command);
  if (found == nullptr || found->keys.empty()) return {};
  return "; " + Controls::print(found->keys.front()) + effect;
}

}  // namespace

std::string why_held(const Manipulator& roamer) {
  if (!roamer.problem().empty()) return "held: " + roamer.problem();
  if (roamer.building()) {
    return "held: indexing the walls, " + std::to_string(std::lround(100.0 * roamer.buildProgress())) + " %";
  }
  if (!roamer.space()) return "held: no space to move in has been set";
  if (!roamer.held()) return {};
  if (roamer.report().met_unknown) return "held: the walls here are not loaded yet";
  const bool walks = roamer.mode() == roam::Mode::walk;
  const roam::StepReport& report = roamer.report();
  const bool fits = roamer.space()->fits(roam::Body::capsule(roamer.settings().radius, report.height), report.to);
  return std::string("held: ") + (walks && fits ? "there is nothing below to stand on" : "the body does not fit here") +
         (walks ? remedy(roamer, "gravity", " flies") : remedy(roamer, "ghost", " passes through walls")) +
         remedy(roamer, "home", " goes to the start");
}

}  // namespace osgRoam
