#include "osgRoam/Harvester.h"

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>
#include <new>
#include <osgDB/FileNameUtils>
#include <set>
#include <utility>

#include "harvest_walk.h"

namespace osgRoam {
namespace {

constexpr std::size_t failed_names_limit = 100;

/// The chain of files that led to a file, itself first.
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

/// Geometry to use if files fail. Several files may share one; the first failure delivers it.
struct Substitute {
  std::vector<roam::Mesh> meshes;
  bool used = false;
};

/// A position at which a file is named.
struct Place {
  enum class State { waiting, being_taken, taken, failed };

  std::shared_ptr<const Trail> trail;
  osg::Matrixd to_scene;
  roam::Box box;
  roam::PatchId patch = roam::PatchId::none;    ///< the geometry of the file that stays; none until a box is known
  roam::PatchId refines = roam::PatchId::none;  ///< the patch that it replaces, together with the files it names
  std::shared_ptr<Substitute> substitute;
  State state = State::waiting;

  // Only for the thread that has claimed the place.
  bool is_expected = false;          ///< all patches of the file and of the files it names are expected, even if they
                                     ///< failed
  std::vector<roam::PatchId> parts;  ///< patches of the file, in the order of Harvester::State::parts; none for those
                                     ///< delivered
};

roam::World build(const std::vector<roam::Mesh>& meshes) {
  roam::BuildOptions options;
  options.threads = 1;  // one thread, because there are enough readers
  return roam::World::build(meshes, options);
}

/// In a handler: the message of the exception.
std::string caught() {
  try {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "something was thrown that is no std::exception";
  }
}

/// Marks that this thread is reading for a harvester. Allocates nothing, because nothing would catch std::bad_alloc in
/// a pager's thread.
class Reading {
 public:
  explicit Reading(const void* who) : who_(who), outer_(innermost_) { innermost_ = this; }
  ~Reading() { innermost_ = outer_; }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
  [[nodiscard]] static bool is_for(const void* who) {
    const Reading* at = innermost_;
    while (at != nullptr && at->who_ != who) at = at->outer_;
    return at != nullptr;
  }

 private:
  static thread_local const Reading* innermost_;
  const void* who_;
  const Reading* outer_;
};
thread_local const Reading* Reading::innermost_ = nullptr;

}  // namespace

struct Harvester::State {
  using Lock = std::lock_guard<std::mutex>;
  State(std::shared_ptr<roam::Patchwork> to, Levels which, const osg::Vec3d& moved)
      : space(std::move(to)), levels(which), origin(osg::Matrixd::translate(moved)) {}

  const std::shared_ptr<roam::Patchwork> space;
  const Levels levels;
  const osg::Matrixd origin;

  mutable std::mutex mutex;  ///< protects all members below, and the state of places
  osg::ref_ptr<osgDB::ReadFileCallback> next;
  bool takes_unnamed = true;
  std::map<std::string, std::vector<std::shared_ptr<Place>>> named;
  std::set<std::string> not_roots;  ///< files that were loaded before, or have no finite transform
  Stats stats;

  /// Claims the places of a file that has been read. From now on no other thread claims them.
  std::vector<std::shared_ptr<Place>> claim(const std::string& file) {
    const Lock lock(mutex);
    if (takes_unnamed && !named.contains(file) && !not_roots.contains(file)) {
      const auto root = std::make_shared<Place>();
      root->trail = std::make_shared<Trail>(Trail{file, nullptr});
      root->to_scene = origin;
      named.emplace(file, std::vector{root});  // succeeds or changes nothing
      ++stats.expected;
    }
    std::vector<std::shared_ptr<Place>> claimed;
    const auto places = named.find(file);
    if (places == named.end()) return claimed;
    claimed.reserve(places->second.size());  // nothing may throw once a place has been claimed
    for (const auto& place : places->second) {
      if (place->state != Place::State::waiting && place->state != Place::State::failed) continue;
      if (place->state == Place::State::failed) {
        --stats.failed;
        ++stats.expected;
      }
      place->state = Place::State::being_taken;
      claimed.push_back(place);
    }
    return claimed;
  }

  /// Ends a claim. From now on another thread may claim the place.
  void settle(Place& place, Place::State state, bool is_failure) {
    const Lock lock(mutex);
    place.state = state;
    --stats.expected;
    if (is_failure) note_failure(place.trail->file);
  }

  /// Catches every exception, because nothing would catch it in a pager's thread.
  void take(osg::Node& node, const std::string& name, Place& place) {
    try {
      const Harvest harvested = harvest(node, place.to_scene, name);
      promise(harvested, place);
      const bool failed = bring(harvested, place) != nullptr;
      settle(place, failed ? Place::State::failed : Place::State::taken, failed);
    } catch (...) {
      give_up(place);
    }
  }

  /// In a handler. In all cases the place may be claimed again.
  void give_up(Place& place) {
    try {
      fail(place, caught());
    } catch (...) {
      settle(place, Place::State::failed, true);
    }
  }

  /// The parts of a file, each of which is delivered or fails separately. The first is the geometry that stays.
  [[nodiscard]] std::vector<const std::vector<roam::Mesh>*> parts(const Harvest& harvest) const {
    std::vector<const std::vector<roam::Mesh>*> all{&harvest.meshes};
    for (const NamedFiles& files : harvest.named) {
      if (!files.coarse.empty() && levels != FINEST_ONLY) all.push_back(&files.coarse);
      if (!files.finest.empty()) all.push_back(&files.finest);
    }
    return all;
  }

  /// Expects all parts and named files of a file before any of it is delivered, because the patches that refine one
  /// patch replace it together. Does so only once, even if delivery fails later.
  void promise(const Harvest& harvest, Place& place) {
    const Lock lock(mutex);
    if (!place.is_expected) {
      if (place.patch == roam::PatchId::none && !harvest.meshes.empty()) {
        place.patch = space->expect(box_of(harvest.meshes), place.refines);
      }
      place.parts.push_back(place.patch);
      place.is_expected = true;
      for (const NamedFiles& files : harvest.named) expect(files, place);
      for (const std::string& file : harvest.nowhere) note_failure(file);
      not_roots.insert(harvest.loaded.begin(), harvest.loaded.end());
      not_roots.insert(harvest.nowhere.begin(), harvest.nowhere.end());
      stats.triangles += harvest.triangles;
      stats.leftOut += harvest.left_out;
      ++stats.files;
    }
    if (parts(harvest).size() != place.parts.size()) {
      throw roam::Error::at(
          place.trail->file,
          place.trail->file + " does not hold what it held when it was first read; start anew to take it");
    }
  }

  /// Delivers all parts. Returns the first exception, if any; the parts without an exception have been delivered.
  std::exception_ptr bring(const Harvest& harvest, Place& place) {
    std::exception_ptr first;
    const auto all = parts(harvest);
    for (std::size_t i = 0; i < all.size(); ++i) {
      roam::PatchId& patch = place.parts[i];
      if (patch == roam::PatchId::none) continue;
      try {
        space->deliver(patch, build(*all[i]));
        patch = roam::PatchId::none;
      } catch (...) {
        if (!first) first = std::current_exception();
        tell(patch, caught());
      }
    }
    return first;
  }

  void tell(roam::PatchId patch, const std::string& reason) {
    try {
      if (patch != roam::PatchId::none) space->fail(patch, reason);
    } catch (...) {
      // There is no memory even for this. The patch stays unknown and solid, and its file counts as failed.
    }
  }

  /// Requires the lock.
  void expect(const NamedFiles& files, Place& from) {
    const roam::Box box = files.box.empty() ? from.box : files.box;
    roam::PatchId refines = from.refines;
    std::shared_ptr<Substitute> substitute;
    if (!files.coarse.empty()) {
      if (levels == FINEST_ONLY) {
        substitute = std::make_shared<Substitute>(Substitute{files.coarse});
      } else {
        const roam::PatchId coarse = space->expect(box_of(files.coarse), refines);
        from.parts.push_back(coarse);
        refines = coarse;
      }
    }
    for (const auto& level : files.levels) {
      const bool finest = &level == &files.levels.back();
      if (levels == FINEST_ONLY && !finest) continue;
      if (finest && !files.finest.empty()) {
        from.parts.push_back(space->expect(box_of(files.finest), refines));
      }
      roam::PatchId last = refines;
      for (const std::string& file : level) last = expect(file, files.to_scene, box, refines, from, substitute);
      refines = last;
    }
  }

  /// Requires the lock.
  roam::PatchId expect(const std::string& file, const osg::Matrixd& to_scene, const roam::Box& box,
                       roam::PatchId refines, const Place& from, const std::shared_ptr<Substitute>& substitute) {
    const auto place = std::make_shared<Place>();
    place->trail = std::make_shared<Trail>(Trail{file, from.trail});
    place->to_scene = to_scene;
    place->box = box;
    place->refines = refines;
    place->substitute = substitute;
    if (!box.empty()) place->patch = space->expect(box, refines);
    if (holds(from.trail.get(), file)) {
      place->state = Place::State::failed;
      note_failure(file);
      tell(place->patch, file + " names itself");
      return place->patch;
    }
    named[file].push_back(place);
    if (box.empty()) {
      // It has no space until it is delivered.
      place->state = Place::State::failed;
      note_failure(file);
    } else {
      ++stats.expected;
    }
    return place->patch;
  }

  /// Requires the lock.
  void note_failure(const std::string& file) {
    ++stats.failed;
    auto& files = stats.failedFiles;
    if (files.size() < failed_names_limit && std::find(files.begin(), files.end(), file) == files.end()) {
      try {
        files.push_back(file);
      } catch (const std::bad_alloc&) {
        // The count still includes it.
      }
    }
  }

  /// Handles the failure of a claimed place's file.
  void fail(Place& place, const std::string& reason) {
    std::shared_ptr<Substitute> substitute;
    {
      const Lock lock(mutex);
      if (place.substitute != nullptr && !place.is_expected && !std::exchange(place.substitute->used, true)) {
        substitute = place.substitute;
      }
    }
    Place::State state = Place::State::failed;
    if (substitute != nullptr) {
      try {
        space->deliver(place.patch, build(substitute->meshes));
        state = Place::State::taken;
      } catch (...) {
        tell(place.patch, caught());
      }
    } else if (!place.is_expected) {
      tell(place.patch, reason);
    }
    for (const roam::PatchId patch : place.parts) tell(patch, reason);
    settle(place, state, true);
  }

  void fail_all(const std::string& file, const std::string& reason) {
    {
      const Lock lock(mutex);
      const auto places = named.find(file);
      if (places == named.end()) return;
      // The pager retries a failed file again and again.
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
  root.trail = std::make_shared<Trail>(Trail{graph.getName(), nullptr});
  const Harvest harvested = harvest(graph, root.to_scene, graph.getName());
  try {
    _state->promise(harvested, root);
  } catch (...) {
    for (const roam::PatchId patch : root.parts) _state->tell(patch, caught());
    throw;
  }
  if (const std::exception_ptr first = _state->bring(harvested, root)) std::rethrow_exception(first);
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
  const bool nested = Reading::is_for(this);
  osg::ref_ptr<osgDB::ReadFileCallback> next;
  {
    const State::Lock lock(_state->mutex);
    next = _state->next;
  }
  const Reading now(this);
  osgDB::ReaderWriter::ReadResult result =
      next.valid() ? next->readNode(file, options) : osgDB::ReadFileCallback::readNode(file, options);
  if (nested) return result;
  try {
    if (osg::Node* node = result.getNode()) {
      const std::string name = osgDB::getStrippedName(file);
      for (const auto& place : _state->claim(file)) _state->take(*node, name, *place);
    } else {
      _state->fail_all(file, file + " cannot be read: " + result.statusMessage());
    }
  } catch (...) {
    // There is no memory to begin. The expected patches stay unknown and solid until the file is read again.
  }
  return result;
}

}  // namespace osgRoam
