#include "graphics/frame.h"

#include <algorithm>
#include <cmath>
#include <osg/ClipControl>
#include <osg/Depth>
#include <osg/StateSet>
#include <osg/Stats>
#include <osg/observer_ptr>

#include "graphics/pipeline.h"
#include "text/number.h"

namespace roam::graphics {
namespace {

/// Metres: the far plane that OpenSceneGraph uses for its own computations. An ordinary depth buffer ends there;
/// reversed depth has no end.
constexpr double believed_far = 1e7;
constexpr double largest_near = 1e3;
constexpr double radians = 3.14159265358979323846 / 180.0;
/// The colour where there is no sky.
const osg::Vec4 background(0.45f, 0.49f, 0.53f, 1.0f);

void check_near(double near) {
  if (near > 0.0 && near <= largest_near) return;
  throw Error("a near plane of " + number_text(near) + " m cannot be used: it must be in (0, 1000]");
}

void check_vertical_fov(double degrees) {
  if (degrees >= 10.0 && degrees <= 150.0) return;
  throw Error("a vertical field of view of " + number_text(degrees) +
              " degrees cannot be used: it must be in [10, 150]");
}

/// Keeps a flat camera the size of the picture.
class FollowPicture : public osg::NodeCallback {
 public:
  explicit FollowPicture(osg::Camera& picture) : picture_(&picture) {}
  void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
    osg::Camera& flat = *node->asCamera();
    osg::ref_ptr<osg::Camera> picture;
    if (!picture_.lock(picture)) return;
    const osg::Viewport& now = *picture->getViewport();
    if (flat.getViewport()->width() != now.width() || flat.getViewport()->height() != now.height()) {
      // Replaced, not changed, because another thread may be drawing with the old viewport.
      flat.setViewport(new osg::Viewport(0, 0, now.width(), now.height()));
      flat.setProjectionMatrixAsOrtho2D(0, now.width(), 0, now.height());
    }
    traverse(node, visitor);
  }

 private:
  osg::observer_ptr<osg::Camera> picture_;  // which owns this
};

osg::ref_ptr<osg::Group> make_space(bool reversed_depth) {
  osg::ref_ptr<osg::Group> space = new osg::Group;
  space->setName("space");
  osg::StateSet& state = *space->getOrCreateStateSet();
  state.setAttributeAndModes(new osg::Depth(reversed_depth ? osg::Depth::GEQUAL : osg::Depth::LEQUAL));
  if (reversed_depth) {
    state.setAttribute(new osg::ClipControl(osg::ClipControl::LOWER_LEFT, osg::ClipControl::ZERO_TO_ONE));
    state.setDefine("ROAM_REVERSED_DEPTH");
  }
  return space;
}

osg::ref_ptr<osg::Camera> make_flat(osg::Camera& picture) {
  osg::ref_ptr<osg::Camera> flat = new osg::Camera;
  flat->setName("flat");
  flat->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  flat->setRenderOrder(osg::Camera::POST_RENDER);
  flat->setClearMask(0);
  flat->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  flat->setCullingMode(osg::CullSettings::NO_CULLING);
  flat->setAllowEventFocus(false);
  flat->setViewMatrix(osg::Matrix::identity());
  flat->setViewport(new osg::Viewport(0, 0, picture.getViewport()->width(), picture.getViewport()->height()));
  flat->setProjectionMatrixAsOrtho2D(0, picture.getViewport()->width(), 0, picture.getViewport()->height());
  flat->addUpdateCallback(new FollowPicture(picture));
  osg::StateSet& state = *flat->getOrCreateStateSet();
  state.setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  state.setMode(GL_BLEND, osg::StateAttribute::ON);
  return flat;
}

}  // namespace

double near_limit(double radius, double vertical_fov, double aspect) {
  const double up = std::tan(0.5 * vertical_fov * radians);
  return radius / std::sqrt(1.0 + up * up * (1.0 + aspect * aspect));
}

Frame::Frame(osgViewer::Viewer& viewer, const Context& context, const FrameSettings& settings)
    : camera_(viewer.getCamera()), context_(context), settings_(settings) {
  check_near(settings.near);
  check_vertical_fov(settings.vertical_fov);
  if (settings.samples < 0) throw Error("a pixel cannot have " + std::to_string(settings.samples) + " samples");
  pipeline_ = new Pipeline(settings.reversed_depth && context.abilities.reversed_depth,
                           std::min(settings.samples, context.abilities.samples), settings.quality, context.headless);

  camera_->setGraphicsContext(context.window);
  camera_->setViewport(0, 0, context.width(), context.height());
  camera_->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  camera_->setProjectionResizePolicy(osg::Camera::HORIZONTAL);
  camera_->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  camera_->setClearColor(background);
  camera_->setClearDepth(pipeline_->reversed_depth() ? 0.0 : 1.0);
  pipeline_->attach(*camera_);
  project();

  root_ = new osg::Group;
  space_ = make_space(pipeline_->reversed_depth());
  flat_ = make_flat(*camera_);
  root_->addChild(space_);
  root_->addChild(flat_);
  viewer.setLightingMode(osg::View::NO_LIGHT);
  viewer.setSceneData(root_);
}

Frame::~Frame() = default;

osg::Group* Frame::root() const { return root_.get(); }
osg::Group* Frame::space() const { return space_.get(); }
osg::Camera* Frame::flat() const { return flat_.get(); }
const Context& Frame::context() const { return context_; }
int Frame::width() const { return static_cast<int>(camera_->getViewport()->width()); }
int Frame::height() const { return static_cast<int>(camera_->getViewport()->height()); }
double Frame::near() const { return settings_.near; }
double Frame::vertical_fov() const { return settings_.vertical_fov; }
void Frame::set_quality(Quality quality) { pipeline_->set_quality(quality); }
void Frame::set_edges(bool shown) { pipeline_->set_edges(shown); }
void Frame::set_timed(bool timed) { pipeline_->set_timed(timed); }
const FrameTimes& Frame::times() const { return pipeline_->times(); }
Quality Frame::quality() const { return pipeline_->quality(); }
Quality Frame::next_quality() const { return pipeline_->next_quality(); }
bool Frame::edges() const { return pipeline_->edges(); }
bool Frame::reversed_depth() const { return pipeline_->reversed_depth(); }

void Frame::count_draw_calls() { camera_->getStats()->collectStats("scene", true); }

int Frame::draw_calls() const {
  const osg::Stats& stats = *camera_->getStats();
  double sets = 0.0;
  stats.getAttribute(stats.getLatestFrameNumber(), "Visible number of PrimitiveSets", sets);
  return static_cast<int>(sets) + pipeline_->passes();
}

void Frame::project() {
  const osg::Viewport& window = part_ ? *window_ : *camera_->getViewport();
  const double fov = settings_.vertical_fov, aspect = window.width() / window.height();
  if (!part_) {
    camera_->setProjectionMatrixAsPerspective(fov, aspect, settings_.near, believed_far);
    return;
  }
  const PicturePart& p = *part_;
  const double whole_aspect = static_cast<double>(p.whole_width) / p.whole_height;
  // The corners of the whole picture are as near as those of the window.
  const double near = settings_.near * near_limit(1.0, fov, whole_aspect) / near_limit(1.0, fov, aspect);
  const double up = near * std::tan(0.5 * fov * radians), right = up * whole_aspect;
  const auto side = [](double half, int pixel, int pixels) { return half * (2.0 * pixel / pixels - 1.0); };
  camera_->setProjectionMatrixAsFrustum(side(right, p.x, p.whole_width), side(right, p.x + p.width, p.whole_width),
                                        side(up, p.y, p.whole_height), side(up, p.y + p.height, p.whole_height), near,
                                        believed_far);
}

void Frame::set_part(const std::optional<PicturePart>& part) {
  if (part) {
    if (!part_) window_ = camera_->getViewport();
    camera_->setViewport(new osg::Viewport(0, 0, part->width, part->height));
  } else if (part_) {
    camera_->setViewport(window_);
  }
  part_ = part;
  flat_->setNodeMask(part ? 0u : ~0u);
  pipeline_->set_whole_height(part ? part->whole_height : 0);
  project();
}

void Frame::set_near(double near) {
  check_near(near);
  settings_.near = near;
  project();
}

std::string Frame::lack() const {
  const bool samples = pipeline_->lacks_samples(), effects = pipeline_->lacks_effects();
  if (!samples && !effects) return {};
  return "the graphics driver cannot give " +
         (samples ? std::to_string(pipeline_->wished_samples()) + " samples a pixel" : std::string()) +
         (samples && effects ? " and " : "") + (effects ? "the effects" : "");
}

std::string Frame::describe() const {
  const bool wished = settings_.reversed_depth;
  std::string depth = "reversed 32-bit float depth";
  if (!reversed_depth()) {
    depth = "ordinary 24-bit depth, so that far things flicker";
    if (wished) depth += " (the driver lacks GL_ARB_clip_control or float depth buffers)";
  }
  const int samples = std::max(1, pipeline_->samples());
  std::string smoothness = samples > 1 ? std::to_string(samples) + " samples a pixel" : "1 sample a pixel";
  if (const std::string missing = lack(); !missing.empty()) smoothness += " (" + missing + ")";
  return context_.describe() + ", " + depth + ", " + smoothness;
}

void Frame::request_picture(bool with_hud, std::function<void(osg::ref_ptr<osg::Image>)> done,
                            std::function<void(const std::string&)> failed, Finish finish) {
  pipeline_->request(with_hud, finish, std::move(done), std::move(failed));
}

const char* depth_glsl() {
  // With reversed depth, z / w = near / distance, where near is that of the perspective matrix.
  return R"(#version 120
#pragma import_defines(ROAM_REVERSED_DEPTH)
vec4 roam_clip(vec4 eye) {
  vec4 clip = gl_ProjectionMatrix * eye;
#ifdef ROAM_REVERSED_DEPTH
  clip.z = gl_ProjectionMatrix[3][2] / (gl_ProjectionMatrix[2][2] - 1.0);
#endif
  return clip;
}
)";
}

}  // namespace roam::graphics
