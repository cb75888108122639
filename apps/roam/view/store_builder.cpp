#include "view/store_builder.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <future>
#include <utility>

#include "roam/error.h"
#include "scenes/beside_scene.h"
#include "scenes/user_key.h"
#include "view/collision_loader.h"

namespace roam::app {
namespace {

/// This thread, and the processes and threads that it starts, give way to all others.
void give_way() {
  constexpr int nicer = 5;
  // Not more: drawing without a graphics card takes all cores. Where it may not be done, smoothness is lost, not more.
  (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), nicer);
}

double share(std::uint64_t done, std::uint64_t total) {
  return total > 0 ? std::min(1.0, static_cast<double>(done) / static_cast<double>(total)) : 0.0;
}

}  // namespace

StoreBuilder::StoreBuilder(const SceneAndStore& what, const WalkerSettings& walker, const Vec3& place,
                           std::uint64_t memory)
    : what_(what), output_(store_place(what)), walker_(walker), memory_(memory), place_(place), loading_([this] {
        build();
      }) {}

void StoreBuilder::follow(const Vec3& place) {
  loading_.with_state([&](const LoadState&) { place_ = place; });
}

Vec3 StoreBuilder::place() {
  return loading_.with_state([this](const LoadState&) { return place_; });
}

std::shared_ptr<Pager> StoreBuilder::take() {
  return loading_.with_state([this](const LoadState&) { return std::exchange(pager_, nullptr); });
}

std::vector<std::string> StoreBuilder::notes() {
  return loading_.with_state([this](const LoadState&) { return notes_; });
}

bool StoreBuilder::goes_on(const StoreBuildProgress& p) {
  using Step = StoreBuildProgress::Step;
  const bool reads = p.step == Step::read;
  const double part = reads                    ? share(p.bytes_done, p.bytes_total)
                      : p.step == Step::shards ? share(p.triangles_done, p.triangles_total)
                      : p.step == Step::merge  ? 1.0
                                               : 0.0;
  loading_.tell(reads ? LoadState::Phase::reading : LoadState::Phase::indexing, part, p.triangles_done);
  return loading_.wanted();
}

void StoreBuilder::build() {
  if (what_.store.empty()) demand_no_link(output_);
  StoreBuildOptions options;
  options.through_link = !what_.store.empty();
  options.scene = what_.scene.scenes;
  options.output = output_;
  options.import = what_.scene.import_options();
  options.lossless = what_.scene.lossless;
  const UserKey user = made_user_key();
  options.key = user.key ? *user.key : key_of_this_run();
  options.threads = work_threads(what_.scene.threads);
  options.nearest_first = place();
  options.progress = [this](const StoreBuildProgress& p) { return goes_on(p); };
  // In a thread of its own: those of the pager, which inherit from this one, must not give way.
  StoreBuildReport report = std::async(std::launch::async, [&] {
                              give_way();
                              return build_store(options);
                            }).get();
  loading_.tell(LoadState::Phase::looking, 0.0, report.triangles);
  std::shared_ptr<const Store> store = Store::open(output_);
  if (store->info().hash != report.store.hash) {
    throw Error(fmt::format("{} is not what was built just now: another store has taken its place; build again",
                            output_.string()));
  }
  auto pager = std::make_shared<Pager>(std::move(store), PagerOptions{.memory = memory_});
  wait_at(*pager, walker_, place(), [this] { return loading_.wanted(); });
  loading_.with_state([&](LoadState& state) {
    state = {};
    state.phase = LoadState::Phase::done;
    state.share = 1.0;
    notes_ = notes_as_sentences(report, output_);
    pager_ = std::move(pager);
  });
}

}  // namespace roam::app
