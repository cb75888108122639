#include <algorithm>
#include <cstdio>
#include <optional>
#include <osg/Camera>
#include <osg/Geode>
#include <osg/Notify>
#include <osg/PolygonMode>
#include <osgGA/KeySwitchMatrixManipulator>
#include <osgText/Text>
#include <osgViewer/Renderer>
#include <osgViewer/Viewer>
#include <utility>

#include "osgRoam/StatusHandler.h"
#include "osgroam/held.h"

namespace osgRoam {
namespace {

using Adapter = osgGA::GUIEventAdapter;

std::string status_of(const Manipulator& roamer) {
  std::string held = why_held(roamer);
  if (!held.empty()) return held;
  char speed[32];
  std::snprintf(speed, sizeof speed, "%.3g m/s", roamer.speed());
  return std::string(roam::to_string(roamer.mode())) + ", " + speed;
}

}  // namespace

struct StatusHandler::State {
  osg::ref_ptr<Manipulator> roamer;
  bool shown = true;
  std::string line;
  std::optional<double> held_since;  ///< seconds
  bool told = false;
  osg::ref_ptr<osg::Camera> camera;
  osg::ref_ptr<osgText::Text> text;

  /// Whether the manipulator is the camera of the view.
  [[nodiscard]] bool leads(osgGA::GUIActionAdapter& viewer) const {
    const auto* const view = dynamic_cast<osgViewer::View*>(viewer.asView());
    const osgGA::CameraManipulator* camera_of_view = view != nullptr ? view->getCameraManipulator() : nullptr;
    while (const auto* all = dynamic_cast<const osgGA::KeySwitchMatrixManipulator*>(camera_of_view)) {
      camera_of_view = all->getCurrentMatrixManipulator();
    }
    return camera_of_view == roamer.get();
  }

  /// Once, when it lasts.
  void tell_held(double time, bool is_leading) {
    constexpr double patience = 1.0;  // s
    const std::string why = is_leading ? why_held(*roamer) : std::string();
    if (why.empty()) {
      held_since.reset();
      told = false;
    } else if (!held_since) {
      held_since = time;
    } else if (!told && time - *held_since >= patience) {
      told = true;
      OSG_NOTICE << "osgRoam: " << why << std::endl;
    }
  }

  void show(osgGA::GUIActionAdapter& viewer, double time) {
    std::string now = leads(viewer) ? status_of(*roamer) : std::string();
    tell_held(time, !now.empty());
    const bool is_new = now != line || !camera;
    line = std::move(now);
    if (!camera) attach(viewer);
    if (!camera) return;
    camera->setNodeMask(shown && !line.empty() ? ~0u : 0u);
    place(*camera->getViewport());
    if (!is_new) return;
    text->setText(line, osgText::String::ENCODING_UTF8);
    viewer.requestRedraw();
  }

  /// The first camera of the view that draws into a window; null if there is none.
  static osg::Camera* shown_by(osg::View& view) {
    const auto is_shown = [](osg::Camera* one) {
      return one != nullptr && one->getViewport() != nullptr &&
             dynamic_cast<osgViewer::GraphicsWindow*>(one->getGraphicsContext()) != nullptr;
    };
    if (is_shown(view.getCamera())) return view.getCamera();
    for (unsigned i = 0; i < view.getNumSlaves(); ++i) {
      if (osg::Camera* slave = view.getSlave(i)._camera.get(); is_shown(slave)) return slave;
    }
    return nullptr;
  }

  /// Draws over the view.
  void attach(osgGA::GUIActionAdapter& viewer) {
    osg::View* const view = viewer.asView();
    osg::Camera* const below = view != nullptr ? shown_by(*view) : nullptr;
    if (below == nullptr) return;
    camera = new osg::Camera;
    camera->setName("osgRoam status");
    camera->setRenderer(new osgViewer::Renderer(camera));
    camera->setGraphicsContext(below->getGraphicsContext());
    camera->setViewport(new osg::Viewport(*below->getViewport()));
    camera->setRenderOrder(osg::Camera::POST_RENDER, 10);
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setViewMatrix(osg::Matrix::identity());
    camera->setClearMask(0);
    camera->setAllowEventFocus(false);
    camera->setProjectionResizePolicy(osg::Camera::FIXED);
    osg::StateSet& state = *camera->getOrCreateStateSet();
    state.setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    state.setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    state.setMode(GL_BLEND, osg::StateAttribute::ON);
    // Other handlers draw the view in wires.
    state.setAttribute(new osg::PolygonMode, osg::StateAttribute::PROTECTED);
    text = new osgText::Text;
    text->setFont(osgText::Font::getDefaultFont());
    text->setDataVariance(osg::Object::DYNAMIC);
    text->setColor(osg::Vec4(1, 1, 1, 1));
    text->setDrawMode(osgText::Text::TEXT | osgText::Text::FILLEDBOUNDINGBOX);
    text->setBoundingBoxColor(osg::Vec4(0, 0, 0, 0.6f));
    text->setBoundingBoxMargin(4.0f);
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(text);
    camera->addChild(geode);
  }

  void place(const osg::Viewport& window) {
    constexpr double lines = 40.0, least = 14.0;  // of the text in the window's height; pixels
    const auto size = static_cast<float>(std::max(window.height() / lines, least));
    if (size == text->getCharacterHeight() && camera->getProjectionMatrix()(0, 0) == 2.0 / window.width()) return;
    camera->setProjectionMatrixAsOrtho2D(0, window.width(), 0, window.height());
    text->setCharacterSize(size);
    text->setPosition(osg::Vec3(size, size, 0));
  }
};

StatusHandler::StatusHandler(osg::ref_ptr<Manipulator> roamer) : _state(std::make_unique<State>()) {
  _state->roamer = std::move(roamer);
}

StatusHandler::~StatusHandler() = default;

void StatusHandler::setShown(bool on) { _state->shown = on; }

bool StatusHandler::shown() const { return _state->shown; }

const std::string& StatusHandler::text() const { return _state->line; }

bool StatusHandler::handle(const Adapter& event, osgGA::GUIActionAdapter& viewer) {
  switch (event.getEventType()) {
    case Adapter::FRAME:
      _state->show(viewer, event.getTime());
      return false;
    case Adapter::KEYDOWN:
      return !event.getHandled() && _state->leads(viewer) && _state->roamer->handle(event, viewer);
    default:
      return false;
  }
}

}  // namespace osgRoam
