#include "view/path_recorder.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <span>
#include <string>

#include "cli/output_file.h"
#include "roam/error.h"
#include "scenes/recorded_body.h"

namespace roam::app {
namespace {

constexpr double period = 0.1;  // s: a person's shorter movements need no line

}  // namespace

PathRecorder::PathRecorder(const std::filesystem::path& file, const WalkerSettings& body, Mode mode,
                           const std::optional<SceneFrame>& frame, files::Naming naming)
    : out_(file, naming, paths()), mode_(mode) {
  write(body_line(body, mode) + "\n");
  if (frame) write(frame_line(*frame) + "\n");
  write("# t x y z qx qy qz qw: seconds, the body's centre in metres, the camera's rotation\n");
}

PathRecorder::~PathRecorder() {
  try {
    if (!closed_) close();
  } catch (...) {  // the first error is the one to report
  }
}

void PathRecorder::add(double time, const Vec3& position, const std::array<double, 4>& rotation, Mode mode) {
  if (mode != mode_) write(mode_line(mode) + "\n");
  mode_ = mode;
  if (empty_) begin_ = time;
  const Line line{time, position, rotation};
  if (empty_) {
    write(line);
    last_ = line;
    return;
  }
  length_ += glm::distance(position, last_.position);
  const auto differ = [](const Line& a, const Line& b) { return a.position != b.position || a.rotation != b.rotation; };
  if (time - written_.time >= period && differ(line, written_)) {
    // After a rest, the path continues where and when the rest ended.
    if (last_.time > written_.time && !differ(last_, written_)) write(last_);
    write(line);
  }
  last_ = line;
}

void PathRecorder::write(const Line& line) {
  const Vec3& p = line.position;
  const auto& q = line.rotation;
  write(fmt::format("{:.3f} {} {} {} {:.9g} {:.9g} {:.9g} {:.9g}\n", line.time - begin_, p.x, p.y, p.z, q[0], q[1],
                    q[2], q[3]));
  written_ = line;
  empty_ = false;
}

void PathRecorder::write(std::string_view text) {
  try {
    if (!failure_) out_.write(std::as_bytes(std::span(text)));
  } catch (const Error&) {
    failure_ = std::current_exception();
  }
}

std::filesystem::path PathRecorder::close() {
  closed_ = true;
  if (!empty_ && last_.time > written_.time) write(last_);
  if (failure_) std::rethrow_exception(failure_);
  return out_.commit();
}

}  // namespace roam::app
