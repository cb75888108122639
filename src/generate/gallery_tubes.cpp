#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generate/gallery_parts.h"
#include "generate/noise.h"

namespace roam::generate {
namespace {

// Lengths in metres. The cross-section is our own; the paper gives none.
constexpr double half_width = 1.5, spring = 2.0;  // a horseshoe, 3.5 m high at the crown
constexpr double gutter_edge = 1.3, gutter_depth = 0.15;
constexpr double joint_edge = 1.2, drain_edge = 0.6;
constexpr double block_foot = 0.4, block_face = 0.6;  // of the gate behind the corner, which leaves 1.2 m between its
                                                      // blocks
constexpr double wall_roughness = 0.025, floor_roughness = 0.0025;
constexpr double end_beyond_path = 6.0;
constexpr double bay = 60.0;  // length of one object of the gallery

// Indices of the corners of the upper section.
constexpr int floor_right = 2, joint_right = 3, drain_right = 4, joint_left = 5, floor_left = 6, left_foot = 9,
              left_block = 10, left_door_top = 11, left_spring = 12, right_spring = 13, right_block = 14,
              right_foot = 15;

std::vector<Section::Corner> upper_corners() {
  return {{-half_width, -gutter_depth},
          {-gutter_edge, -gutter_depth},
          {-gutter_edge, 0.0, floor_roughness},
          {-joint_edge, 0.0, floor_roughness, false},
          {drain_edge, 0.0, floor_roughness, false},
          {joint_edge, 0.0, floor_roughness, false},
          {gutter_edge, 0.0},
          {gutter_edge, -gutter_depth},
          {half_width, -gutter_depth},
          {half_width, 0.0, wall_roughness},
          {half_width, block_foot, wall_roughness, false},
          {half_width, gallery_door_height, wall_roughness, false},
          {half_width, spring, wall_roughness, false, true},
          {-half_width, spring, wall_roughness, false},
          {-half_width, block_foot, wall_roughness, false},
          {-half_width, 0.0}};
}

// Indices of the corners of the lower section.
constexpr int lower_right = 0, lower_left = 1, lower_door_top = 2;

std::vector<Section::Corner> lower_corners() {
  return {{-half_width, 0.0, floor_roughness},
          {half_width, 0.0, wall_roughness},
          {half_width, gallery_door_height, wall_roughness, false},
          {half_width, spring, wall_roughness, false, true},
          {-half_width, spring, wall_roughness, false}};
}

int layers(double depth, double cell) { return std::max(1, static_cast<int>(std::ceil(depth / cell))); }

/// A pocket cut into a tube, and its depth. Door openings are separate.
struct Pocket {
  Opening opening;
  Vec3 depth;
  std::string name;  // of its own object; if empty, it belongs to the segment
};

void add_pockets(Part& part, const std::shared_ptr<const Tube>& tube, const std::vector<Pocket>& pockets, double cell) {
  const Grid whole = tube_grid(tube, 0, static_cast<int>(tube->stations.size()) - 1);
  for (const Pocket& p : pockets) {
    const double depth = std::sqrt(p.depth.x * p.depth.x + p.depth.y * p.depth.y + p.depth.z * p.depth.z);
    add_pocket(part, whole, tube->hole(p.opening), p.depth, layers(depth, cell));
  }
}

/// Marks, openings and pockets of the upper gallery, added along it.
struct Layout {
  std::vector<double> marks;
  std::vector<Opening> openings;
  std::vector<Pocket> pockets;
  std::vector<Opening> doors;

  void open(const Opening& o) {
    marks.insert(marks.end(), {o.from, o.to});
    openings.push_back(o);
  }
  void pocket(const Opening& o, const Vec3& depth, std::string name = {}) {
    open(o);
    pockets.push_back({o, depth, std::move(name)});
  }
  void door(double center, int foot, int top) {
    doors.push_back({center - 0.5 * gallery_door_width, center + 0.5 * gallery_door_width, foot, top});
    open(doors.back());
  }
  void sort() {
    std::sort(marks.begin(), marks.end());
    marks.erase(std::unique(marks.begin(), marks.end()), marks.end());
    const auto before = [](const Opening& a, const Opening& b) { return a.from < b.from; };
    std::sort(openings.begin(), openings.end(), before);
    std::sort(pockets.begin(), pockets.end(),
              [&](const Pocket& a, const Pocket& b) { return before(a.opening, b.opening); });
  }
};

Layout lay_out(const Axis& axis, const GalleryDetail& detail, std::uint64_t seed) {
  Layout layout;
  const double corner = axis.corner(), end = axis.length();
  layout.marks = {0.0, corner, end};
  for (double s = bay; s < end - 3.0; s += bay) layout.marks.push_back(s);

  // Nothing else may lie at the arm, the mitre and the gate.
  const auto reserved = [&](double s) { return (s > corner - 6.5 && s < corner + 4.5) || s > end - 3.0; };
  const Vec3 right1 = -axis.left(0.0), right2 = -axis.left(end);
  const double arm_depth = 8.0, block_depth = half_width - block_face;
  layout.pocket({corner - 5.0, corner - 2.6, right_spring, right_foot}, right1 * arm_depth, "upper_gallery/corner_arm");
  layout.pocket({corner + 2.6, corner + 3.1, left_block, left_spring}, right2 * block_depth,
                "upper_gallery/corner_gate_left");
  layout.pocket({corner + 2.6, corner + 3.1, right_spring, right_block}, -right2 * block_depth,
                "upper_gallery/corner_gate_right");

  for (double s = 0.5 * bay; s < end; s += detail.grotto_spacing) {
    if (!reserved(s)) layout.door(s, left_foot, left_door_top);
  }
  int number = 0;
  for (double s = 7.5; s < end; s += detail.joint_spacing) {
    if (reserved(s)) continue;
    const double width = uniform(0.02, 0.05, seed, number, 1), depth = uniform(0.04, 0.08, seed, number, 2);
    layout.pocket({s, s + width, joint_right, joint_left}, {0.0, 0.0, -depth});
    ++number;
  }
  number = 0;
  for (double s = 48.0; s < end; s += detail.drain_spacing) {
    if (reserved(s)) continue;
    layout.pocket({s, s + 0.5, drain_right, joint_left}, {0.0, 0.0, -0.6}, fmt::format("drain_{:02}", number++));
  }
  layout.sort();
  return layout;
}

}  // namespace

Axis upper_axis(double blend) {
  const Path &p = gallery_paths[0], &q = gallery_paths[1];
  const Axis straight(p.from, p.to), second(q.from, q.to);
  return {p.from - straight.ahead(0.0) * end_beyond_path, p.to, q.to + second.ahead(0.0) * end_beyond_path, blend};
}

GalleryTube upper_gallery(const GalleryOptions& options, const GalleryDetail& detail) {
  constexpr double mitre_blend = 2.0;
  const Axis axis = upper_axis(mitre_blend);
  const Layout layout = lay_out(axis, detail, mix(options.seed ^ 0x01));
  const auto tube =
      std::make_shared<const Tube>(Tube{.axis = axis,
                                        .section = Section(upper_corners(), detail.cell),
                                        .stations = distribute(layout.marks, detail.more_rows),
                                        .openings = layout.openings,
                                        .floor = {{0.0, gallery_paths[0].from.z - gallery_floor_below_path}},
                                        .seed = mix(options.seed ^ 0x02),
                                        .origin = options.origin});

  GalleryTube gallery{tube, {}};
  const Section& section = tube->section;
  for (const bool last : {false, true}) {
    gallery.parts.push_back([tube, last, main_floor = columns_between(section, floor_right, floor_left),
                             crown = columns_between(section, left_foot, right_foot),
                             left = columns_between(section, floor_left, left_foot),
                             right = columns_between(section, right_foot, floor_right)] {
      std::vector<int> main = main_floor;
      main.insert(main.end(), crown.begin(), crown.end());
      const double gutter_y = 0.5 * (gutter_edge + half_width), gutter_z = -0.5 * gutter_depth;
      return Part{last ? "upper_gallery/end" : "upper_gallery/start",
                  {},
                  {bulkhead(tube, last, std::move(main), 0.0, half_width),
                   bulkhead(tube, last, left, gutter_y, gutter_z), bulkhead(tube, last, right, -gutter_y, gutter_z)}};
    });
  }
  int segment = 0;
  for (double s = 0.0; s < axis.length() - 3.0; s += bay) {
    const bool last = s + bay >= axis.length() - 3.0;
    const int row0 = index_of(tube->stations, s);
    const int row1 = last ? static_cast<int>(tube->stations.size()) - 1 : index_of(tube->stations, s + bay);
    std::vector<Pocket> joints;
    for (const Pocket& p : layout.pockets) {
      if (p.name.empty() && p.opening.from >= s && (last || p.opening.from < s + bay)) joints.push_back(p);
    }
    gallery.parts.push_back(
        [tube, row0, row1, joints, cell = detail.cell, name = fmt::format("upper_gallery/segment_{:03}", segment++)] {
          Part part{name, {tube_grid(tube, row0, row1)}, {}};
          add_pockets(part, tube, joints, cell);
          return part;
        });
  }
  for (const Pocket& p : layout.pockets) {
    if (p.name.empty()) continue;
    gallery.parts.push_back([tube, p, cell = detail.cell] {
      Part part{p.name, {}, {}};
      add_pockets(part, tube, {p}, cell);
      return part;
    });
  }
  for (std::size_t k = 0; k < layout.doors.size(); ++k) {
    add_grotto(gallery.parts, tube, layout.doors[k], fmt::format("grotto_{:02}", k), Furnishing::instruments,
               detail.cell, hash(options.seed, static_cast<std::int64_t>(k), 3));
  }
  return gallery;
}

GalleryTube lower_gallery(const GalleryOptions& options, const GalleryDetail& detail) {
  // Path 3 descends 1 m over 8.6 m. The ramp begins before it and ends after it, so that the whole path is on the ramp.
  constexpr double before = 30.0, behind = 8.0, ramp_beyond_path = 2.0;
  const Path& path = gallery_paths[2];
  const Axis line(path.from, path.to);
  const Vec3 ahead = line.ahead(0.0);
  const double length = line.length(), fall = path.from.z - path.to.z;
  const double margin = fall / length * ramp_beyond_path;
  const double top = path.from.z - gallery_floor_below_path + margin,
               foot = path.to.z - gallery_floor_below_path - margin;
  const double ramp0 = before - ramp_beyond_path, ramp1 = before + length + ramp_beyond_path;

  Layout layout;
  layout.marks = {0.0, ramp0, ramp1, before + length + behind};
  const double middle = before + 0.5 * length, half_split = 0.5 * gallery_split_width;
  layout.pocket({middle - half_split, middle + half_split, lower_right, lower_left}, {0.0, 0.0, -gallery_split_depth},
                "lower_gallery/split");
  layout.door(8.0, lower_left, lower_door_top);
  layout.door(20.0, lower_left, lower_door_top);
  layout.sort();

  const auto extra = static_cast<std::int64_t>((before + length + behind) / detail.cell);
  const auto tube =
      std::make_shared<const Tube>(Tube{.axis = Axis(path.from - ahead * before, path.to + ahead * behind),
                                        .section = Section(lower_corners(), detail.cell),
                                        .stations = distribute(layout.marks, extra),
                                        .openings = layout.openings,
                                        .floor = {{ramp0, top}, {ramp1, foot}},
                                        .seed = mix(options.seed ^ 0x04),
                                        .origin = options.origin});

  GalleryTube gallery{tube, {}};
  for (const bool last : {false, true}) {
    std::vector<int> outline(tube->section.columns.size());
    for (std::size_t k = 0; k < outline.size(); ++k) outline[k] = static_cast<int>(k);
    gallery.parts.push_back([tube, last, outline] {
      return Part{
          last ? "lower_gallery/end" : "lower_gallery/start", {}, {bulkhead(tube, last, outline, 0.0, half_width)}};
    });
  }
  gallery.parts.push_back([tube] {
    return Part{"lower_gallery/tube", {tube_grid(tube, 0, static_cast<int>(tube->stations.size()) - 1)}, {}};
  });
  gallery.parts.push_back([tube, split = layout.pockets.front(), cell = detail.cell] {
    Part part{split.name, {}, {}};
    add_pockets(part, tube, {split}, cell);
    return part;
  });
  for (std::size_t k = 0; k < layout.doors.size(); ++k) {
    add_grotto(gallery.parts, tube, layout.doors[k], fmt::format("lower_gallery/drainage_grotto_{}", k),
               Furnishing::sump, detail.cell, hash(options.seed, static_cast<std::int64_t>(k), 5));
  }
  return gallery;
}

}  // namespace roam::generate
