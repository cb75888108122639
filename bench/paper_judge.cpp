#include "paper_judge.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "judge.h"
#include "math/boxes.h"
#include "store/meshes.h"
#include "text/names.h"

namespace roam::bench {
namespace {

constexpr std::size_t block_steps = 16;

Box box_of(const Vec3& from, const Vec3& to, const Body& body) {
  // The reference decides about contact, so a slightly larger box is harmless.
  const Vec3 reach = Vec3(body.radius + 1e-6) + Vec3(0.0, 0.0, body.half_height);
  return box_around(std::array{from, to}).grown(reach);
}

}  // namespace

const char* to_string(Ending ending) {
  return name_in({"completed", "stuck", "fell", "through a wall", "not finished"}, ending);
}

void PaperJudge::watch(const Way& way, const Walked& walked) {
  const Vec3& last = walked.places.back();
  Watched watched{.begin = steps_.size(), .end = 0, .ending = Ending::stuck};
  watched.ending = has_fallen(way, last) ? Ending::fell
                   : arrived(way, last)  ? Ending::reached
                   : walked.cut          ? Ending::cut
                                         : Ending::stuck;
  for (std::size_t i = 0; i + 1 < walked.places.size(); ++i) {
    if (i % block_steps == 0) blocks_.push_back({.begin = steps_.size(), .end = 0, .box = {}});
    const Body body{.radius = walked.radii[i], .half_height = way.body().half_height};
    steps_.push_back({walked.places[i], walked.places[i + 1], body, body.radius});
    blocks_.back().box.include(box_of(walked.places[i], walked.places[i + 1], body));
    blocks_.back().end = steps_.size();
  }
  watched.end = steps_.size();
  watched_.push_back(watched);
}

void PaperJudge::add(const Mesh& mesh) {
  const Box whole = box_around(mesh.vertices);
  std::vector<Box> near;
  for (const Block& block : blocks_) {
    if (meet(block.box, whole)) near.push_back(block.box);
  }
  if (near.empty()) return;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle triangle = mesh.triangle(i);
    const Box box = box_around(triangle);
    if (std::none_of(near.begin(), near.end(), [&](const Box& block) { return meet(block, box); })) continue;
    store::append(kept_, {&triangle, 1});
    if (kept_.triangles.size() >= most_) settle();
  }
}

void PaperJudge::settle() {
  if (kept_.triangles.empty()) return;
  const Reference reference({&kept_, 1});
  const Box whole = box_around(kept_.vertices);
  for (const Block& block : blocks_) {
    if (!meet(block.box, whole)) continue;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      Step& step = steps_[i];
      const Query way{step.body, step.from, step.to - step.from};
      step.clearance = std::min(step.clearance, reference.smallest_clearance(way, 1.0, step.clearance));
      // A centre crosses a triangle only if it comes near one.
      if (step.crossed || step.clearance > 1e-3 || glm::length(way.motion) == 0.0) continue;
      step.crossed = reference.sweep({.body = {.radius = 0.0}, .from = way.from, .motion = way.motion}).hit;
    }
  }
  kept_.vertices.clear();
  kept_.triangles.clear();
}

std::vector<Judgement> PaperJudge::judgements() {
  settle();
  std::vector<Judgement> all;
  for (const Watched& watched : watched_) {
    Judgement& judgement = all.emplace_back();
    judgement.ending = watched.ending;
    for (std::size_t i = watched.begin; i < watched.end; ++i) {
      const double depth = steps_[i].body.radius - steps_[i].clearance;
      if (depth > depth_allowed) {
        ++judgement.in_walls;
        judgement.deepest = std::max(judgement.deepest, depth);
      }
      if (!steps_[i].crossed) continue;
      judgement.ending = Ending::through;
      break;
    }
  }
  return all;
}

}  // namespace roam::bench
