#include "open_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <new>
#include <thread>

#include "exit_status.h"
#include "interrupt.h"
#include "loose_triangles.h"
#include "progress.h"
#include "store/build/fingerprint.h"
#include "store/opened.h"
#include "store_start.h"
#include "tell.h"

namespace roam::app {
namespace {

/// Seconds. How long a body that is put somewhere may wait for what is there; then it is held, as said.
constexpr double longest_wait = 60.0;

/// How long a thread of the pager may take to name what is not known; where all of them wait for reads it is not named.
constexpr std::chrono::milliseconds longest_naming{200};

/// Metres and triangles. Pieces of a way are checked against a store together as long as they stay so near to each
/// other that what lies around them fits in memory.
constexpr double stretch = 100.0;
constexpr std::uint64_t most_triangles = 50'000'000;

Box box_of(std::span<const Piece> pieces) {
  Box box;
  for (const Piece& piece : pieces) {
    const double reach = std::max(piece.body.radius, piece.clearance) + piece.body.half_height;
    box.include(Box{glm::min(piece.from, piece.to), glm::max(piece.from, piece.to)}.grown(reach));
  }
  return box;
}

/// `missing` as of Store::for_each_triangle.
Mesh read_triangles(const Store& store, const Box& box, const std::function<void(const std::string&)>& missing) {
  Mesh mesh;
  const auto take = [&](std::span<const Triangle> triangles, std::span<const TriangleId>) {
    stop_if_interrupted();
    append(mesh, triangles);
    if (mesh.triangles.size() > most_triangles) {
      throw Error(fmt::format("{}: more than {} triangles lie around this way; look at a shorter part of it",
                              store.name(), short_count(static_cast<double>(most_triangles))));
    }
  };
  store.for_each_triangle(box, take, missing);
  return mesh;
}

/// The pieces from `begin` on that stay near to each other. Never part of a step.
std::size_t end_of_stretch(std::span<const Piece> pieces, std::size_t begin) {
  Box box;
  std::size_t end = begin;
  for (std::size_t i = begin; i < pieces.size(); ++i) {
    box.include(pieces[i].from);
    box.include(pieces[i].to);
    const Vec3 size = box.size();
    if (end > begin && std::max({size.x, size.y, size.z}) > stretch) return end;
    if (i + 1 == pieces.size() || pieces[i + 1].step != pieces[i].step) end = i + 1;
  }
  return pieces.size();
}

std::shared_ptr<const Store> open_store(const SceneOptions& options, std::uint64_t memory) {
  if (!options.name_a_store()) return nullptr;
  if (options.scenes.size() > 1) {
    throw UsageError("a store is a scene of its own: build one store of all that is to be one scene (roam build)");
  }
  if (options.says_how_to_read()) {
    throw UsageError(options.scenes.front().string() +
                     " is a store: --up, --unit, --ignore and --lossless are said when it is built (roam build)");
  }
  return Store::open(options.scenes.front(), memory);
}

std::unique_ptr<Pager> make_pager(const std::shared_ptr<const Store>& store, std::uint64_t memory) {
  const auto said = [&] { return "--memory " + short_count(static_cast<double>(memory)) + "B"; };
  if (memory < Pager::least_memory) {
    throw UsageError(fmt::format("{}: a store is walked in {} MiB at least", said(), Pager::least_memory >> 20));
  }
  try {
    return std::make_unique<Pager>(store, PagerOptions{.memory = memory});
  } catch (const std::bad_alloc&) {
    throw Error(said() + " is more than this machine gives; a store is walked in less, e.g. --memory 64M");
  }
}

}  // namespace

OpenScene::OpenScene(const SceneOptions& options, Source source) : store_(open_store(options, options.store_memory())) {
  if (store_) {
    pager_ = make_pager(store_, options.store_memory());
    return;
  }
  loaded_ = load(options, source);
}

const Space& OpenScene::space() const {
  if (pager_) return *pager_;
  return loaded_.world;
}

std::uint64_t OpenScene::triangles() const {
  return store_ ? store_->info().triangles : loaded_.world.stats().triangles;
}

Box OpenScene::bounds() const { return store_ ? store_->info().bounds : loaded_.bounds; }

std::optional<PagerStats> OpenScene::paging() const {
  if (!pager_) return std::nullopt;
  return pager_->stats();
}

Vec3 OpenScene::start(const WalkerSettings& settings, Mode mode) const {
  return store_ ? store_start(*store_, settings, mode) : wander_start(loaded_.world, settings, mode, loaded_.floors);
}

void OpenScene::wait_at(const Body& body, const Vec3& place) {
  if (!pager_) return;
  pager_->wait(body, place, Vec3(0.0), longest_wait);
  stop_if_interrupted();
}

bool OpenScene::wait_along(const Body& body, const Vec3& from, const Vec3& velocity, double seconds) {
  const bool known = !pager_ || pager_->wait(body, from, velocity, seconds, 1.0);
  stop_if_interrupted();
  return known;
}

void OpenScene::follow(const Walker& walker) {
  if (!pager_) return;
  pager_->wait(walker.body(), walker.position(), walker.velocity(), walker.report().elapsed);
}

SourceTriangle OpenScene::source(TriangleId triangle) const {
  if (store_) return store_->source(triangle);
  return {"", triangle, triangle, loaded_.world.object_name(triangle)};
}

TriangleId OpenScene::scene_triangle(TriangleId triangle) const {
  return store_ ? store_->scene_triangle(triangle) : triangle;
}

std::string OpenScene::why_unknown(TriangleId unknown) const {
  const auto until = std::chrono::steady_clock::now() + longest_naming;
  std::string why = space().object_name(unknown);
  while (why.empty() && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    why = space().object_name(unknown);
  }
  return why;
}

Mesh OpenScene::stored_triangles(std::span<const Piece> pieces, double reach) const {
  return read_triangles(*store_, box_of(pieces).grown(reach),
                        [](const std::string& what) { tell(fmt::format("note: left out of the picture: {}", what)); });
}

Verification OpenScene::verified(std::span<const Piece> pieces,
                                 const std::function<bool(std::uint64_t)>& progress) const {
  if (!store_) return verify(loaded_.meshes, pieces, progress);
  Verification all;
  all.scene = bounds();
  for (std::size_t begin = 0; begin < pieces.size();) {
    const std::size_t end = end_of_stretch(pieces, begin);
    const auto part = pieces.subspan(begin, end - begin);
    Verification found;
    const Mesh mesh = read_triangles(*store_, box_of(part), [&](const std::string& w) { found.unread.push_back(w); });
    found.add(verify({&mesh, 1}, part));
    all.add(found);
    begin = end;
    if (progress && !progress(begin)) throw Cancelled();
  }
  return all;
}

void read_as(SceneOptions& scene, const Store& store) {
  ImportOptions options;
  store::read_as(store.state().manifest.options, options);
  const SceneOptions unsaid;
  if (scene.up.empty() && options.up) scene.up = "xyz"[static_cast<int>(*options.up)];
  for (const char* unit : {"m", "cm", "mm", "ft", "in"}) {
    if (scene.unit == unsaid.unit && parse_length_unit(unit) == options.unit) scene.unit = unit;
  }
  if (scene.ignore.empty()) scene.ignore = options.ignore;
}

void check_against(const SceneOptions& scene) {
  for (const auto& path : scene.scenes) {
    if (Store::is_store(path)) {
      throw UsageError("--against " + path.string() +
                       ": this is a store; name the scene, or say --verify to check against the store itself");
    }
  }
  scene.check_there();
}

Verification verify_against(const SceneOptions& scene, std::uint64_t triangles, std::span<const Piece> pieces,
                            const std::function<bool(std::uint64_t, std::uint64_t)>& progress) {
  Verifier verifier(pieces);
  ImportOptions reading = scene.import_options();
  reading.progress = [&](const ImportProgress& p) { return progress(p.bytes_read, p.bytes_total); };
  TriangleId first = 0;
  stream_scene(scene.scenes, reading, [&](const Mesh& piece, bool) {
    verifier.check({&piece, 1}, first);
    first += piece.triangles.size();
  });
  if (first != triangles) {
    tell(fmt::format("note: triangles of {}: {}; of the store: {}. Is it another scene, or a later one?", scene.names(),
                     first, triangles));
  }
  return verifier.result();
}

}  // namespace roam::app
