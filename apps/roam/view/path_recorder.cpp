#include "view/path_recorder.h"

#include <fmt/format.h>

#include "roam/error.h"
#include "scenes/recorded_body.h"

namespace roam::app {
namespace {

constexpr double period = 0.1;  // s: what a person does in less is not a way of its own

}  // namespace

PathRecorder::PathRecorder(std::filesystem::path file, const WalkerSettings& body, Mode mode)
    : file_(std::move(file)), out_(file_), mode_(mode) {
  out_ << "# t x y z qx qy qz qw: seconds, the body's centre in metres, the camera's rotation\n"
       << body_line(body, mode) << '\n'
       << std::flush;
  if (!out_) throw Error(file_.string() + ": cannot be written; is its folder yours, and the disk not full?");
}

void PathRecorder::add(double time, const Vec3& position, const std::array<double, 4>& rotation, Mode mode) {
  if (mode != mode_) out_ << mode_line(mode) << '\n';
  mode_ = mode;
  if (empty_) begin_ = time;
  const Line line{time, position, rotation};
  if (empty_) {
    write(line);
    last_ = line;
    return;
  }
  const auto differ = [](const Line& a, const Line& b) { return a.position != b.position || a.rotation != b.rotation; };
  if (time - written_.time >= period && differ(line, written_)) {
    // After a rest, the way begins where and when the rest ended.
    if (last_.time > written_.time && !differ(last_, written_)) write(last_);
    write(line);
  }
  last_ = line;
}

void PathRecorder::write(const Line& line) {
  const Vec3& p = line.position;
  const auto& q = line.rotation;
  out_ << fmt::format("{:.3f} {} {} {} {:.9g} {:.9g} {:.9g} {:.9g}\n", line.time - begin_, p.x, p.y, p.z, q[0], q[1],
                      q[2], q[3])
       << std::flush;
  written_ = line;
  empty_ = false;
}

void PathRecorder::close() {
  if (!empty_ && last_.time > written_.time) write(last_);
  out_.close();
  if (!out_) throw Error(file_.string() + ": not everything could be written; is the disk full?");
}

std::filesystem::path unused_name(const std::filesystem::path& folder, const std::string& extension) {
  for (int number = 1;; ++number) {
    std::filesystem::path file = folder / fmt::format("roam-{}.{}", number, extension);
    std::error_code none;
    // A link that leads nowhere would be written through.
    if (!std::filesystem::exists(std::filesystem::symlink_status(file, none))) return file;
  }
}

}  // namespace roam::app
