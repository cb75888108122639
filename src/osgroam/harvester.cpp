#include "osgRoam/Harvester.h"

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>
#include <osgDB/FileNameUtils>
#include <set>
#include <utility>

#include "harvest_walk.h"

namespace osgRoam {
namespace {

constexpr std::size_t failed_names_limit = 100;

/// The files that led to a file, itself first.
struct Trail {
  std::string file;
  std::shared_ptr<const Trail> from;
};

bool holds(const Trail* trail, const std::string& file) {
  for (; trail != nullptr; trail = trail->from.get()) {
    if (trail->file == file) return true;
  }
  return false;
}

/// Stands in for what does not come. Several files may share one; the first that fails brings it.
struct Substitute {
  std::vector<roam::Mesh> meshes;
  bool used = false;
};

/// A place where a file is named.
struct Place {
  enum class State { waiting, being_taken, taken, failed };

  std::shared_ptr<const Trail> trail;
  osg::Matrixd to_scene;
  roam::Box box;
  roam::PatchId patch = roam::PatchId::none;    ///< what the file holds for good
  roam::PatchId refines = roam::PatchId::none;  ///< and takes the place of, with what it names
  std::shared_ptr<Substitute> substitute;
  bool is_named = true;  ///< else it is a root file
  State state = State::waiting;
};

roam::Box everywhere() {
  return {roam::Vec3(-roam::Space::coordinate_limit), roam::Vec3(roam::Space::coordinate_limit)};
}

roam::World build(const std::vector<roam::Mesh>& meshes) {
  roam::BuildOptions options;
  options.threads = 1;  // there are as many readers as there should be
  return roam::World::build(meshes, options);
}

/// The harvesters that this thread is reading for.
thread_local std::vector<const void*> reading;

class Reading {
 public:
  explicit Reading(const void* who) { reading.push_back(who); }
  ~Reading() { reading.pop_back(); }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
};

}  // namespace

struct Harvester::State {
  using Lock = std::lock_guard<std::mutex>;
  /// What is built and delivered once everything that it stands beside is expected.
  using Deliveries = std::vector<std::pair<roam::PatchId, const std::vector<roam::Mesh>*>>;

  State(std::shared_ptr<roam::Patchwork> to, Levels which, const osg::Vec3d& moved)
      : space(std::move(to)), levels(which), origin(osg::Matrixd::translate(moved)) {}

  const std::shared_ptr<roam::Patchwork> space;
  const Levels levels;
  const osg::Matrixd origin;

  mutable std::mutex mutex;  ///< of all below, and of the state of places
  osg::ref_ptr<osgDB::ReadFileCallback> next;
  bool takes_unnamed = true;
  std::map<std::string, std::vector<std::shared_ptr<Place>>> named;
  std::set<std::string> taken;  ///< roots, and files that were loaded before
  Stats stats;

  /// The places that a file which has been read is to be taken to; from now on nobody else takes it there.
  std::vector<std::shared_ptr<Place>> claim(const std::string& file) {
    const Lock lock(mutex);
    std::vector<std::shared_ptr<Place>> claimed;
    const auto places = named.find(file);
    if (places != named.end()) {
      for (const auto& place : places->second) {
        if (place->state != Place::State::waiting && place->state != Place::State::failed) continue;
        if (place->state == Place::State::failed) {
          --stats.failed;
          ++stats.expected;
        }
        place->state = Place::State::being_taken;
        claimed.push_back(place);
      }
    } else if (takes_unnamed && taken.insert(file).second) {
      claimed.push_back(std::make_shared<Place>());
      claimed.back()->trail = std::make_shared<Trail>(Trail{file, nullptr});
      claimed.back()->to_scene = origin;
      claimed.back()->is_named = false;
      claimed.back()->state = Place::State::being_taken;
    }
    return claimed;
  }

  void take(osg::Node& node, const std::string& name, const std::shared_ptr<Place>& place) {
    try {
      install(harvest(node, place->to_scene, name), *place);
      const Lock lock(mutex);
      place->state = Place::State::taken;
      if (place->is_named) --stats.expected;
    } catch (const std::exception& error) {
      // In a pager's thread there is nobody to catch it.
      fail(*place, error.what());
    }
  }

  void install(const Harvest& harvest, Place& place) {
    Deliveries deliveries;
    {
      const Lock lock(mutex);
      // Everything is expected before anything comes: what refines one patch takes its place together.
      for (const NamedFiles& named_files : harvest.named) expect(named_files, place, deliveries);
      taken.insert(harvest.loaded.begin(), harvest.loaded.end());
      stats.triangles += harvest.triangles;
      stats.leftOut += harvest.left_out;
      ++stats.files;
      if (place.patch == roam::PatchId::none && !harvest.meshes.empty()) {
        place.patch = space->expect(box_of(harvest.meshes));
      }
    }
    for (const auto& [patch, meshes] : deliveries) space->deliver(patch, build(*meshes));
    if (place.patch != roam::PatchId::none) space->deliver(place.patch, build(harvest.meshes));
  }

  /// Under the lock.
  void expect(const NamedFiles& files, const Place& from, Deliveries& deliveries) {
    roam::Box box = files.box;
    if (box.empty()) box = from.box.empty() ? everywhere() : from.box;
    roam::PatchId refines = from.refines;
    std::shared_ptr<Substitute> substitute;
    if (!files.coarse.empty()) {
      if (levels == FINEST_ONLY) {
        substitute = std::make_shared<Substitute>(Substitute{files.coarse});
      } else {
        const roam::PatchId coarse = space->expect(box_of(files.coarse), refines);
        deliveries.emplace_back(coarse, &files.coarse);
        refines = coarse;
      }
    }
    for (const auto& level : files.levels) {
      const bool finest = &level == &files.levels.back();
      if (levels == FINEST_ONLY && !finest) continue;
      if (finest && !files.finest.empty()) {
        deliveries.emplace_back(space->expect(box_of(files.finest), refines), &files.finest);
      }
      roam::PatchId last = refines;
      for (const std::string& file : level) last = expect(file, files.to_scene, box, refines, from, substitute);
      refines = last;
    }
  }

  /// Under the lock.
  roam::PatchId expect(const std::string& file, const osg::Matrixd& to_scene, const roam::Box& box,
                       roam::PatchId refines, const Place& from, const std::shared_ptr<Substitute>& substitute) {
    const auto place = std::make_shared<Place>();
    place->trail = std::make_shared<Trail>(Trail{file, from.trail});
    place->to_scene = to_scene;
    place->box = box;
    place->patch = space->expect(box, refines);
    place->refines = refines;
    place->substitute = substitute;
    if (holds(from.trail.get(), file)) {
      place->state = Place::State::failed;
      note_failure(file);
      space->fail(place->patch, file + " names itself");
      return place->patch;
    }
    named[file].push_back(place);
    ++stats.expected;
    return place->patch;
  }

  /// Under the lock.
  void note_failure(const std::string& file) {
    ++stats.failed;
    auto& files = stats.failedFiles;
    if (files.size() < failed_names_limit && std::find(files.begin(), files.end(), file) == files.end()) {
      files.push_back(file);
    }
  }

  /// The file of a place that has been claimed cannot be had.
  void fail(Place& place, const std::string& reason) {
    const std::vector<roam::Mesh>* substitute = nullptr;
    {
      const Lock lock(mutex);
      note_failure(place.trail->file);
      place.state = Place::State::failed;
      if (!place.is_named) return;
      --stats.expected;
      if (place.substitute != nullptr && !place.substitute->used) {
        place.substitute->used = true;
        substitute = &place.substitute->meshes;
        place.state = Place::State::taken;
      }
    }
    if (substitute == nullptr) {
      space->fail(place.patch, reason);
    } else {
      space->deliver(place.patch, build(*substitute));
    }
  }

  void fail_all(const std::string& file, const std::string& reason) {
    {
      const Lock lock(mutex);
      const auto places = named.find(file);
      if (places == named.end()) return;
      // The pager asks again and again.
      if (std::none_of(places->second.begin(), places->second.end(),
                       [](const auto& place) { return place->state == Place::State::waiting; })) {
        return;
      }
    }
    for (const auto& place : claim(file)) fail(*place, reason);
  }
};

Harvester::Harvester(std::shared_ptr<roam::Patchwork> space, Levels levels, const osg::Vec3d& origin)
    : _state(std::make_unique<State>(std::move(space), levels, origin)) {
  if (_state->space == nullptr)
    throw roam::Error("osgRoam::Harvester needs a patchwork; the one it was given is null.");
}

Harvester::~Harvester() = default;

void Harvester::add(osg::Node& graph, const osg::Matrixd& place) {
  Place root;
  root.to_scene = place * _state->origin;
  _state->install(harvest(graph, root.to_scene, graph.getName()), root);
}

void Harvester::setTakesUnnamedFiles(bool takes) {
  const State::Lock lock(_state->mutex);
  _state->takes_unnamed = takes;
}

void Harvester::setNextCallback(osgDB::ReadFileCallback* next) {
  const State::Lock lock(_state->mutex);
  _state->next = next;
}

Harvester::Stats Harvester::getStats() const {
  const State::Lock lock(_state->mutex);
  return _state->stats;
}

osgDB::ReaderWriter::ReadResult Harvester::readNode(const std::string& file, const osgDB::Options* options) {
  const bool nested = std::find(reading.begin(), reading.end(), this) != reading.end();
  osg::ref_ptr<osgDB::ReadFileCallback> next;
  {
    const State::Lock lock(_state->mutex);
    next = _state->next;
  }
  const Reading now(this);
  osgDB::ReaderWriter::ReadResult result =
      next.valid() ? next->readNode(file, options) : osgDB::ReadFileCallback::readNode(file, options);
  if (nested) return result;
  if (osg::Node* node = result.getNode()) {
    const std::string name = osgDB::getStrippedName(file);
    for (const auto& place : _state->claim(file)) _state->take(*node, name, place);
  } else {
    _state->fail_all(file, file + " cannot be read: " + result.statusMessage());
  }
  return result;
}

}  // namespace osgRoam
