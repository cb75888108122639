#include <algorithm>
#include <array>
#include <cmath>

#include "generate/gallery_parts.h"
#include "generate/scene.h"
#include "math/floating_point.h"

namespace roam::generate {
namespace {

std::vector<std::function<Part()>> parts_of(const GalleryOptions& options, const GalleryDetail& detail) {
  std::vector<std::function<Part()>> parts = upper_gallery(options, detail).parts;
  std::vector<std::function<Part()>> lower = lower_gallery(options, detail).parts;
  std::move(lower.begin(), lower.end(), std::back_inserter(parts));
  parts.push_back([=] { return dam(options, detail); });
  parts.push_back([=] { return ground(options, detail); });
  return parts;
}

Scene::Plan plan_of(const GalleryOptions& options, const GalleryDetail& detail) {
  auto parts = std::make_shared<const std::vector<std::function<Part()>>>(parts_of(options, detail));
  return {.parts = parts->size(), .part = [parts](std::uint64_t i) { return (*parts)[i](); }};
}

/// Sets the cell, and the rows that make the cells of the upper gallery square.
void set_cell(GalleryDetail& detail, double cell) {
  detail.cell = cell;
  detail.more_rows = static_cast<std::int64_t>(upper_axis(1.0).length() / cell);
}

/// Distances in metres between grottos, joints and drains. The first entry that leaves enough triangles is used.
struct Spacing {
  double grotto, joint, drain;
};
constexpr std::array<Spacing, 3> spacings{{{60.0, 15.0, 120.0}, {120.0, 60.0, 240.0}, {240.0, 120.0, 480.0}}};

constexpr double finest_cell = 0.01, coarsest_cell = 10.0;  // m

GalleryDetail roomy_detail(const GalleryOptions& options) {
  const double asked = static_cast<double>(options.triangles);
  constexpr double furniture_share = 0.8;  // the rest is for the walls of the gallery
  GalleryDetail detail{};
  for (const Spacing& spacing : spacings) {
    detail = {.cell = coarsest_cell,
              .grotto_spacing = spacing.grotto,
              .joint_spacing = spacing.joint,
              .drain_spacing = spacing.drain,
              .more_rows = 0,
              .dam_triangles = 0.02 * asked,
              .ground_triangles = 0.04 * asked};
    if (static_cast<double>(count(plan_of(options, detail)).triangles) <= furniture_share * asked) break;
  }
  return detail;
}

/// Chooses the finest cells that need no more triangles than requested, then adds rows to the gallery until the number
/// is met.
GalleryDetail detail_for(const GalleryOptions& options) {
  const double asked = static_cast<double>(options.triangles);
  GalleryDetail detail = roomy_detail(options);
  double fine = finest_cell, coarse = coarsest_cell;
  constexpr int halvings = 24;
  for (int i = 0; i < halvings; ++i) {
    const double cell = std::sqrt(fine * coarse);
    set_cell(detail, cell);
    const double made = static_cast<double>(count(plan_of(options, detail)).triangles);
    (made > asked ? fine : coarse) = cell;
  }
  set_cell(detail, coarse);
  constexpr int corrections = 3;  // rows within a door are also rows of its grotto, so one correction is not enough
  for (int i = 0; i < corrections; ++i) {
    const double missing = asked - static_cast<double>(count(plan_of(options, detail)).triangles);
    const double row = 2.0 * static_cast<double>(upper_gallery(options, detail).tube->section.columns.size());
    detail.more_rows = std::max<std::int64_t>(0, detail.more_rows + static_cast<std::int64_t>(missing / row));
  }
  return detail;
}

}  // namespace

Scene gallery(const GalleryOptions& options) {
  const DefaultFloatingPoint guard;
  check_options("gallery", options.triangles, options.origin);
  Scene::Plan plan = plan_of(options, detail_for(options));
  plan.bounds = gallery_bounds();
  plan.bounds.lower += options.origin;
  plan.bounds.upper += options.origin;
  return make_scene(std::move(plan));
}

}  // namespace roam::generate
