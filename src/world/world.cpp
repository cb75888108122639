#include "roam/world.h"

#include <algorithm>
#include <atomic>
#include <string>

#include "world/data.h"

namespace roam {

std::uint64_t next_revision() {
  static std::atomic<std::uint64_t> last{0};
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

World::World() {
  auto data = std::make_unique<WorldData>();
  data->first = {0};
  data_ = std::move(data);
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

SpaceFacts World::facts() const {
  return {.bounds = data_->bounds, .largest_error = data_->stats.largest_error_m, .revision = data_->revision};
}

const WorldStats& World::stats() const { return data_->stats; }

ObjectId World::object(TriangleId triangle) const {
  const auto& first = data_->first;
  if (triangle >= first.back()) {
    throw Error("the world has " + std::to_string(first.back()) + " triangles, and none with the number " +
                (triangle == no_triangle ? "of a miss" : std::to_string(triangle)) + "; ask of a hit only");
  }
  return data_->object(triangle);
}

std::string World::object_name(TriangleId triangle) const {
  return triangle < data_->first.back() ? data_->names[object(triangle)] : std::string();
}

}  // namespace roam
