#pragma once
/// \file
/// The end of a session for another one that reads the scene otherwise: with another axis up, in another unit, or
/// without some objects.

#include <functional>
#include <optional>
#include <string>

#include "osgRoam/Manipulator.h"
#include "view/arrival.h"
#include "view/commands.h"
#include "view/display.h"
#include "view/news.h"
#include "view/options.h"
#include "view/pose.h"
#include "view/records.h"
#include "view/store_building.h"

namespace roam::app {

/// How the person wants to read the scene next.
struct NextSession {
  std::optional<SceneFrame> frame;  ///< another frame, where places of this one mean nothing
  std::string leave_out;            ///< without `frame`: pattern of an object to leave out too; empty: show all again
  Pose at;                          ///< the body at the end
  Mode mode = Mode::walk;
  std::string note;  ///< a message for the person; empty: none

  // As the person left it; see Session::next.
  SectionShape section;
  double speed = 0.0;  ///< m/s
  SceneObjects::Decisions hidden;
  bool passes = false;  ///< the body, through what is hidden
  HudMode hud = HudMode::plain;
  bool edges = true;
};

/// The same axis, and the unit that the file states; without one, the next of m, cm, mm, ft, in, in a circle.
[[nodiscard]] SceneFrame next_unit(const SceneFrame& frame, std::optional<LengthUnit> stated);

/// Sets the options for the next session. `given`: those of the command line. Returns a sentence for the person.
std::string go_on(ViewOptions& options, const NextSession& next, const ViewOptions& given);
/// Makes the next session begin as the person left this one; without its lengths, if the frame is another.
void keep_view(ViewPlan& plan, const NextSession& next);

class Rereading {
 public:
  Rereading(const SceneAndStore& what, const ViewOptions& options, const Arrival& arrival,
            const osgRoam::Manipulator& roamer, const Display& display, const Records& records,
            const StoreBuilding& building, News& news)
      : what_(what),
        options_(options),
        arrival_(arrival),
        roamer_(roamer),
        display_(display),
        records_(records),
        building_(building),
        news_(news) {}

  /// Adds "turn", "unit", "leave_out" and "show_all".
  void add_to(Commands& commands);
  /// Set if this session ends for another one. Without the view.
  [[nodiscard]] const std::optional<NextSession>& next() const { return next_; }

 private:
  [[nodiscard]] bool is_possible();
  void read_with(const std::function<SceneFrame(const SceneFrame&)>& changed);
  void leave_out_ahead();
  void show_all();
  void leave_out(const std::string& pattern);

  const SceneAndStore& what_;
  const ViewOptions& options_;
  const Arrival& arrival_;
  const osgRoam::Manipulator& roamer_;
  const Display& display_;
  const Records& records_;
  const StoreBuilding& building_;
  News& news_;
  std::optional<NextSession> next_;
};

}  // namespace roam::app
