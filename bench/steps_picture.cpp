#include "steps_picture.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "roam/error.h"

namespace roam::bench {
namespace {

// Sizes of the picture, in its own units.
constexpr double width = 640.0, height = 400.0, left = 70.0, right = 110.0, top = 40.0, bottom = 60.0;
constexpr double shortest = 1e-3;  // us: shorter times are drawn here

/// Powers of ten that an axis spans.
struct Span {
  int least = 0, greatest = 1;
  /// The position of a value on the axis, from 0 to 1.
  [[nodiscard]] double part(double value) const { return (std::log10(value) - least) / (greatest - least); }
};

Span span_of(double least, double greatest) {
  const int from = static_cast<int>(std::floor(std::log10(least)));
  return {from, std::max(from + 1, static_cast<int>(std::ceil(std::log10(greatest))))};
}

struct Axes {
  Span size, time;  // triangles, microseconds
  [[nodiscard]] double x(double triangles) const { return left + (width - left - right) * size.part(triangles); }
  [[nodiscard]] double y(double us) const {
    return height - bottom - (height - top - bottom) * time.part(std::max(us, shortest));
  }
};

Axes axes_of(const std::vector<StepTimes>& times) {
  double fewest = 1e18, most = 1.0, least = 1e18, greatest = shortest;
  for (const StepTimes& t : times) {
    fewest = std::min(fewest, static_cast<double>(t.triangles));
    most = std::max(most, static_cast<double>(t.triangles));
    least = std::min(least, t.median_us);
    greatest = std::max(greatest, t.p99_us);
  }
  return {span_of(fewest, most), span_of(std::max(least, shortest), greatest)};
}

void text(std::ostream& out, double x, double y, const char* anchor, const std::string& words) {
  out << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\">" << words << "</text>\n";
}

void grid(std::ostream& out, const Axes& axes) {
  out << "<g stroke=\"#ddd\">\n";
  for (int p = axes.size.least; p <= axes.size.greatest; ++p) {
    out << "<path d=\"M" << axes.x(std::pow(10.0, p)) << ' ' << top << 'V' << height - bottom << "\"/>\n";
  }
  for (int p = axes.time.least; p <= axes.time.greatest; ++p) {
    out << "<path d=\"M" << left << ' ' << axes.y(std::pow(10.0, p)) << 'H' << width - right << "\"/>\n";
  }
  out << "</g>\n";
  for (int p = axes.size.least; p <= axes.size.greatest; ++p) {
    text(out, axes.x(std::pow(10.0, p)), height - bottom + 20.0, "middle", "1e" + std::to_string(p));
  }
  for (int p = axes.time.least; p <= axes.time.greatest; ++p) {
    std::ostringstream us;
    us << std::pow(10.0, p);
    text(out, left - 8.0, axes.y(std::pow(10.0, p)) + 4.0, "end", us.str());
  }
  text(out, left + 0.5 * (width - left - right), height - 15.0, "middle", "triangles in the scene");
  text(out, 12.0, top - 18.0, "start", "microseconds a step");
}

void curve(std::ostream& out, const Axes& axes, const std::vector<StepTimes>& times, double StepTimes::*which,
           const char* colour, const char* name) {
  out << "<g stroke=\"" << colour << "\" fill=\"none\" stroke-width=\"2\">\n<path d=\"";
  for (std::size_t i = 0; i < times.size(); ++i) {
    out << (i == 0 ? 'M' : 'L') << axes.x(static_cast<double>(times[i].triangles)) << ' ' << axes.y(times[i].*which);
  }
  out << "\"/>\n";
  for (const StepTimes& t : times) {
    out << "<circle r=\"3\" cx=\"" << axes.x(static_cast<double>(t.triangles)) << "\" cy=\"" << axes.y(t.*which)
        << "\"/>\n";
  }
  out << "</g>\n<g fill=\"" << colour << "\">\n";
  const StepTimes& last = times.back();
  text(out, axes.x(static_cast<double>(last.triangles)) + 10.0, axes.y(last.*which) + 4.0, "start", name);
  out << "</g>\n";
}

}  // namespace

void write_picture(const std::string& file, const std::vector<StepTimes>& times) {
  std::ofstream out(file);
  out.precision(4);
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << ' ' << height
      << "\" font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"" << width << "\" height=\"" << height
      << "\" fill=\"white\"/>\n";
  const Axes axes = axes_of(times);
  grid(out, axes);
  curve(out, axes, times, &StepTimes::median_us, "#1f6fb4", "median");
  curve(out, axes, times, &StepTimes::p99_us, "#c1440e", "p99");
  out << "</svg>\n";
  out.close();
  if (!out) throw Error("cannot write " + file + "; check the folder's permissions and the free space");
}

}  // namespace roam::bench
