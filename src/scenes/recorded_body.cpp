#include "scenes/recorded_body.h"

#include <fmt/format.h>

#include <locale>
#include <sstream>
#include <string_view>
#include <vector>

#include "cli/standard_streams.h"
#include "files/path_lines.h"
#include "files/read_stream.h"
#include "files/whole_file.h"
#include "scenes/frame.h"
#include "text/printable.h"
#include "text/stream_of.h"

namespace roam::app {
namespace {

constexpr const char* mode_mark = "# roam: mode ";
constexpr const char* frame_mark = "# roam: frame ";

std::string describe(double radius, double height) {
  return height > 2.0 * radius ? fmt::format("radius {:g} m, height {:g} m", radius, height)
                               : fmt::format("a sphere of radius {:g} m", radius);
}

/// `after`: the line without its mark.
void add_to(std::optional<RecordedBody>& body, const std::string& line, const std::string& after) {
  std::istringstream words = stream_of(after);
  std::string word;
  words >> word;
  const std::optional<Mode> mode = mode_named(word);
  RecordedBody read;
  WalkerSettings& s = read.settings;
  bool good = mode.has_value();
  while (good && words >> word) {
    double* const value = word == "radius"    ? &s.radius
                          : word == "height"  ? &s.height
                          : word == "eye"     ? &s.eye
                          : word == "step"    ? &s.step
                          : word == "slope"   ? &s.slope_degrees
                          : word == "support" ? &s.support_radius
                                              : nullptr;
    good = value != nullptr && words >> *value;
  }
  if (!good) {
    throw Error(fmt::format("'{}' does not say a body as in '{}'; correct or remove the line", excerpt(line),
                            body_line({}, Mode::walk)));
  }
  if (!body) {
    try {
      check(s);
    } catch (const Error& error) {
      throw Error(fmt::format("{}; correct or remove the line", error.what()));
    }
    body = read;
    body->mode = *mode;
  }
  // Some places of a way that was partly flown can only be reached by flying.
  if (*mode != Mode::walk) body->mode = Mode::fly;
  body->ghost |= *mode == Mode::ghost;
}

void add_to(std::optional<SceneFrame>& frame, const std::string& line, const std::string& after) {
  const auto refuse = [&](const std::string& why) {
    throw Error(fmt::format("'{}' {}; correct or remove the line", excerpt(line), why));
  };
  std::istringstream words = stream_of(after);
  std::string up, axis, unit, length, more;
  words >> up >> axis >> unit >> length;
  SceneFrame read;
  try {
    read = {parse_up_axis(axis), parse_length_unit(length)};
  } catch (const Error&) {
    up.clear();
  }
  if (up != "up" || unit != "unit" || words >> more) refuse("does not say a frame as in '" + frame_line({}) + "'");
  if (frame && *frame != read) refuse("is a second frame");
  frame = read;
}

/// Collects the body, or the frame, from the marked lines of a path file. Keeps the first problem.
template <class Said>
class Marked {
 public:
  Marked(const char* mark, const std::string& name_of_file) : mark_(mark), name_of_file_(name_of_file) {}

  void add(std::string_view line, int number) {
    if (problem_ || !line.starts_with(mark_)) return;
    try {
      add_to(said_, std::string(line), std::string(line.substr(mark_.size())));
    } catch (const Error& error) {
      problem_.emplace(fmt::format("{}:{}", name_of_file_, number), error.what());
    }
  }
  /// Throws the problem.
  [[nodiscard]] const std::optional<Said>& all() const {
    if (problem_) throw Error(*problem_);
    return said_;
  }

 private:
  std::string_view mark_;
  const std::string& name_of_file_;
  std::optional<Said> said_;
  std::optional<Error> problem_;
};

}  // namespace

std::optional<Mode> mode_named(std::string_view name) {
  for (const Mode mode : {Mode::fly, Mode::walk, Mode::ghost}) {
    if (name == to_string(mode)) return mode;
  }
  return std::nullopt;
}

std::string frame_line(const SceneFrame& frame) {
  return fmt::format("{}up {} unit {}", frame_mark, to_string(frame.up), to_string(frame.unit));
}

void demand_frame(const RecordedPath& path, const std::optional<SceneFrame>& frame, const SceneOptions& scene) {
  if (!path.frame || !frame || *path.frame == *frame) return;
  const std::string here = options_of(*frame), there = options_of(*path.frame);
  throw Error(path.name,
              scene.name_a_store()
                  ? fmt::format("its places are of the scene with {}, and this store was built with {}: follow it in "
                                "the scene itself with {}, or in a store that is built so",
                                there, here, there)
                  : fmt::format("its places are of the scene with {}, which is read with {} here: use {}, or record "
                                "the path again",
                                there, here, options_for(*path.frame, *frame)));
}

std::string mode_line(Mode mode) { return fmt::format("{}{}", mode_mark, to_string(mode)); }

RecordedPath load_recorded_path(const std::filesystem::path& file) {
  RecordedPath path;
  if (file.empty()) return path;
  path.name = is_standard(file) ? "standard input" : file.string();
  Marked<RecordedBody> body(mode_mark, path.name);
  Marked<SceneFrame> frame(frame_mark, path.name);
  try {
    const files::Descriptor opened = is_standard(file) ? files::Descriptor() : files::open_named(file);
    files::ReadStream in(opened.is_open() ? opened.number() : STDIN_FILENO, path.name);
    path.places = read_path(in, path.name, [&](std::string_view line, int number) {
      body.add(line, number);
      frame.add(line, number);
    });
    path.frame = frame.all();
    path.body = body.all();
  } catch (const Error& error) {
    path.problem = error;
  }
  return path;
}

std::string compare(const RecordedBody& recorded, const WalkerSettings& settings, Mode mode) {
  if (recorded.ghost) return "the path was recorded, in part, by a ghost: walls may stand in its way";
  const WalkerSettings& body = recorded.settings;
  if (body.radius != settings.radius || body.height != settings.height) {
    return fmt::format("the path was recorded by another body: {}; this is {}", describe(body.radius, body.height),
                       describe(settings.radius, settings.height));
  }
  if (mode == Mode::walk && (body.step != settings.step || body.slope_degrees != settings.slope_degrees)) {
    return fmt::format(
        "the path was recorded by a body that steps {:g} m and climbs {:g} degrees; this one {:g} m and "
        "{:g} degrees",
        body.step, body.slope_degrees, settings.step, settings.slope_degrees);
  }
  if (mode == Mode::walk && body.support_radius != settings.support_radius) {
    return fmt::format("the path was recorded by a body with a support radius of {:g} m; this one has {:g} m",
                       body.support_radius, settings.support_radius);
  }
  if (recorded.mode == mode) return {};
  return fmt::format("the path was recorded in mode {}; this is mode {}", to_string(recorded.mode), to_string(mode));
}

}  // namespace roam::app
