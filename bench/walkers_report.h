#pragma once
/// \file
/// The results of `roam bench walkers`, as text, JSON and a picture.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/report.h"
#include "controllers.h"
#include "draw/sheet.h"
#include "paper_judge.h"

namespace roam::bench {

/// The first way of the paper three times, moved by `shift`: a person at 1.4 and at 50 m/s, and a sphere that flies.
[[nodiscard]] std::vector<Way> walkers_ways(const Vec3& shift);

/// One controller on one way.
struct ControllerWalk {
  std::string way, controller, used;
  Judgement judged{};                        ///< of the first round
  std::size_t steps = 0;                     ///< of the first round
  std::vector<double> p50{}, p99{}, most{};  ///< microseconds a step, one of each round

  /// Adds a round.
  void add(const Walked& walked);
};

struct ControllerFailure {
  std::string controller, why;
};

struct WalkerFindings {
  std::string scene;
  int rounds = 0;
  std::vector<ControllerWalk> walks;  ///< way by way
  std::vector<Controller> absent;
  std::vector<ControllerFailure> failed;
};

/// How many times as fast as the fastest other controller roam's walk is, by the medians of p50 and p99. Those that
/// did not reach the end do not count. 0: unknown.
struct WalkerLead {
  std::string way;
  double p50 = 0.0, p99 = 0.0;
};
[[nodiscard]] std::vector<WalkerLead> walker_leads(const WalkerFindings& findings);

[[nodiscard]] std::string walkers_tables(const WalkerFindings& findings);
[[nodiscard]] app::Json walkers_json(const WalkerFindings& findings);
[[nodiscard]] draw::Sheet walkers_chart(const WalkerFindings& findings);
/// answer_no if roam was in a wall; failed if it failed.
[[nodiscard]] app::ExitStatus walkers_status(const WalkerFindings& findings);

}  // namespace roam::bench
