#include <chrono>
#include <condition_variable>
#include <mutex>
#include <osgDB/Registry>
#include <sstream>
#include <string>
#include <thread>
#include <utility>

#include "files/extension.h"
#include "files/mark.h"
#include "graphics/capture.h"

namespace roam::graphics {
namespace {

namespace fs = std::filesystem;

void check_extension(const fs::path& path) {
  const std::string extension = files::lower_extension(path);
  if (extension == ".png" || extension == ".jpg" || extension == ".jpeg") return;
  throw Error::at(path.string(),
                  "cannot write the picture " + path.string() + ": its name must end in .png, .jpg or .jpeg");
}

}  // namespace

fs::path write_image(const osg::Image& image, const fs::path& path, files::Naming naming) {
  check_extension(path);
  const std::string extension = files::lower_extension(path).substr(1);
  osgDB::ReaderWriter* const plugin = osgDB::Registry::instance()->getReaderWriterForExtension(extension);
  if (plugin == nullptr) {
    throw Error::at(path.string(), "cannot write the picture " + path.string() +
                                       ": OpenSceneGraph has no plugin for this kind of file");
  }
  std::ostringstream encoded;
  if (!plugin->writeImage(image, encoded, nullptr).success()) {
    throw Error::at(path.string(), "cannot write the picture " + path.string() + ": OpenSceneGraph cannot encode it");
  }
  std::string bytes = std::move(encoded).str();
  files::add_mark(bytes);
  return files::write_whole(path, bytes, naming, files::marked("picture"));
}

/// Shared by the caller, the drawing thread and the writing thread.
struct Screenshot::State {
  fs::path path;
  files::Naming naming = files::Naming::exact;
  std::mutex mutex;
  std::condition_variable changed;
  osg::ref_ptr<osg::Image> image;
  bool given_up = false, written = false;
  std::string refusal;  // why it was not drawn
  std::string problem;  // why there is no file
  std::thread writer;

  void give(osg::ref_ptr<osg::Image> taken) {
    const std::lock_guard lock(mutex);
    image = std::move(taken);
    changed.notify_all();
  }

  void refuse(const std::string& reason) {
    const std::lock_guard lock(mutex);
    refusal = reason;
    given_up = true;
    changed.notify_all();
  }

  ~State() { end(std::chrono::seconds(0)); }

  /// The writing thread, in which no exception would be caught.
  void run() noexcept {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return image || given_up; });
    std::string why;
    try {
      if (image) {
        lock.unlock();
        why = why_not_written();
      } else if (!refusal.empty()) {
        why = "cannot draw the picture " + path.string() + ": " + refusal;
      } else {
        why = "no picture was drawn for " + path.string();
      }
    } catch (const std::bad_alloc&) {
      why = "out of memory";  // short enough to need no allocation
    } catch (...) {
      why = "it failed";
    }
    if (!lock.owns_lock()) lock.lock();
    problem.swap(why);
    written = true;
    changed.notify_all();
  }

  [[nodiscard]] std::string why_not_written() {
    try {
      path = write_image(*image, path, naming);
    } catch (const Error& e) {
      return e.what();
    } catch (const std::exception& e) {
      return "cannot write the picture " + path.string() + ": " + e.what();
    }
    return "";
  }

  /// Waits for the picture for at most `patience`, then for the file.
  void end(std::chrono::seconds patience) {
    {
      std::unique_lock lock(mutex);
      if (!changed.wait_for(lock, patience, [&] { return image || written; })) given_up = true;
      changed.notify_all();
    }
    if (writer.joinable()) writer.join();
  }
};

void Screenshot::begin(fs::path path, files::Naming naming) {
  check_extension(path);
  state_->path = std::move(path);
  state_->naming = naming;
  // The thread does not own the state, because ~Screenshot waits for it. The request does, because its frame may come
  // later.
  state_->writer = std::thread([state = state_.get()] { state->run(); });
}

Screenshot::Screenshot(osg::ref_ptr<osg::Image> image, fs::path path, files::Naming naming)
    : state_(std::make_shared<State>()) {
  begin(std::move(path), naming);
  state_->give(std::move(image));
}

Screenshot::Screenshot(Frame& frame, fs::path path, bool with_hud, files::Naming naming)
    : state_(std::make_shared<State>()) {
  begin(std::move(path), naming);
  frame.request_picture(
      with_hud, [state = state_](osg::ref_ptr<osg::Image> image) { state->give(std::move(image)); },
      [state = state_](const std::string& reason) { state->refuse(reason); }, Finish::full);
}

Screenshot::~Screenshot() {
  if (state_) state_->end(std::chrono::seconds(0));
}

Screenshot::Screenshot(Screenshot&&) noexcept = default;

Screenshot& Screenshot::operator=(Screenshot&& other) noexcept {
  std::swap(state_, other.state_);
  return *this;
}

bool Screenshot::done() const {
  if (!state_) return true;
  const std::lock_guard lock(state_->mutex);
  return state_->written;
}

void Screenshot::finish(std::chrono::seconds patience) {
  if (!state_) return;
  state_->end(patience);
  if (!state_->problem.empty()) throw Error::at(state_->path.string(), state_->problem);
}

const fs::path& Screenshot::path() const {
  static const fs::path none;
  return state_ ? state_->path : none;
}

}  // namespace roam::graphics
