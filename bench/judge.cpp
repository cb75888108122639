#include "judge.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace roam::bench {
namespace {

double depth_on_way(const Query& query, double time, const Reference& reference) {
  return query.body.radius - reference.smallest_clearance(query, time, query.body.radius);
}

bool far_off(const Query& query, const Answer& answer, bool says_when, const Reference& reference) {
  const double near = query.body.radius + gap_allowed;
  if (!says_when) return reference.smallest_clearance(query, 1.0, near) >= near;
  return reference.clearance(query.body, query.from + answer.time * query.motion, near) >= near;
}

}  // namespace

Verdict judge(std::span<const Answer> answers, std::span<const Answer> truth, std::span<const Query> queries,
              const Reference& reference, bool says_when) {
  Verdict verdict{.queries = answers.size()};
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const Query& query = queries[i];
    const Answer& answer = answers[i];
    verdict.hits += truth[i].hit ? 1 : 0;
    const double length = glm::length(query.motion);
    const double free_until = answer.hit ? (says_when ? answer.time : 0.0) : 1.0;
    // Depth and gap change by at most the motion's length. So only answers that differ by more need a closer look.
    if (truth[i].hit && (free_until - truth[i].time) * length > depth_allowed) {
      const double depth =
          query.body.radius > 0 ? depth_on_way(query, free_until, reference) : (free_until - truth[i].time) * length;
      if (depth > depth_allowed) {
        ++(answer.hit ? verdict.late : verdict.missed);
        verdict.deepest = std::max(verdict.deepest, depth);
      }
    }
    if (!answer.hit || (truth[i].hit && (!says_when || (truth[i].time - answer.time) * length <= gap_allowed)))
      continue;
    if (far_off(query, answer, says_when, reference)) ++(truth[i].hit ? verdict.early : verdict.false_hits);
  }
  return verdict;
}

Verdict judge_nearest(std::span<const Answer> answers, std::span<const Answer> truth) {
  Verdict verdict{.queries = answers.size()};
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const double above = answers[i].distance - truth[i].distance;
    verdict.hits += truth[i].distance < nearest_reach ? 1 : 0;
    verdict.early += -above > gap_allowed ? 1 : 0;
    if (above <= depth_allowed) continue;
    ++verdict.late;
    verdict.deepest = std::max(verdict.deepest, above);
  }
  return verdict;
}

}  // namespace roam::bench
