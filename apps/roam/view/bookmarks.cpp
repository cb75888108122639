#include "view/bookmarks.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "files/descriptor.h"
#include "files/escaped.h"
#include "files/json_text.h"
#include "files/whole_file.h"
#include "roam/error.h"
#include "text/printable.h"

namespace roam::app {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw Error(file.string(), fmt::format("{}; correct the file, or move it away to begin a new one", what));
}

Json read(const std::filesystem::path& file) {
  std::error_code none;
  if (!std::filesystem::exists(file, none)) return Json::array();
  const std::string text = files::read_named(file, files::longest_json);
  Json document;
  try {
    document = files::parse_json(text);
  } catch (const Error& error) {
    fail(file, error.what());
  }
  if (!document.is_array()) fail(file, "must hold a list of scenes, [ ... ]");
  return document;
}

double number(const Json& value, const std::filesystem::path& file) {
  const double x = value.is_number() ? value.get<double>() : std::nan("");
  if (!std::isfinite(x)) fail(file, fmt::format("{} must be a number", excerpt(value.dump())));
  return x;
}

std::vector<Bookmark> bookmarks_of(const Json& scene, const std::filesystem::path& file) {
  std::vector<Bookmark> bookmarks;
  const Json list = scene.value("bookmarks", Json::array());
  if (!list.is_array()) fail(file, "\"bookmarks\" must be a list, [ ... ]");
  for (const Json& item : list) {
    const bool whole = item.is_object() && item.contains("name") && item["name"].is_string() &&
                       item.contains("position") && item["position"].is_array() && item["position"].size() == 3;
    if (!whole) fail(file, "a bookmark must have a \"name\" and a \"position\" [x, y, z]: " + excerpt(item.dump()));
    Bookmark bookmark;
    bookmark.name = item["name"].get<std::string>();
    for (int k = 0; k < 3; ++k) bookmark.pose.position[k] = number(item["position"][static_cast<std::size_t>(k)], file);
    bookmark.pose.yaw = number(item.value("yaw", Json(0.0)), file);
    bookmark.pose.pitch = number(item.value("pitch", Json(0.0)), file);
    bookmarks.push_back(std::move(bookmark));
  }
  return bookmarks;
}

/// The frame of a scene's entry.
SceneFrame frame_of(const Json& scene, const SceneFrame& usual, const std::filesystem::path& file) {
  SceneFrame frame = usual;
  const Json up = scene.value("up", Json("")), unit = scene.value("unit", Json(""));
  try {
    if (up != Json("")) frame.up = parse_up_axis(up.is_string() ? up.get<std::string>() : up.dump());
    if (unit != Json("")) frame.unit = parse_length_unit(unit.is_string() ? unit.get<std::string>() : unit.dump());
  } catch (const Error& error) {
    fail(file, printable(error.what()));
  }
  return frame;
}

Json to_json(const Bookmark& bookmark) {
  const Vec3& p = bookmark.pose.position;
  return {{"name", bookmark.name},
          {"position", {p.x, p.y, p.z}},
          {"yaw", bookmark.pose.yaw},
          {"pitch", bookmark.pose.pitch}};
}

std::vector<Bookmark>::iterator named(std::vector<Bookmark>& bookmarks, const std::string& name) {
  return std::find_if(bookmarks.begin(), bookmarks.end(), [&](const Bookmark& b) { return b.name == name; });
}

bool has(std::vector<Bookmark>& bookmarks, const std::string& name) {
  return named(bookmarks, name) != bookmarks.end();
}

}  // namespace

Bookmarks::Bookmarks(std::filesystem::path file, const std::vector<std::filesystem::path>& scenes,
                     const SceneFrame& frame, const SceneFrame& usual)
    : file_(std::move(file)), frame_(frame), usual_(usual) {
  for (const auto& scene : scenes) {
    std::error_code none;
    const std::filesystem::path absolute = std::filesystem::absolute(scene);
    const auto whole = std::filesystem::weakly_canonical(absolute, none);
    // JSON holds no bytes that are not UTF-8.
    scenes_.push_back(files::escaped((none ? absolute : whole).string(), [](char32_t) { return true; }));
  }
  const Json document = read(file_);
  for (const Json& scene : document) {
    if (!scene.is_object()) fail(file_, "each scene must be an object, { ... }");
    if (scene.value("scene", Json::array()) != Json(scenes_)) continue;
    const SceneFrame theirs = frame_of(scene, usual_, file_);
    std::vector<Bookmark> bookmarks = bookmarks_of(scene, file_);
    if (theirs == frame_) {
      bookmarks_.insert(bookmarks_.end(), bookmarks.begin(), bookmarks.end());
    } else {
      for (Bookmark& bookmark : bookmarks) elsewhere_.emplace_back(theirs, std::move(bookmark.name));
    }
  }
}

const Bookmark* Bookmarks::find(const std::string& name) {
  const auto found = named(bookmarks_, name);
  if (found == bookmarks_.end()) return nullptr;
  present_ = static_cast<std::size_t>(found - bookmarks_.begin());
  return &*found;
}

std::optional<SceneFrame> Bookmarks::frame_elsewhere(const std::string& name) const {
  const auto found =
      std::find_if(elsewhere_.begin(), elsewhere_.end(), [&](const auto& b) { return b.second == name; });
  if (found == elsewhere_.end()) return std::nullopt;
  return found->first;
}

const Bookmark* Bookmarks::next(bool backwards) {
  const std::size_t count = bookmarks_.size();
  if (count == 0) return nullptr;
  const std::size_t step = backwards ? count - 1 : 1;
  present_ = present_ ? (*present_ + step) % count : backwards ? count - 1 : 0;
  return &bookmarks_[*present_];
}

std::string Bookmarks::names() const {
  std::string text;
  for (const Bookmark& bookmark : bookmarks_) text += (text.empty() ? "" : ", ") + bookmark.name;
  return text;
}

/// Edits the scene's list with the changes of other sessions, and writes the file.
void Bookmarks::change(const std::function<void(std::vector<Bookmark>&)>& edit) {
  if (file_.empty()) throw Error("there is no folder for bookmarks: set HOME or XDG_CONFIG_HOME");
  std::error_code none;
  std::filesystem::create_directories(file_.parent_path(), none);
  // One after the other. A file system that cannot lock keeps nobody from writing.
  const files::Descriptor folder(::open(file_.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  static_cast<void>(files::again([&] { return ::flock(folder.number(), LOCK_EX); }));
  Json document = read(file_);
  const auto is_ours = [&](const Json& scene) {
    return scene.is_object() && scene.value("scene", Json::array()) == Json(scenes_) &&
           frame_of(scene, usual_, file_) == frame_;
  };
  auto ours = std::find_if(document.begin(), document.end(), is_ours);
  if (ours == document.end()) {
    document.push_back({{"scene", scenes_},
                        {"up", to_string(frame_.up)},
                        {"unit", to_string(frame_.unit)},
                        {"bookmarks", Json::array()}});
    ours = std::prev(document.end());
  }
  std::vector<Bookmark> bookmarks;
  for (Json& scene : document) {  // a file that a person put together may have several
    if (!is_ours(scene)) continue;
    const std::vector<Bookmark> more = bookmarks_of(scene, file_);
    bookmarks.insert(bookmarks.end(), more.begin(), more.end());
    scene["bookmarks"] = Json::array();
  }
  edit(bookmarks);
  Json list = Json::array();
  for (const Bookmark& bookmark : bookmarks) list.push_back(to_json(bookmark));
  (*ours)["bookmarks"] = list;
  files::write_whole(file_, document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  bookmarks_ = std::move(bookmarks);
}

const Bookmark& Bookmarks::add(const Pose& pose) {
  change([&](std::vector<Bookmark>& bookmarks) {
    Bookmark added{"1", pose};
    for (int number = 2; has(bookmarks, added.name); ++number) added.name = std::to_string(number);
    bookmarks.push_back(added);
  });
  present_ = bookmarks_.size() - 1;
  return bookmarks_.back();
}

void Bookmarks::rename(const std::string& name, bool replaces) {
  if (!present_) throw Error("there is no bookmark to name; keep one first");
  const std::string old = bookmarks_[*present_].name;
  if (name == old) return;
  change([&](std::vector<Bookmark>& bookmarks) {
    if (!replaces && has(bookmarks, name))
      throw Error(fmt::format("another bookmark has the name {}; take another", printable(name)));
    if (!has(bookmarks, old)) throw Error(fmt::format("the bookmark {} is no longer there", printable(old)));
    std::erase_if(bookmarks, [&](const Bookmark& b) { return b.name == name; });
    named(bookmarks, old)->name = name;
  });
  find(name);
}

bool Bookmarks::is_taken(const std::string& name) const {
  const auto is_other = [&](const Bookmark& b) { return b.name == name && &b != present(); };
  return std::any_of(bookmarks_.begin(), bookmarks_.end(), is_other);
}

void Bookmarks::remove(const std::string& name) {
  const std::string before = present_ ? bookmarks_[*present_].name : name;
  change([&](std::vector<Bookmark>& bookmarks) {
    std::erase_if(bookmarks, [&](const Bookmark& b) { return b.name == name; });
  });
  present_.reset();
  if (before != name) find(before);
}

}  // namespace roam::app
