#include "steps_picture.h"

#include <cmath>
#include <fstream>

#include "roam/error.h"

namespace roam::bench {
namespace {

// Of the picture, in its own units.
constexpr double width = 640.0, height = 400.0, left = 70.0, right = 110.0, top = 40.0, bottom = 60.0;
// Powers of ten that the axes span: triangles, and microseconds.
constexpr int least_size = 5, greatest_size = 8, least_time = 0, greatest_time = 3;

double x_of(double triangles) {
  return left + (width - left - right) * (std::log10(triangles) - least_size) / (greatest_size - least_size);
}

double y_of(double us) {
  return height - bottom - (height - top - bottom) * (std::log10(us) - least_time) / (greatest_time - least_time);
}

void text(std::ostream& out, double x, double y, const char* anchor, const std::string& words) {
  out << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\">" << words << "</text>\n";
}

void grid(std::ostream& out) {
  out << "<g stroke=\"#ddd\">\n";
  for (int p = least_size; p <= greatest_size; ++p) {
    const double x = x_of(std::pow(10.0, p));
    out << "<path d=\"M" << x << ' ' << top << 'V' << height - bottom << "\"/>\n";
  }
  for (int p = least_time; p <= greatest_time; ++p) {
    const double y = y_of(std::pow(10.0, p));
    out << "<path d=\"M" << left << ' ' << y << 'H' << width - right << "\"/>\n";
  }
  out << "</g>\n";
  for (int p = least_size; p <= greatest_size; ++p) {
    text(out, x_of(std::pow(10.0, p)), height - bottom + 20.0, "middle", "1e" + std::to_string(p));
  }
  for (int p = least_time; p <= greatest_time; ++p) {
    text(out, left - 8.0, y_of(std::pow(10.0, p)) + 4.0, "end", std::to_string(std::lround(std::pow(10.0, p))));
  }
  text(out, left + 0.5 * (width - left - right), height - 15.0, "middle", "triangles in the scene");
  text(out, 12.0, top - 18.0, "start", "microseconds a step");
}

void curve(std::ostream& out, const std::vector<StepTimes>& times, double StepTimes::*which, const char* colour,
           const char* name) {
  out << "<g stroke=\"" << colour << "\" fill=\"none\" stroke-width=\"2\">\n<path d=\"";
  for (std::size_t i = 0; i < times.size(); ++i) {
    out << (i == 0 ? 'M' : 'L') << x_of(static_cast<double>(times[i].triangles)) << ' ' << y_of(times[i].*which);
  }
  out << "\"/>\n";
  for (const StepTimes& t : times) {
    out << "<circle r=\"3\" cx=\"" << x_of(static_cast<double>(t.triangles)) << "\" cy=\"" << y_of(t.*which)
        << "\"/>\n";
  }
  out << "</g>\n<g fill=\"" << colour << "\">\n";
  const StepTimes& last = times.back();
  text(out, x_of(static_cast<double>(last.triangles)) + 10.0, y_of(last.*which) + 4.0, "start", name);
  out << "</g>\n";
}

}  // namespace

void write_picture(const std::string& file, const std::vector<StepTimes>& times) {
  std::ofstream out(file);
  out.precision(4);
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << ' ' << height
      << "\" font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"" << width << "\" height=\"" << height
      << "\" fill=\"white\"/>\n";
  grid(out);
  curve(out, times, &StepTimes::median_us, "#1f6fb4", "median");
  curve(out, times, &StepTimes::p99_us, "#c1440e", "p99");
  out << "</svg>\n";
  out.close();
  if (!out) throw Error("cannot write " + file);
}

}  // namespace roam::bench
