#include "roam/path_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <istream>
#include <string_view>

#include "files/path_lines.h"
#include "files/read_stream.h"
#include "files/whole_file.h"
#include "roam/error.h"
#include "text/byte_order_mark.h"
#include "text/printable.h"

namespace roam {
namespace {

// Metres, or seconds of a recording: no scene lies farther out (coordinate_limit).
constexpr double largest_number = 1e9;

constexpr std::size_t waypoint_numbers = 3;
constexpr std::size_t pose_numbers = 8;
constexpr const char* form = "a line is 'x y z' or 't x y z qx qy qz qw'";
constexpr std::string_view blanks = " \t\r\v\f";

/// The numbers of one line; more than pose_numbers are counted, not kept.
struct Numbers {
  std::array<double, pose_numbers> value{};
  std::size_t count = 0;
};

[[noreturn]] void fail(const std::string& name, int line, const std::string& what) {
  throw Error(fmt::format("{}:{}", name, line), what);
}

/// Lines of a text, and how many bytes they had.
class Lines {
 public:
  Lines(std::istream& in, const std::string& name) : in_(in), name_(name) {}

  /// The next line without its end; false when there is none.
  bool next(std::string_view& text) {
    ++number_;
    in_.getline(line_.data(), static_cast<std::streamsize>(line_.size()));
    const auto bytes = static_cast<std::size_t>(in_.gcount());
    bytes_ += bytes;
    if (bytes_ > longest_path_file) {
      throw Error(name_, fmt::format("is larger than {} MiB; is it the right file?", longest_path_file >> 20));
    }
    if (in_.bad()) throw Error(name_, "reading failed; check the disk and the file's permissions");
    if (in_.fail() && bytes > 0) {
      fail(name_, number_, fmt::format("the line is longer than {} bytes; {}", longest_path_line, form));
    }
    if (in_.fail()) return false;
    // The end of a line is counted, where there is one.
    text = {line_.data(), bytes - (in_.eof() ? 0 : 1)};
    return true;
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  std::istream& in_;
  const std::string& name_;
  std::array<char, longest_path_line + 1> line_;
  std::uint64_t bytes_ = 0;
  int number_ = 0;
};

Numbers parse(std::string_view text, const std::string& name, int line) {
  Numbers numbers;
  text = text.substr(0, text.find('#'));
  while (true) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return numbers;
    text.remove_prefix(begin);
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    // from_chars takes no leading plus, which printf-like writers leave before numbers.
    const bool has_plus = word.front() == '+' && !word.starts_with("+-");
    const std::string_view digits = has_plus ? word.substr(1) : word;
    double value = 0.0;
    const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (status == std::errc::invalid_argument || end != digits.data() + digits.size()) {
      fail(name, line, fmt::format("'{}' is no number; {}, '#' begins a comment", excerpt(word), form));
    }
    if (status != std::errc() || !std::isfinite(value)) {
      fail(name, line, fmt::format("'{}' is not a finite number; correct or remove the line", excerpt(word)));
    }
    if (std::abs(value) > largest_number) {
      fail(name, line, fmt::format("'{}' is beyond 1e9; correct or remove the line", excerpt(word)));
    }
    if (numbers.count < pose_numbers) numbers.value[numbers.count] = value;
    ++numbers.count;
    text.remove_prefix(word.size());
  }
}

Waypoint waypoint(const Numbers& numbers, const std::string& name, int line) {
  const auto& v = numbers.value;
  if (numbers.count == waypoint_numbers) return {{v[0], v[1], v[2]}, std::nullopt, line};
  if (numbers.count == pose_numbers) return {{v[1], v[2], v[3]}, PathPose{v[0], {v[4], v[5], v[6], v[7]}}, line};
  fail(name, line,
       fmt::format("found {} numbers; a waypoint has 3 (x y z), a line of osgViewer's path has 8 (t x y z qx qy qz qw)",
                   numbers.count));
}

void demand_name(const std::filesystem::path& file) {
  if (file.empty()) throw Error("the path file has no name; say which file is meant");
}

}  // namespace

std::vector<Waypoint> read_path(std::istream& in, const std::string& name) { return read_path(in, name, {}); }

std::vector<Waypoint> read_path(std::istream& in, const std::string& name, const OnComment& on_comment) {
  std::vector<Waypoint> path;
  Lines lines(in, name);
  for (std::string_view text; lines.next(text);) {
    const int line = lines.number();
    if (line == 1) text = without_byte_order_mark(text);
    if (on_comment && text.starts_with('#')) on_comment(text, line);
    const Numbers numbers = parse(text, name, line);
    if (numbers.count == 0) continue;
    const Waypoint next = waypoint(numbers, name, line);
    if (!path.empty()) {
      const Waypoint& last = path.back();
      if (last.pose.has_value() != next.pose.has_value()) {
        fail(name, line,
             fmt::format(
                 "waypoints 'x y z' and lines 't x y z qx qy qz qw' are mixed (the other kind is in line {}); use "
                 "one kind in a file",
                 last.line));
      }
      if (next.pose && next.pose->time < last.pose->time) {
        fail(name, line, fmt::format("the time runs backwards (line {} is later); sort the lines by time", last.line));
      }
    }
    if (path.size() == most_waypoints) {
      fail(name, line,
           fmt::format("holds more than {} waypoints; leave some out, or go along it in parts", most_waypoints));
    }
    path.push_back(next);
  }
  if (path.size() < 2) {
    throw Error(name, fmt::format("holds {}; a path needs a start and at least one place to go to, one 'x y z' a line",
                                  path.empty() ? "no waypoint" : "only one waypoint"));
  }
  return path;
}

std::vector<Waypoint> load_path(const std::filesystem::path& file) {
  demand_name(file);
  const files::Descriptor opened = files::open_named(file);
  files::ReadStream in(opened.number(), file);
  return read_path(in, file.string());
}

std::string body_line(const WalkerSettings& s, Mode mode) {
  std::string line = fmt::format("# roam: mode {} radius {} height {} eye {} step {} slope {}", to_string(mode),
                                 s.radius, s.height, s.eye, s.step, s.slope_degrees);
  if (s.support_radius > 0.0) line += fmt::format(" support {}", s.support_radius);
  return line;
}

void save_path(const std::filesystem::path& file, std::span<const Vec3> path, const WalkerSettings* body, Mode mode) {
  demand_name(file);
  if (path.size() < 2 || path.size() > most_waypoints)
    throw Error::at(
        file.string(),
        fmt::format("cannot write {}: a path needs a start and at least one place to go to, at most {} in all, "
                    "and this one has {} places",
                    file.string(), most_waypoints, path.size()));
  std::string text;
  if (body != nullptr) text = body_line(*body, mode) + "\n";
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec3& p = path[i];
    for (int k = 0; k < 3; ++k) {
      if (!(std::abs(p[k]) <= largest_number))
        throw Error::at(
            file.string(),
            fmt::format("cannot write {}: place {} is ({:g}, {:g}, {:g}); it must be finite and within 1e9 m of "
                        "the origin",
                        file.string(), i, p.x, p.y, p.z));
    }
    text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  }
  files::write_whole(file, text, files::Naming::beside);
}

std::vector<Vec3> positions(const std::vector<Waypoint>& path) {
  std::vector<Vec3> places;
  places.reserve(path.size());
  for (const Waypoint& waypoint : path) places.push_back(waypoint.position);
  return places;
}

}  // namespace roam
