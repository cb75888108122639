#include "build/steps.h"

#include <nlohmann/json.hpp>

#include "cli/interrupt.h"
#include "cli/report.h"

namespace roam::app {
namespace {

const char* name_of(StoreBuildProgress::Step step) {
  constexpr const char* names[] = {"read", "plan", "shards", "merge"};
  return names[static_cast<std::size_t>(step)];
}

}  // namespace

bool Steps::show(const StoreBuildProgress& p) {
  using Step = StoreBuildProgress::Step;
  if (json_lines_) {
    print_line({{"step", name_of(p.step)},
                {"bytes_done", p.bytes_done},
                {"bytes_total", p.bytes_total},
                {"triangles_done", p.triangles_done},
                {"triangles_total", p.triangles_total}});
    return !interrupted();
  }
  if (!line_ || p.step != step_) {
    line_.reset();
    step_ = p.step;
    switch (step_) {
      case Step::read:
        line_.emplace("reading the scene", "B");
        break;
      case Step::plan:
        line_.emplace("planning " + output_, "triangles");
        break;
      case Step::shards:
        line_.emplace("building " + output_, "triangles");
        break;
      case Step::merge:
        line_.emplace("checking " + output_, "triangles");
        break;
    }
  }
  return step_ == Step::read ? line_->goes_on(p.bytes_done, p.bytes_total)
                             : line_->goes_on(p.triangles_done, p.triangles_total);
}

}  // namespace roam::app
