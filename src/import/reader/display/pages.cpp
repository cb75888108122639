#include "import/reader/display/pages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <osg/ComputeBoundsVisitor>
#include <osg/MatrixTransform>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <utility>

#include "roam/mesh.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// Time between parts of pages, so that the first picture does not wait for the last tile.
constexpr auto sending_interval = std::chrono::milliseconds(200);

class FindPages : public osg::NodeVisitor {
 public:
  FindPages(fs::path folder, const SceneFiles& files)
      : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), folder_(std::move(folder)), files_(files) {}

  void apply(osg::PagedLOD& lod) override {
    const fs::path named_from = lod.getDatabasePath().empty() ? folder_ : fs::path(lod.getDatabasePath());
    for (unsigned i = 0; i < lod.getNumFileNames() && !found_; ++i) {
      found_ = !lod.getFileName(i).empty() && !files_.find(named_from / lod.getFileName(i)).empty();
    }
    if (!found_) traverse(lod);
  }
  [[nodiscard]] bool found() const { return found_; }

 private:
  fs::path folder_;
  const SceneFiles& files_;
  bool found_ = false;
};

/// The transform from a file's frame to that of the scene.
osg::Matrixd to_scene(const MeshSink& sink) {
  const std::array<Vec3, 4> frame = sink.placement();
  osg::Matrixd matrix;
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 3; ++k) matrix(axis, k) = frame[static_cast<std::size_t>(axis) + 1][k];
  }
  matrix.setTrans(frame[0].x, frame[0].y, frame[0].z);
  return matrix;
}

/// The largest scale of a matrix along an axis.
double scale_of(const osg::Matrixd& matrix) {
  const osg::Vec3d scale = matrix.getScale();
  return std::max({std::abs(scale.x()), std::abs(scale.y()), std::abs(scale.z())});
}

Vec3 vec3(const osg::Vec3d& v) { return {v.x(), v.y(), v.z()}; }

bool is_place(const osg::Vec3d& v) {
  // False for a NaN.
  return std::abs(v.x()) <= coordinate_limit && std::abs(v.y()) <= coordinate_limit &&
         std::abs(v.z()) <= coordinate_limit;
}

/// False for a NaN.
bool is_length(double length) { return length >= 0.0 && length <= 2.0 * coordinate_limit; }

}  // namespace

bool refers_to_pages(osg::Node& root, const fs::path& file, const SceneFiles& files) {
  FindPages find(file.parent_path(), files);
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
  if (!box.valid() || !is_place(box._min) || !is_place(box._max) || !is_length(sphere.radius())) return false;

  const osg::Matrixd matrix = to_scene(sink_);
  Box bounds;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const osg::Vec3d v = box.corner(corner) * matrix;
    if (!is_place(v)) return false;
    bounds.include(vec3(v));
  }
  PageContext page;
  page.file = fs::absolute(file).lexically_normal();
  page.offset = sink_.offset();
  DisplayPages node;
  node.center = vec3(sphere.center() * matrix);
  node.radius = static_cast<float>(sphere.radius() * scale_of(matrix));
  node.levels.push_back({0.0f, std::numeric_limits<float>::max(), 0, token_of(page)});
  if (node.levels[0].page.empty() || !is_length(node.radius)) return false;

  const Vec3 center = bounds.center();
  const Vec3 origin = sink_.parts()->origin_near({&center, 1});
  const auto now = std::chrono::steady_clock::now();
  if (!graph_) {
    graph_.emplace(sink_.parts()->textures(), origin);
    begun_ = now;
  }
  graph_->add_pages(std::move(node), bounds);
  if (now - begun_ >= sending_interval) send();
  return true;
}

void Pages::send() {
  if (!graph_) return;
  sink_.parts()->send(*graph_);
  graph_.reset();
}

PageWalk::PageWalk(MeshSink& sink, const PageContext& page, PageStates& states)
    : SceneGraphWalk(sink), sink_(sink), page_(page), states_(states) {}

void PageWalk::walk(osg::Node& root) {
  const osg::ref_ptr<osg::MatrixTransform> above = new osg::MatrixTransform(page_.to_world);
  above->setName(page_.name);
  if (page_.state < states_.size()) above->setStateSet(states_[page_.state]);
  above->addChild(&root);
  SceneGraphWalk::walk(*above, page_.file);
}

void PageWalk::meet(osg::LOD& lod, osg::PagedLOD* paged) {
  if (paged == nullptr || !add(*paged)) SceneGraphWalk::meet(lod, paged);
}

bool PageWalk::is_replaced(const osg::LOD& lod) {
  // A page that is not loaded yet replaces nothing.
  return dynamic_cast<const osg::PagedLOD*>(&lod) == nullptr && SceneGraphWalk::is_replaced(lod);
}

std::uint32_t PageWalk::state_here() {
  osg::ref_ptr<osg::StateSet> state;
  for (const osg::Node* node : getNodePath()) {
    if (node->getStateSet() == nullptr) continue;
    if (state == nullptr) state = new osg::StateSet;
    state->merge(*node->getStateSet());
  }
  if (state == nullptr) return 0;
  if (states_.empty()) states_.emplace_back();
  // Neighbouring nodes inherit the same state.
  if (states_.back() == nullptr || states_.back()->compare(*state, true) != 0) states_.push_back(state);
  return static_cast<std::uint32_t>(states_.size() - 1);
}

bool PageWalk::add(osg::PagedLOD& lod) {
  bool named = false;
  for (unsigned i = lod.getNumChildren(); i < lod.getNumFileNames(); ++i) named = named || !lod.getFileName(i).empty();
  if (!named) return false;
  const bool stated = lod.getCenterMode() != osg::LOD::USE_BOUNDING_SPHERE_CENTER && lod.getRadius() >= 0;
  const osg::Matrixd matrix = to_world() * to_scene(sink_);
  const osg::Vec3d center = osg::Vec3d(lod.getCenter()) * matrix;
  const double scale = scale_of(matrix);
  const double radius = scale * static_cast<double>(stated ? lod.getRadius() : lod.getBound().radius());
  if (!is_place(center) || !is_length(radius)) return false;
  if (sink_.ignores(names())) return true;

  PartGraph& part = *sink_.parts()->page();
  const std::uint32_t group_before = sink_.parts()->group();
  DisplayPages node;
  node.group = group_before;
  node.center = vec3(center);
  node.radius = static_cast<float>(radius);
  const bool by_pixels = lod.getRangeMode() == osg::LOD::PIXEL_SIZE_ON_SCREEN;
  node.measure = by_pixels ? DisplayMeasure::pixels : DisplayMeasure::metres;
  const float range_scale = by_pixels ? 1.0f : static_cast<float>(scale);
  // A range with a NaN hides its child.
  const auto has_range = [&](unsigned i) { return i < lod.getNumRanges() && lod.getMinRange(i) < lod.getMaxRange(i); };
  std::vector<std::pair<osg::Node*, std::uint32_t>> shown;
  for (unsigned i = 0; i < lod.getNumChildren(); ++i) {
    if (!has_range(i)) continue;
    shown.emplace_back(lod.getChild(i), part.add_group());
    node.levels.push_back(
        {lod.getMinRange(i) * range_scale, lod.getMaxRange(i) * range_scale, shown.back().second, {}});
  }
  PageContext page;
  page.offset = page_.offset;
  page.to_world = to_world();
  for (const std::string& name : names()) page.name = name.empty() ? page.name : name;
  page.above = page_.above;
  page.above.push_back(hash_of(page_.file));
  page.state = state_here();
  for (unsigned i = lod.getNumChildren(); i < lod.getNumFileNames(); ++i) {
    if (lod.getFileName(i).empty() || !has_range(i)) continue;
    page.file = page_file(lod, i);
    std::string token = token_of(page);
    if (token.empty()) {
      sink_.report_missing_page(page.file.string());
      continue;
    }
    node.levels.push_back({lod.getMinRange(i) * range_scale, lod.getMaxRange(i) * range_scale, 0, std::move(token)});
  }
  part.add_pages(std::move(node), Box{vec3(center), vec3(center)});
  for (const auto& [child, group] : shown) {
    sink_.set_group(group);
    child->accept(*this);
  }
  sink_.set_group(group_before);
  return true;
}

}  // namespace roam::reader
