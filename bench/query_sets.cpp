#include "query_sets.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "roam/error.h"

namespace roam::bench {
namespace {

constexpr double start_reach = 3.0;         // m: starts and walkers are no farther from a surface
constexpr double start_margin = 1e-3;       // m: no start is closer to a triangle than radius + this
constexpr double far_motion = 50.0;         // m: of long sweeps and rays
constexpr double walker_skin = 5e-3;        // m: walkers stop this far off
constexpr double frames_per_second = 60.0;  // of walkers
constexpr std::size_t walkers = 100;
constexpr int most_tries = 100000;  // for one start

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : bits_(seed) {}
  // std::uniform_real_distribution differs between standard libraries; 53 bits do not.
  double uniform(double lower, double upper) {
    return lower + (upper - lower) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(uniform(0, 1) * static_cast<double>(count)); }
  Vec3 direction() {
    const double z = uniform(-1, 1);
    const double angle = uniform(0, 2 * std::numbers::pi);
    const double flat = std::sqrt(1 - z * z);
    return {flat * std::cos(angle), flat * std::sin(angle), z};
  }

 private:
  std::mt19937_64 bits_;
};

Vec3 start(Dice& dice, const Body& body, const Reference& reference) {
  for (int i = 0; i < most_tries; ++i) {
    const Triangle& t = reference.triangle(dice.index(reference.triangle_count()));
    double u = dice.uniform(0, 1);
    double v = dice.uniform(0, 1);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vec3 on = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
    const Vec3 place = on + dice.uniform(0, start_reach) * dice.direction();
    const double wanted = body.radius + start_margin;
    if (reference.clearance(body, place, wanted) >= wanted) return place;
  }
  throw Error("no free place for a body of radius " + std::to_string(body.radius) +
              " m within 3 m of the scene's surfaces: choose another scene");
}

// Whether there are walls in at least five of the six directions along the axes, including floor and ceiling.
bool enclosed(const Vec3& place, const Reference& reference) {
  constexpr double far = 20.0;  // m
  int walls = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-far, far}) {
      Query ray{.body = {.radius = 0.0}, .from = place, .motion = Vec3(0.0)};
      ray.motion[axis] = side;
      const bool wall = reference.sweep(ray).hit;
      if (axis == 2 && !wall) return false;
      walls += wall ? 1 : 0;
    }
  }
  return walls >= 5;
}

Vec3 walker_start(Dice& dice, const Body& body, const Reference& reference) {
  constexpr int tries = 300;
  for (int i = 0; i < tries; ++i) {
    const Vec3 place = start(dice, body, reference);
    if (enclosed(place, reference)) return place;
  }
  return start(dice, body, reference);
}

Vec3 heading(Dice& dice) {
  const double angle = dice.uniform(0, 2 * std::numbers::pi);
  return glm::normalize(Vec3(std::cos(angle), std::sin(angle), dice.uniform(-0.3, 0.3)));
}

void walk(Dice& dice, std::size_t steps, const Reference& reference, std::vector<Query>& queries) {
  const Body body{.radius = dice.uniform(0.3, 0.5)};
  const Body with_skin{.radius = body.radius + walker_skin};
  const double step = dice.uniform(1.5, 50.0) / frames_per_second;
  Vec3 place = walker_start(dice, with_skin, reference);
  Vec3 ahead = heading(dice);
  for (std::size_t i = 0; i < steps; ++i) {
    const Vec3 motion = step * ahead;
    queries.push_back({body, place, motion});
    const Answer answer = reference.sweep({with_skin, place, motion});
    // A part in a thousand short of the touch, so that rounding never lets a walker into its skin.
    constexpr double short_of_touch = 0.999;
    place += (answer.hit ? short_of_touch * answer.time : 1.0) * motion;
    const std::optional<Vec3> wall = reference.nearest(with_skin, place, start_reach);
    if (answer.hit && wall) {
      const Vec3 out = glm::normalize(place - *wall);
      ahead = glm::reflect(ahead, out) + 0.5 * dice.direction();
      if (glm::dot(ahead, out) < 0) ahead = glm::reflect(ahead, out);
      ahead = glm::normalize(ahead);
    } else if (!wall) {
      const std::optional<Vec3> back = reference.nearest(with_skin, place, 2 * start_reach);
      ahead = back ? glm::normalize(glm::normalize(*back - place) + 0.5 * dice.direction()) : heading(dice);
    }
  }
}

}  // namespace

const std::vector<std::string>& query_set_names() {
  static const std::vector<std::string> names{"random", "coherent", "long", "capsule"};
  return names;
}

const std::vector<std::string>& point_set_names() {
  static const std::vector<std::string> names{"rays", "walkrays", "nearest"};
  return names;
}

QuerySet make_queries(const std::string& name, std::size_t count, const Reference& reference) {
  constexpr std::uint64_t seed = 20200216;
  Dice dice(seed);
  QuerySet set{.name = name, .queries = {}};
  set.queries.reserve(count);
  if (name == "walkrays" || name == "nearest") {
    set.queries = make_queries("coherent", count, reference).queries;
    set.kind = name == "nearest" ? QueryKind::nearest : QueryKind::ray;
    for (Query& query : set.queries) {
      query = {.body = {.radius = 0.0},
               .from = query.from,
               .motion = name == "nearest" ? Vec3(0.0) : far_motion * glm::normalize(query.motion)};
    }
    return set;
  }
  if (name == "coherent") {
    for (std::size_t w = 0; w < walkers; ++w) {
      walk(dice, count * (w + 1) / walkers - count * w / walkers, reference, set.queries);
    }
    return set;
  }
  if (name == "rays") {
    set.kind = QueryKind::ray;
  } else if (name != "random" && name != "long" && name != "capsule") {
    throw Error("there is no query set '" + name +
                "': choose random, coherent, long, capsule, rays, walkrays or nearest");
  }
  while (set.queries.size() < count) {
    const Body body =
        name == "capsule" ? Body::capsule(0.3, 1.8) : Body{.radius = name == "rays" ? 0.0 : dice.uniform(0.2, 1.0)};
    const double length = name == "long" || name == "rays" ? far_motion : dice.uniform(0.05, 2.0);
    const Vec3 from = start(dice, body, reference);
    set.queries.push_back({body, from, length * dice.direction()});
  }
  return set;
}

}  // namespace roam::bench
