// What keys and people ask a session for.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "roam/error.h"
#include "text/printable.h"
#include "view/session.h"
#include "view/session_handler.h"

namespace roam::app {
namespace {

constexpr double news_seconds = 6.0;     // at least
constexpr double letter_seconds = 0.07;  // to read a long sentence
constexpr std::size_t most_news = 4;     // lines at a time

void erase_where_a_path_begins(std::string& text, const std::string& folder) {
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder, at)) {
    const bool begins = at == 0 || std::string_view(" '\"(`").find(text[at - 1]) != std::string_view::npos;
    if (begins) {
      text.erase(at, folder.size());
    } else {
      ++at;
    }
  }
}

}  // namespace

bool SessionHandler::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& /*action*/) {
  if (event.getEventType() == osgGA::GUIEventAdapter::CLOSE_WINDOW) {
    session_.run(Command::quit);
    return false;
  }
  const bool down = event.getEventType() == osgGA::GUIEventAdapter::KEYDOWN;
  const bool up = event.getEventType() == osgGA::GUIEventAdapter::KEYUP;
  const int key = event.getUnmodifiedKey() != 0 ? event.getUnmodifiedKey() : event.getKey();
  if ((down || up) && !event.getHandled() && key == osgGA::GUIEventAdapter::KEY_Escape) return handle_escape(down);
  if (!down || event.getHandled() || session_.roamer_leads()) return false;
  const bool ctrl = (event.getModKeyMask() & osgGA::GUIEventAdapter::MODKEY_CTRL) != 0;
  const auto* command = session_.roamer().controls().lookup(key, ctrl);
  if (command == nullptr || parse_command(command->name) == Command::none) return false;
  session_.run(parse_command(command->name));
  return true;
}

bool SessionHandler::handle_escape(bool down) {
  // The settings may want it for something else.
  const auto* command = session_.roamer().controls().lookup(osgGA::GUIEventAdapter::KEY_Escape, false);
  if (command != nullptr && command->name != "release") return false;
  if (down) {
    // A key that stays down is pressed again and again.
    escape_spent_ |= session_.escape();
  } else if (!std::exchange(escape_spent_, false)) {
    session_.run(Command::quit);
  }
  return true;
}

bool Session::escape() {
  if (stage_->hud().help_shown()) {
    stage_->hud().show_help(false);
  } else if (roamer_->mouseGrab()) {
    roamer_->setMouseGrab(false);
  } else {
    return false;
  }
  return true;
}

void Session::run(Command command) {
  try {
    switch (command) {
      case Command::help:
        stage_->hud().show_help(!stage_->hud().help_shown());
        break;
      case Command::hud:
        stage_->set_hud(stage_->hud_mode() == HudMode::full      ? HudMode::minimal
                        : stage_->hud_mode() == HudMode::minimal ? HudMode::off
                                                                 : HudMode::full);
        break;
      case Command::fullscreen:
        stage_->toggle_fullscreen();
        break;
      case Command::record:
        toggle_recording();
        break;
      case Command::picture:
        stage_->take_picture("roam.png");
        break;
      case Command::bookmark:
        add_bookmark();
        break;
      case Command::next_bookmark:
        next_bookmark(roamer_->down("fast"));
        break;
      case Command::marks:
        marks_ = !marks_;
        break;
      case Command::store:
        toggle_building();
        break;
      case Command::adapt:
        lesson_wanted_ = true;
        break;
      case Command::quit:
        quits_ = true;
        break;
      case Command::none:
        break;
    }
  } catch (const Error& error) {
    note(error.what());
  }
  status_at_ = -1.0;
}

void Session::tell(std::string news, bool warning) {
  // Who looks at the scene knows where it is.
  for (const auto& scene : options_.scene.scenes) {
    for (const auto& path : {std::filesystem::absolute(scene), scene}) {
      const std::string folder = path.parent_path().string() + "/";
      if (folder != "/") erase_where_a_path_begins(news, folder);
    }
  }
  news = printable(news, longest_sentence);
  const double seconds = std::max(news_seconds, letter_seconds * static_cast<double>(news.size()));
  news_.push_back({{std::move(news), warning}, now_ + seconds});
  if (news_.size() > most_news) news_.erase(news_.begin());
}

void Session::note(std::string sentence) {
  tell(sentence, true);
  // The report keeps each sentence once, however often it was told.
  if (std::find(notes_.begin(), notes_.end(), sentence) == notes_.end()) notes_.push_back(std::move(sentence));
}

void Session::written(const std::filesystem::path& file) {
  tell("written: " + file.string());
  written_.push_back(file.string());
}

void Session::toggle_recording() {
  if (recorder_) {
    written(recorder_->close());
    recorder_.reset();
  } else if (placed_) {
    recorder_.emplace("roam.path", roamer_->settings(), roamer_->mode(), files::Naming::numbered);
  }
}

void Session::record_way() {
  if (!recorder_) return;
  const osg::Quat q = roamer_->getMatrix().getRotate();
  recorder_->add(now_, roamer_->walker()->position(), {q.x(), q.y(), q.z(), q.w()}, roamer_->mode());
}

void Session::add_bookmark() {
  if (!placed_) return;
  if (!bookmarks_) throw Error(bookmark_problem_);
  Pose here = pose();
  // Of the standing body, as all places that one asks for: who crouches has the feet there.
  here.position = roamer_->walker()->feet() + Vec3(0.0, 0.0, 0.5 * roamer_->settings().height);
  tell(fmt::format("bookmark {}", bookmarks_->add(here).name));
}

void Session::next_bookmark(bool backwards) {
  if (!placed_) return;
  const std::size_t count = bookmarks_ ? bookmarks_->all().size() : 0;
  if (count == 0) {
    tell("this scene has no bookmarks yet; the key B keeps one");
    return;
  }
  bookmark_ = bookmark_ >= count ? (backwards ? count - 1 : 0) : (bookmark_ + (backwards ? count - 1 : 1)) % count;
  const Bookmark& bookmark = bookmarks_->all()[bookmark_];
  go_to(bookmark.pose);
  tell(fmt::format("bookmark {}", bookmark.name));
}

}  // namespace roam::app
