#pragma once
/// \file
/// The results of `roam bench engines`, as text, JSON and a picture. Wrong answers come before times.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/report.h"
#include "comparison.h"
#include "draw/sheet.h"
#include "engine.h"

namespace roam::bench {

/// A failure of an engine while it was built or queried.
struct EngineFailure {
  std::string name, set, why;  ///< the set is empty while it is built
};

/// The results in one scene.
struct SceneFindings {
  std::string scene;
  std::uint64_t triangles = 0;
  std::vector<Engine> engines;
  std::vector<EngineFailure> failed;
  std::vector<EngineRun> runs;  ///< of these engines
};

/// The results of a run.
struct EngineFindings {
  int rounds = 0;
  std::vector<SceneFindings> scenes;
  std::vector<EngineOffer> absent;
};

[[nodiscard]] std::string engine_tables(const EngineFindings& findings);
[[nodiscard]] app::Json engine_json(const EngineFindings& findings);
[[nodiscard]] draw::Sheet engine_chart(const EngineFindings& findings);
/// answer_no if roam missed something or was late; failed if it failed.
[[nodiscard]] app::ExitStatus engine_status(const EngineFindings& findings);

}  // namespace roam::bench
