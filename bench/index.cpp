// Times roam alone, for changes of the index. Wrong answers come before times.

#include <hwy/targets.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>

#include "judge.h"
#include "memory.h"
#include "program.h"
#include "query_sets.h"
#include "roam/error.h"
#include "roam/world.h"
#include "run_options.h"
#include "scene.h"
#include "timing.h"

namespace {

using namespace roam::bench;

struct Options : RunOptions {
  bool lossless = false;
  bool check = true;
  std::string instructions;
};

// Highway chooses the best remaining instruction set of those that it was compiled for.
void restrict_instructions(const std::string& name) {
  std::string known;
  for (auto left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    const auto target = left & -left;
    if (name == hwy::TargetName(target)) {
      hwy::SetSupportedTargetsForTest(left);  // better sets have lower bits
      hwy::GetChosenTarget().DeInit();
      return;
    }
    known += std::string(known.empty() ? "" : ", ") + hwy::TargetName(target);
  }
  throw roam::Error("this machine has no instruction set '" + name + "': choose one of " + known);
}

double seconds_to_build(const Scene& scene, const roam::BuildOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const roam::World world = roam::World::build(scene.meshes, options);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void print_build(const Scene& scene, bool lossless, const roam::World& world, std::size_t allocated) {
  const auto triangles = static_cast<double>(scene.triangles());
  for (const int threads : {1, 2}) {
    constexpr int builds = 3;
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < builds; ++i) {
      best = std::min(best, seconds_to_build(scene, {.threads = threads, .lossless = lossless, .progress = {}}));
    }
    std::printf("build, %d thread%s: %.3f s, %.2f M triangles/s (best of %d)\n", threads, threads > 1 ? "s" : "", best,
                1e-6 * triangles / best, builds);
  }
  std::printf("resident: %.2f bytes a triangle as the world counts, %.2f as malloc counts; %llu tiles\n",
              static_cast<double>(world.stats().bytes) / triangles, static_cast<double>(allocated) / triangles,
              static_cast<unsigned long long>(world.stats().tiles));
}

bool is_wrong(const SceneChoice& choice, const Options& options) {
  const Scene scene = make_scene(choice);
  std::printf("%s\n", scene.name.c_str());
  const std::size_t before = allocated_bytes();
  const roam::World world =
      roam::World::build(scene.meshes, {.threads = 0, .lossless = options.lossless, .progress = {}});
  print_build(scene, options.lossless, world, allocated_bytes() - before);
  const Reference reference(scene.meshes);
  const auto ask = [&world](const Query& q) {
    const roam::Impact s = world.sweep(q.body, q.from, q.motion);
    return Answer{s.hit, s.time};
  };
  if (options.check)
    std::printf("%-9s %8s %8s %6s %6s %6s %6s %11s", "set", "queries", "hits", "missed", "late", "early", "false",
                "deepest");
  std::printf("   %8s %8s %8s %8s   ns\n", "p50", "p99", "hit p50", "max");
  bool wrong = false;
  for (const std::string& name : options.sets) {
    const QuerySet set = make_queries(name, options.queries, reference);
    std::vector<Answer> answers;
    std::vector<bool> hits;
    for (const Query& q : set.queries) {
      answers.push_back(ask(q));
      hits.push_back(answers.back().hit);
    }
    if (options.check) {
      std::vector<Answer> truth;
      for (const Query& q : set.queries) truth.push_back(reference.sweep(q));
      const Verdict v = judge(answers, truth, set.queries, reference);
      wrong = wrong || v.wrong() > 0;
      std::printf("%-9s %8zu %8zu %6zu %6zu %6zu %6zu %8.3g mm", name.c_str(), v.queries, v.hits, v.missed, v.late,
                  v.early, v.false_hits, 1e3 * v.deepest);
      std::fflush(stdout);
    } else {
      std::printf("%-9s", name.c_str());
    }
    const Ask asked[] = {timed(ask)};
    const std::size_t counts[] = {set.queries.size()};
    const Summary s = summarize(time_in_turns(asked, counts, set.queries, options.rounds)[0], hits);
    std::printf("   %8.0f %8.0f %8.0f %8.0f\n", s.p50, s.p99, s.hit_p50, s.most);
    std::fflush(stdout);
  }
  return wrong;
}

int run(const Options& options) {
  if (!options.instructions.empty()) restrict_instructions(options.instructions);
  bool wrong = false;
  for (const SceneChoice& choice : options.scenes) wrong |= is_wrong(choice, options);
  return wrong ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Times roam's sweeps in scenes; exit code 1 when an answer is wrong"};
  options.add_to(app);
  app.add_flag("--lossless", options.lossless, "build with BuildOptions::lossless");
  app.add_flag("!--no-check", options.check, "do not compare with the reference: starts faster");
  app.add_option("--instructions", options.instructions,
                 "best instruction set to use, named as in Highway: AVX3, AVX2, SSE4, ...");
  return run_program(app, argc, argv, [&] { return run(options); });
}
