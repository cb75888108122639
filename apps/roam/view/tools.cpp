#include "view/tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "osgroam/pointer.h"
#include "text/printable.h"

namespace roam::app {
namespace {

using Adapter = osgGA::GUIEventAdapter;

constexpr std::size_t most_passed = 1000;  // patterns that a command line has room for

/// Where a body of this radius is at a clicked surface: on a floor, or in front of a wall.
Vec3 beside(const Pick& pick, double radius) {
  constexpr double gap = 0.05;  // metres
  return pick.point + (gap + radius * std::hypot(pick.normal.x, pick.normal.y)) * pick.normal;
}

bool is_left(const Adapter& event) { return event.getButton() == Adapter::LEFT_MOUSE_BUTTON; }

}  // namespace

Tools::Tools(Stage& stage, SceneGraph& scene, osgRoam::Manipulator& roamer, Cameras& cameras, const HiddenSpace& hidden,
             const SceneAndStore& what, const std::filesystem::path& program, SectionShape section)
    : stage_(stage),
      scene_(scene),
      roamer_(roamer),
      cameras_(cameras),
      hidden_(hidden),
      measuring_(roamer),
      probing_(program, what, roamer),
      section_(std::move(section)),
      plan_(stage.frame(), roamer) {}

void Tools::add_to(Commands& commands) {
  commands.add("measure", [this] { toggle_measuring(); });
  commands.add("probe", [this] { probe(); });
  commands.add("section", [this] { toggle_section(); });
  commands.add("section_box", [this] { toggle_box(); });
  commands.add("plan", [this] { plan_.cycle(); });
}

void Tools::toggle_measuring() {
  constexpr double seconds = 4.0;
  tool_ = tool_ == Tool::measure ? Tool::none : Tool::measure;
  measuring_.clear();
  const bool searched = probing_.clear();
  if (tool_ == Tool::measure) {
    stage_.hint(
        fmt::format("{}Measuring: click two points; {} ends", searched ? "The search for a way was stopped. " : "",
                    key_of(roamer_.controls(), "measure")),
        seconds);
  } else {
    stage_.hint(searched ? "Measuring has ended; the search for a way was stopped" : "Measuring has ended", seconds);
  }
}

/// From A to B; with A alone, from the body to A.
void Tools::probe() {
  constexpr double seconds = 4.0;
  const Measurement* const points = tool_ == Tool::measure ? measuring_.shown() : nullptr;
  if (points == nullptr) {
    const std::string key = key_of(roamer_.controls(), "measure"), again = key_of(roamer_.controls(), "probe");
    const std::string begin = tool_ == Tool::measure ? "First click" : fmt::format("First press {} and click", key);
    stage_.hint(fmt::format("{} where to go, or start and end; then press {}", begin, again), seconds);
    return;
  }
  const std::vector<std::string> passed = hidden_.passed();
  if (passed.size() > most_passed) {
    stage_.hint("Too many objects are hidden for a probe", seconds);
    return;
  }
  if (hidden_.is_section_open()) {
    stage_.hint("A probe meets what the section hides", seconds);
  }
  const Vec3 a = beside(points->a, roamer_.settings().radius);
  if (points->b) {
    probing_.ask(a, beside(*points->b, roamer_.settings().radius), passed, {points->a.point, points->b->point});
  } else {
    const Walker& walker = *roamer_.walker();
    measuring_.probe_from_body();
    probing_.ask(roamer_.mode() == Mode::fly ? walker.position() : walker.feet(), a, passed,
                 {std::nullopt, points->a.point});
  }
}

std::string Tools::ended_text() const {
  return section_.shape().empty() ? "All is shown again" : "The rest of the section stays";
}

void Tools::toggle_section() {
  constexpr double seconds = 4.0;
  const bool ends = tool_ == Tool::section;
  tool_ = ends ? Tool::none : Tool::section;
  if (ends) section_.clear_planes();
  const std::string key = key_of(roamer_.controls(), "section");
  stage_.hint(ends ? ended_text()
                   : fmt::format("Section: click what is to be hidden, turn the wheel to cut deeper; {} ends", key),
              seconds);
}

void Tools::toggle_box() {
  constexpr double seconds = 6.0;
  const bool ends = tool_ == Tool::box;
  tool_ = ends ? Tool::none : Tool::box;
  grip_.reset();
  if (ends) {
    section_.set_box(std::nullopt);
  } else if (!section_.box()) {
    section_.set_box(room_around());
  }
  const std::string key = key_of(roamer_.controls(), "section_box");
  stage_.hint(
      ends ? ended_text()
           : fmt::format("Box: drag its points, turn the wheel to shrink it, click where it is to be; {} ends", key),
      seconds);
}

/// From outside a box about the scene, else one about the room that the eye is in.
Box Tools::room_around() const {
  constexpr double reach = 8.0, wall = 0.1;  // m
  const Box scene = scene_.bounds();
  const auto middle = sightline(camera(), 0.0, 0.0);
  const Vec3 eye = middle ? middle->eye : scene.center();
  if (!scene.empty() && !scene.holds(eye)) return scene.grown(0.01);  // no side of the scene flickers
  const Space* const visible = hidden_.visible();
  const Space& space = visible != nullptr ? *visible : *roamer_.space();
  Box room{eye, eye};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double way : {-reach, reach}) {
      Vec3 ray(0.0);
      ray[axis] = way;
      const Impact met = space.ray(eye, ray);
      room.include(met.hit && !met.unknown ? met.point : eye + ray);
    }
  }
  return room.grown(wall);
}

void Tools::update(bool has_body, bool has_plan, const std::vector<graphics::PlanPlace>& places) {
  section_.show(scene_.group(), scene_.origin());
  const bool is_plan_seen = has_plan && stage_.hud().detail() != graphics::Detail::off;
  if (has_body) {
    std::vector<graphics::PlanPlace> all = places;
    if (tool_ == Tool::measure) add_ends_to(all);
    const ProbeReply* const reply = probing_.shown();
    plan_.set_way(reply != nullptr ? way_of(*reply) : ProbedWay{});
    plan_.update(is_plan_seen, hidden_.met(), all);
  }
  if (const std::string problem = plan_.take_problem(); !problem.empty())
    stage_.hint("The plan is not drawn: " + printable(problem), 8.0);
  stage_.hud().set_plan(plan_.place());
}

/// A and B, where the answer has them or where they were clicked.
void Tools::add_ends_to(std::vector<graphics::PlanPlace>& places) {
  const auto add = [&](const Vec3& at, const char* name) { places.push_back({{at.x, at.y}, name}); };
  const Measurement* const points = measuring_.shown();
  if (const ProbeReply* const reply = probing_.shown()) {
    add(reply->start, "A");
    add(reply->target, "B");
  } else if (points != nullptr) {
    add(points->a.point, "A");
    if (points->b) add(points->b->point, "B");
  }
}

CameraView Tools::camera() const {
  const osg::Camera& camera = *stage_.viewer().getCamera();
  return {camera.getViewMatrix(), camera.getProjectionMatrix(), scene_.origin()};
}

std::optional<Pick> Tools::pick_at(const Point& at) const {
  const Space* const visible = hidden_.visible();
  return pick(visible != nullptr ? *visible : *roamer_.space(), camera(), at.x, at.y, section_.shape().hidden());
}

Tools::Point Tools::point_of(const Adapter& event) const {
  if (roamer_.mouseGrab()) return {};
  return {event.getXnormalized(), event.getYnormalized()};
}

bool Tools::handle(const Adapter& event, osgGA::GUIActionAdapter& /*action*/) {
  // A side of the box is held no longer than the button, whatever lies over the picture by then.
  if (event.getEventType() == Adapter::RELEASE && is_left(event) && std::exchange(grip_, std::nullopt)) return true;
  if (event.getHandled() || stage_.hud().help_shown()) return false;
  switch (event.getEventType()) {
    case Adapter::PUSH:
    case Adapter::DOUBLECLICK:
      return is_left(event) && press(event);
    case Adapter::DRAG:
      return drag(event);
    case Adapter::RELEASE:
      if (is_left(event)) release(event);
      return false;
    case Adapter::SCROLL:
      return scroll(event);
    default:
      return false;
  }
}

bool Tools::scroll(const Adapter& event) {
  constexpr double notch = 1.25;
  const Point at = point_of(event);
  const double notches = osgRoam::notches_of(event);
  if (notches == 0.0) return false;
  if (!roamer_.mouseGrab() && plan_.at(at.x, at.y)) {
    plan_.zoom(std::pow(notch, -notches));
    return true;
  }
  if (tool_ == Tool::box) {
    resize_box(at, notches);
    return true;
  }
  if (tool_ != Tool::section) return false;
  const osg::Vec3d eye = stage_.viewer().getCamera()->getInverseViewMatrix().getTrans();
  section_.move(notches, Vec3(eye.x(), eye.y(), eye.z()) + scene_.origin());
  return true;
}

/// All above the floor that the body stands on would be hidden with the floor: the cut begins at the eye.
void Tools::cut(Pick pick) {
  constexpr double seconds = 6.0, flat = 0.7, near = 0.5;  // near, below: m
  constexpr double below = 0.05;
  const Walker* const walker = roamer_.walker();
  const bool is_floor = pick.normal.z > flat && walker != nullptr && std::abs(pick.point.z - walker->feet().z) < near;
  if (is_floor) {
    pick.normal = Vec3(0.0, 0.0, 1.0);
    pick.point.z = roamer_.eye().z - below;
  }
  section_.cut(pick);
  stage_.hint(fmt::format("Cut{} at {}: the wheel moves it", is_floor ? " below the eye," : "",
                          place_text(section_.shape().planes.back())),
              seconds);
}

/// Over a grip its side alone.
void Tools::resize_box(const Point& at, double notches) {
  constexpr double share = 0.04;  // of the longest side
  if (!section_.box()) return;
  const Box& box = *section_.box();
  const Vec3 size = box.size();
  const double step = std::max(Section::least_side, share * std::max({size.x, size.y, size.z}));
  const Grip grip = grip_at(box, camera(), at.x, at.y).value_or(middle_grip);
  section_.set_box(grown_at(grip, box, -notches * step, Section::least_side));
}

bool Tools::drag(const Adapter& event) {
  if (!grip_) return false;
  const Point at = point_of(event);
  const osg::Vec3d ahead =
      osg::Matrixd::transform3x3(osg::Vec3d(0.0, 0.0, -1.0), stage_.viewer().getCamera()->getInverseViewMatrix());
  if (const auto to = sightline(camera(), at.x, at.y); to && from_) {
    section_.set_box(
        dragged(gripped_, *grip_, *from_, *to, Vec3(ahead.x(), ahead.y(), ahead.z()), Section::least_side));
  }
  return true;
}

/// Whether this is no beginning of a drag and nothing for the body.
bool Tools::press(const Adapter& event) {
  const Point at = point_of(event);
  const bool again = presses_.take(event, at.x, at.y);
  is_down_ = !again;
  is_on_plan_ = !roamer_.mouseGrab() && plan_.at(at.x, at.y).has_value();
  grip_.reset();
  if (tool_ == Tool::box && section_.box() && !is_on_plan_ && !roamer_.mouseGrab()) {
    grip_ = grip_at(*section_.box(), camera(), at.x, at.y);
    gripped_ = *section_.box();
    from_ = sightline(camera(), at.x, at.y);
    if (grip_) return true;
  }
  return is_on_plan_ || (again && (tool_ != Tool::none || go(at)));
}

/// The body's own camera would also go to what is hidden.
bool Tools::go(const Point& at) {
  if (!cameras_.body_leads()) return false;
  if (const auto found = pick_at(at)) roamer_.goTo(found->point, found->normal);
  return true;
}

void Tools::release(const Adapter& event) {
  const Point at = point_of(event);
  const bool is_click = std::exchange(is_down_, false) && presses_.is_near(event, at.x, at.y);
  if (!is_click) return;
  if (is_on_plan_) {
    constexpr double seconds = 4.0;
    cameras_.return_to_body();
    if (const std::string reason = plan_.go(at.x, at.y); !reason.empty()) stage_.hint(reason, seconds);
  } else if (tool_ != Tool::none) {
    click(at);
  }
}

void Tools::click(const Point& at) {
  const auto found = pick_at(at);
  if (!found) {
    constexpr double seconds = 2.0;
    stage_.hint("There is no surface here", seconds);
  } else if (tool_ == Tool::measure) {
    constexpr double seconds = 4.0;
    if (probing_.clear()) stage_.hint("The search for a way was stopped: this is another point", seconds);
    measuring_.take(*found);
  } else if (tool_ == Tool::section) {
    cut(*found);
  } else if (section_.box()) {
    const Vec3 half = 0.5 * section_.box()->size();
    section_.set_box(Box{found->point - half, found->point + half});
  }
}

void Tools::fill(Status& status) {
  if (tool_ == Tool::measure) measuring_.fill(status);
  probing_.fill(status);
}

void Tools::fill(ViewReport& report) {
  report.probes = probing_.replies();
  report.measurements = measuring_.all();
  report.section = section_.shape();
}

void Tools::add_to(graphics::Marks& marks) {
  if (tool_ == Tool::box && section_.box()) marks.box = mark_of(*section_.box(), camera(), grip_);
  if (tool_ == Tool::measure) measuring_.add_to(marks, scene_.origin());
  probing_.add_to(marks, scene_.origin());
}

}  // namespace roam::app
