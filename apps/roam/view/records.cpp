#include "view/records.h"

#include <fmt/format.h>

#include "cli/exit_status.h"
#include "roam/error.h"
#include "scenes/frame.h"
#include "text/printable.h"
#include "view/body.h"
#include "view/cameras.h"
#include "view/settings.h"

namespace roam::app {

namespace {

/// "; B keeps one", naming the key for bookmarks; empty if no key is bound to them.
std::string remedy(const osgRoam::Manipulator& roamer) {
  const std::string key = key_of(roamer.controls(), "bookmark");
  return key.empty() ? key : fmt::format("; {} keeps one", key);
}

}  // namespace

Records::Records(const SceneOptions& scene, osgRoam::Manipulator& roamer, News& news)
    : roamer_(roamer), news_(news), frame_(frame_of(scene)) {
  const std::filesystem::path folder = settings_folder();
  try {
    bookmarks_.emplace(folder.empty() ? folder : folder / "bookmarks.json", scene.scenes, frame_.value_or(SceneFrame{}),
                       (scene.name_a_store() ? frame_ : usual_frame_of(scene)).value_or(SceneFrame{}));
  } catch (const Error& error) {
    problem_ = error;
    news_.note(error.what());
  }
}

Pose Records::named(const std::string& name) {
  if (!bookmarks_) throw Error(*problem_);
  if (const Bookmark* found = bookmarks_->find(name)) return found->pose;
  if (const std::optional<SceneFrame> other = bookmarks_->frame_elsewhere(name)) {
    throw UsageError(fmt::format("--bookmark {}", name),
                     fmt::format("it is of the scene with {}: use {}", options_of(*other),
                                 options_for(*other, frame_.value_or(SceneFrame{}))));
  }
  throw UsageError(fmt::format("--bookmark {}", name),
                   fmt::format("this scene has {}", bookmarks_->all().empty() ? "no bookmarks" + remedy(roamer_)
                                                                              : "these: " + bookmarks_->names()));
}

void Records::add_to(Commands& commands, Cameras& cameras) {
  cameras_ = &cameras;
  commands.add("bookmark", [this] { add_bookmark(); });
  commands.add("next_bookmark", [this](bool shift) { go_to_next_bookmark(shift); });
  commands.add("record", [this] { recorder_ ? finish() : record("roam.path", files::Naming::numbered); });
}

void Records::add_bookmark() {
  if (!bookmarks_) throw Error(*problem_);
  news_.tell("bookmark " + bookmarks_->add(standing_pose_of(roamer_)).name);
}

void Records::name_bookmark(const std::string& name, bool replaces) {
  if (!bookmarks_) throw Error(*problem_);
  bookmarks_->rename(name, replaces);
  news_.tell("bookmark " + bookmarks_->present()->name);
}

void Records::ask_name(Prompt& prompt) {
  const Bookmark* const present = bookmarks_ ? bookmarks_->present() : nullptr;
  if (present == nullptr) {
    news_.tell("there is no bookmark to name: keep one first");
    return;
  }
  // The number that stands for a name is none to begin with.
  const bool is_number = present->name.find_first_not_of("0123456789") == std::string::npos;
  ask_name(prompt, "Name of the bookmark", is_number ? "" : present->name, {});
}

/// `replaced`: the name of another bookmark, which the same answer replaces.
void Records::ask_name(Prompt& prompt, const std::string& question, const std::string& text,
                       const std::string& replaced) {
  prompt.ask(question, text, [this, &prompt, replaced](const std::string& typed) {
    const std::string name = typed;  // the prompt's, which another question changes
    try {
      if (bookmarks_->is_taken(name) && name != replaced) {
        ask_name(prompt, "Enter replaces the other bookmark of this name. Name", name, name);
      } else {
        name_bookmark(name, name == replaced);
      }
    } catch (const Error& error) {
      news_.note(error.what());
    }
  });
}

void Records::remove_bookmark(const std::string& name) {
  if (!bookmarks_) throw Error(*problem_);
  bookmarks_->remove(name);
  news_.tell("bookmark " + name + " is deleted");
}

std::vector<std::string> Records::bookmark_names() const {
  std::vector<std::string> names;
  if (!bookmarks_) return names;
  for (const Bookmark& bookmark : bookmarks_->all()) names.push_back(bookmark.name);
  return names;
}

std::vector<graphics::PlanPlace> Records::places() const {
  std::vector<graphics::PlanPlace> places;
  if (!bookmarks_) return places;
  for (const Bookmark& bookmark : bookmarks_->all()) {
    places.push_back({glm::dvec2(bookmark.pose.position), printable(bookmark.name)});
  }
  return places;
}

void Records::go_to_next_bookmark(bool backwards) {
  if (!bookmarks_ || bookmarks_->next(backwards) == nullptr) {
    news_.tell("this scene has no bookmarks yet" + remedy(roamer_));
    return;
  }
  go_to_present();
}

void Records::go_to_bookmark(const std::string& name) {
  if (bookmarks_ && bookmarks_->find(name) != nullptr) go_to_present();
}

void Records::go_to_present() {
  const Bookmark& bookmark = *bookmarks_->present();
  if (cameras_ != nullptr) cameras_->return_to_body();
  go_to(roamer_, bookmark.pose);
  news_.tell(fmt::format("bookmark {} ({} of {})", bookmark.name, bookmarks_->number(), bookmarks_->all().size()));
}

void Records::record(const std::filesystem::path& file, files::Naming naming) {
  recorder_.emplace(file, roamer_.settings(), roamer_.mode(), frame_, naming);
}

void Records::add_frame(double now) {
  if (!recorder_) return;
  const osg::Quat q = roamer_.getMatrix().getRotate();
  recorder_->add(now, roamer_.walker()->position(), {q.x(), q.y(), q.z(), q.w()}, roamer_.mode());
}

void Records::finish() {
  if (!recorder_) return;
  news_.written(recorder_->close());
  recorder_.reset();
}

void Records::fill(ViewReport& report) const { report.frame = frame_; }

void Records::fill(Status& status) const {
  if (!recorder_) return;
  status.recording = fmt::format("{:.1f} m, {:.0f} s", recorder_->length(), recorder_->seconds());
}

}  // namespace roam::app
