#include "view/display.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <osgUtil/IntersectionVisitor>
#include <utility>

#include "osgRoam/BoxIntersector.h"
#include "osgroam/vectors.h"
#include "view/body.h"
#include "view/learning.h"
#include "view/start.h"
#include "words/measures.h"

namespace roam::app {
namespace {

constexpr double period = 0.1;        // s: as fast as a person reads
constexpr double speed_time = 0.2;    // s: time constant of the mean speed shown
constexpr double marks_reach = 0.25;  // m from the body's surface: nearer triangles are drawn
constexpr std::size_t most_triangles = 2000;

/// The graph's triangles near the body.
std::vector<Triangle> triangles_near(osg::Node& graph, const Body& body, const Vec3& place) {
  const Body wider = Body::capsule(body.radius + marks_reach, body.height() + 2.0 * marks_reach);
  const osg::Vec3d at = osgRoam::to_osg(place);
  const osg::ref_ptr<osgRoam::BoxIntersector> box = new osgRoam::BoxIntersector(wider, at, at);
  box->setGatherCandidates(true);
  osgUtil::IntersectionVisitor visitor(box);
  graph.accept(visitor);
  std::vector<Triangle> near;
  for (const Triangle& candidate : box->getCandidates()) {
    if (proximity(body, place, candidate).distance > marks_reach) continue;
    near.push_back(candidate);
    if (near.size() == most_triangles) break;
  }
  return near;
}

/// A note of a scene's report as the window shows it: in one line, if it is of many files.
std::string shown_of(const std::string& note, const DisplayReport& report) {
  const auto says = [&](const char* words) { return note.find(words) != std::string::npos; };
  const std::uint64_t images = report.missing_textures, outside = report.import.outside_references;
  const std::string names = "; the terminal names them";
  if (images > 0 && says(" that the scene refers to ") && says(" image")) {
    return words::counted(images, "image") + (images == 1 ? " is" : " are") + " missing" + names;
  }
  // Images outside of the folder are missing images, too.
  if (outside == 0 || !says(" out of the scene's folder ")) return note;
  return outside <= images ? "" : words::counted(outside, "file") + " outside of the scene's folder left out" + names;
}

}  // namespace

Display::Display(Stage& stage, SceneGraph& scene, osgRoam::Manipulator& roamer, News& news, double fov)
    : stage_(stage), scene_(scene), roamer_(roamer), news_(news), fov_(fov), sun_(stage.frame(), scene.group()) {
  sun_.watch([&scene] { return scene.version(); });
}

void Display::watch(const StepReport& report, const Vec3& wish) {
  if (report.elapsed > 0.0) {
    const double share = std::min(1.0, report.elapsed / speed_time);
    speed_ += share * (glm::distance(report.from, report.to) / report.elapsed - speed_);
  } else {
    speed_ = 0.0;
  }
  if (roamer_.walker() == nullptr) return;
  hold_.take(*roamer_.walker(), wish, report.elapsed, shown_.paging && shown_.paging->failed > 0);
}

void Display::tell_news() {
  if (!display_told_ && scene_.state().phase == LoadState::Phase::failed) {
    display_told_ = true;
    news_.note(fmt::format("{} of the scene can be seen, its walls are there all the same: {}",
                           scene_.has_pieces() ? "not all" : "nothing", scene_.state().error.what()));
  }
  if (!display_told_ && scene_.report()) {
    display_told_ = true;
    const DisplayReport& report = *scene_.report();
    for (const auto* notes : {&report.notes, &report.import.notes}) {
      for (const std::string& sentence : *notes) news_.note(sentence, shown_of(sentence, report));
    }
  }
  if (scene_.missing_pages() > pages_told_) {
    pages_told_ = scene_.missing_pages();
    news_.note(fmt::format("{} of the scene could not be read: coarser ones are shown there ({})",
                           words::counted(pages_told_, "page"), scene_.page_problem()));
  }
  tell_of_pages();
  // A still lacks more than the frames before and after it.
  if (const std::string lack = stage_.frame().lack(); !lack.empty() && std::exchange(driver_lack_told_, lack) != lack) {
    news_.note(lack);
  }
  for (const Picture& picture : stage_.poll_pictures()) {
    if (picture.problem.empty()) {
      news_.written(picture.file);
    } else {
      news_.note(picture.problem);
    }
  }
}

void Display::tell_of_pages() {
  const std::vector<std::string> notes = scene_.pages().notes();
  for (; page_notes_told_ < notes.size(); ++page_notes_told_) news_.note(notes[page_notes_told_]);
  const PageSource& pages = scene_.pages();
  constexpr double mib = 1024.0 * 1024.0;
  const auto tell = [&](bool& told, const char* what) {
    if (std::exchange(told, true)) return;
    news_.note(
        fmt::format("{}: its pages fill {:.0f} MiB (--page-memory)", what, static_cast<double>(pages.bytes()) / mib));
  };
  if (pages.coarser() > 1.0) tell(coarser_told_, "the picture is coarser than it could be");
  if (pages.lacks()) tell(lack_told_, "some pages of the scene are not in the picture");
}

bool Display::is_due() const { return shown_at_ < 0.0 || stage_.now() - shown_at_ >= period; }

Status Display::status(bool has_body) {
  Status s;
  s.display = scene_.state();
  s.resident = resident_bytes();
  s.frame_ms = stage_.last_frame_ms();
  s.quality = stage_.quality_note();
  s.news = news_.shown();
  if (!roamer_.problem().empty()) s.news.push_back({roamer_.problem(), true});
  if (!has_body) return s;
  const Walker& walker = *roamer_.walker();
  const Pose at = pose_of(roamer_);
  s.mode = roamer_.mode();
  s.body = walker.settings();
  s.size_reason = size_reason(walker);
  s.crouched = walker.crouched();
  s.grounded = walker.grounded();
  s.yaw = at.yaw;
  s.pitch = at.pitch;
  s.pace = roamer_.speed();
  s.speed = speed_;
  s.collision_us = static_cast<double>(roamer_.collisionNanoseconds()) * 1e-3;
  s.hold = hold_.told(shown_.coming);
  return s;
}

void Display::show(Status status) {
  constexpr double speed_seconds = 2.0;
  if (shown_.mode && status.mode && status.pace != shown_.pace) {
    stage_.hint(fmt::format("speed {:.3g} m/s", status.pace), speed_seconds);
  }
  shown_ = std::move(status);
  shown_at_ = stage_.now();
  stage_.show(shown_);
}

double Display::aspect() const {
  return static_cast<double>(stage_.frame().width()) / std::max(stage_.frame().height(), 1);
}

void Display::update(bool has_body, double room, graphics::Marks marks) {
  graphics::Frame& frame = stage_.frame();
  // A scene smaller than the body is looked at from nearer than the body comes to anything.
  constexpr double share = 0.05;
  const Box bounds = scene_.bounds();
  const double limit = bounds.empty() ? room : std::min(room, share * glm::length(bounds.size()));
  const double near = graphics::near_limit(std::max(limit, 1e-6), frame.vertical_fov(), aspect());
  if (near != frame.near()) frame.set_near(near);
  if (marks_ && has_body) {
    const Walker& walker = *roamer_.walker();
    const Vec3 place = walker.position() - scene_.origin();
    marks.body = graphics::BodyMark{place, walker.settings().radius, walker.report().height, walker.held()};
    const Vec3 eye = osgRoam::to_roam(osg::Matrixd::inverse(view()).getTrans()) - place;
    marks.body->inside = std::hypot(eye.x, eye.y) < marks.body->radius && std::abs(eye.z) < 0.5 * marks.body->height;
    for (const Contact& contact : walker.report().contacts) {
      if (!contact.unknown) marks.contacts.push_back({contact.point - scene_.origin(), contact.normal});
    }
    marks.triangles = triangles_near(scene_.group(), walker.body(), place);
  }
  light(has_body);
  stage_.overlay().set_marks(marks);
  show_labels(marks.labels);
}

osg::Matrixd Display::view() const {
  osgViewer::Viewer& viewer = stage_.viewer();
  const auto* const leading = viewer.getCameraManipulator();
  return leading != nullptr ? leading->getInverseMatrix() : viewer.getCamera()->getViewMatrix();
}

std::optional<Sightline> Display::middle() const {
  return sightline({view(), stage_.viewer().getCamera()->getProjectionMatrix(), scene_.origin()}, 0.0, 0.0);
}

void Display::light(bool has_body) {
  // Pages of other formats are photogrammetry, which takes no shadows.
  sun_.set_shadows(!scene_.is_paged() || scene_.pages().by_error());
  if (has_body) {
    const Vec3 eye = osgRoam::to_roam(osg::Matrixd::inverse(view()).getTrans()) + scene_.origin();
    sun_.set_outdoors(daylight_.follow(open_sky(roamer_.walker()->space(), eye), stage_.now() - lit_at_));
  }
  lit_at_ = stage_.now();
}

/// Puts the labels to their places in the picture of the next frame.
void Display::show_labels(const std::vector<graphics::LabelMark>& labels) {
  const osg::Matrixd view = this->view();
  const osg::Matrixd projection = stage_.viewer().getCamera()->getProjectionMatrix();
  std::vector<graphics::HudLabel> shown;
  for (const graphics::LabelMark& label : labels) {
    const osg::Vec3d eye = osgRoam::to_osg(label.at) * view;
    if (eye.z() >= 0.0) continue;  // behind the eye
    const osg::Vec3d at = eye * projection;
    const auto pixels = [](double share, int size) {
      return static_cast<float>(std::lround(0.5 * (1.0 + share) * size));
    };
    shown.push_back({label.text, pixels(at.x(), stage_.frame().width()), pixels(at.y(), stage_.frame().height())});
  }
  stage_.hud().set_labels(std::move(shown));
}

Pose Display::overview() const {
  const double across = 2.0 * glm::degrees(std::atan(std::tan(0.5 * glm::radians(fov_)) * aspect()));
  return app::overview(scene_.bounds(), std::min(fov_, across));
}

void Display::look_from(const Pose& pose) {
  const Vec3 ahead = gaze(glm::radians(pose.yaw), glm::radians(pose.pitch));
  const osg::Vec3d from = osgRoam::to_osg(pose.position - scene_.origin());
  stage_.viewer().getCamera()->setViewMatrixAsLookAt(from, from + osgRoam::to_osg(ahead), osg::Vec3d(0, 0, 1));
}

void Display::fill(ViewReport& report) {
  report.triangles = shown_.triangles;
  report.world_bytes = shown_.world_bytes;
  report.resident_bytes = resident_bytes();
  report.missing_pages = scene_.missing_pages();
  report.page_bytes = scene_.pages().bytes();
  if (!scene_.report()) return;
  const DisplayReport& display = *scene_.report();
  append(report.notes, display.notes);
  append(report.notes, display.import.notes);
  report.missing_textures = display.missing_textures;
  report.missing_texture_files = display.missing_texture_files;
  report.missing_pages += display.import.missing_pages;
}

}  // namespace roam::app
