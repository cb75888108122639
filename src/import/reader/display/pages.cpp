#include "import/reader/display/pages.h"

#include <array>
#include <cmath>
#include <limits>
#include <osg/ComputeBoundsVisitor>
#include <osg/MatrixTransform>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <system_error>

#include "roam/world.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// Pages are sent so often that the first picture does not wait for the last tile.
constexpr auto sending_interval = std::chrono::milliseconds(200);

class FindPages : public osg::NodeVisitor {
 public:
  explicit FindPages(fs::path folder) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), folder_(std::move(folder)) {}

  void apply(osg::PagedLOD& lod) override {
    const fs::path named_from = lod.getDatabasePath().empty() ? folder_ : fs::path(lod.getDatabasePath());
    for (unsigned i = 0; i < lod.getNumFileNames() && !found_; ++i) {
      std::error_code none;
      found_ = !lod.getFileName(i).empty() && fs::is_regular_file(named_from / lod.getFileName(i), none);
    }
    if (!found_) traverse(lod);
  }
  [[nodiscard]] bool found() const { return found_; }

 private:
  fs::path folder_;
  bool found_ = false;
};

bool is_place(const osg::Vec3d& v) {
  // Written so that a NaN is none.
  return std::abs(v.x()) <= World::coordinate_limit && std::abs(v.y()) <= World::coordinate_limit &&
         std::abs(v.z()) <= World::coordinate_limit;
}

}  // namespace

bool refers_to_pages(osg::Node& root, const fs::path& file) {
  FindPages find(file.parent_path());
  root.accept(find);
  return find.found();
}

bool Pages::add(osg::Node& root, const fs::path& file) {
  osg::ComputeBoundsVisitor geometry;
  root.accept(geometry);
  osg::BoundingSphered sphere(osg::Vec3d(root.getBound().center()), root.getBound().radius());
  osg::BoundingBoxd box;
  if (geometry.getBoundingBox().valid()) box.expandBy(osg::BoundingBoxd(geometry.getBoundingBox()));
  if (!box.valid() && sphere.valid()) box.expandBy(sphere);
  if (!sphere.valid() && box.valid()) sphere.expandBy(box);
  if (!box.valid() || !is_place(box._min) || !is_place(box._max) || !std::isfinite(sphere.radius())) return false;

  const std::array<Vec3, 4> to_scene = sink_.placement();
  osg::Matrixd matrix;
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 3; ++k) matrix(axis, k) = to_scene[static_cast<std::size_t>(axis) + 1][k];
  }
  matrix.setTrans(to_scene[0].x, to_scene[0].y, to_scene[0].z);
  Box bounds;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const osg::Vec3d v = box.corner(corner) * matrix;
    if (!is_place(v)) return false;
    bounds.include(Vec3(v.x(), v.y(), v.z()));
  }

  const Vec3 center = bounds.center();
  const Vec3 origin = sink_.parts()->origin_near({&center, 1});
  matrix.postMultTranslate(osg::Vec3d(-origin.x, -origin.y, -origin.z));
  const osg::ref_ptr<osg::PagedLOD> page = new osg::PagedLOD;
  page->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
  page->setCenter(sphere.center());
  page->setRadius(static_cast<float>(sphere.radius()));
  page->setFileName(0, fs::absolute(file).lexically_normal().string());
  page->setRange(0, 0.0f, std::numeric_limits<float>::max());
  const osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
  transform->addChild(page);

  const auto now = std::chrono::steady_clock::now();
  if (!graph_) {
    graph_.emplace(sink_.parts()->textures(), origin);
    begun_ = now;
  }
  graph_->add(*transform);
  bounds_.include(bounds);
  if (now - begun_ >= sending_interval) send();
  return true;
}

void Pages::send() {
  if (!graph_) return;
  sink_.parts()->send(*graph_, bounds_, 0, true);
  graph_.reset();
  bounds_ = {};
}

}  // namespace roam::reader
