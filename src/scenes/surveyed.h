#pragma once
/// \file
/// The input of `roam train` and `roam probe`: a scene, or a store, read whole and surveyed.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "roam/profile.h"
#include "roam/store.h"
#include "roam/survey.h"
#include "scenes/scene_options.h"

namespace CLI {
class App;
}

namespace roam::app {

/// Adds SCENE..., the options of SceneOptions::add_reading_to() and those of add_web_options().
void add_surveyed_to(CLI::App& verb, SceneOptions& options);

struct Surveyed {
  Survey survey;                       ///< lossless
  SceneIdentity identity;              ///< of the scene or store that was read
  std::shared_ptr<const Store> store;  ///< the store that was read; null: a scene
  std::vector<TriangleId> numbers;     ///< number in the store, by triangle

  /// The name of a triangle's object. Empty for no triangle, an object without a name, and in a scene of one object.
  [[nodiscard]] std::string name(TriangleId triangle) const;
  /// The names of the objects at both ends of a measured distance; see measure::at_ends().
  [[nodiscard]] std::pair<std::string, std::string> names_at(const Vec3& point, const Vec3& direction,
                                                             double width) const;
};

/// Reads and surveys, with progress and the import's notes on standard error. A store is read whole, as it is stored.
/// Throws the errors of import_scene, Store::open and Survey::build. Throws UsageError for options without meaning for
/// a store, and roam::Error for a store larger than the free memory.
[[nodiscard]] Surveyed survey_scene(const SceneOptions& options, double slope_degrees);

/// Checks --spacing, m. Throws UsageError if it is more than half the scene's length, which would leave hardly any
/// place. Warns on standard error if openings of `width`, m, may be overlooked.
void check_spacing(const Surveyed& scene, double spacing, double width);

}  // namespace roam::app
