#include "roam/world.h"

#include <atomic>

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
  return {.bounds = data_->bounds, .largest_error = data_->stats.largest_error, .revision = data_->revision};
}

const WorldStats& World::stats() const { return data_->stats; }

Object World::object(TriangleId triangle) const {
  if (triangle >= data_->first.back()) return {};
  const ObjectId id = data_->object(triangle);
  return {id, data_->names[id], data_->user_data[id]};
}

}  // namespace roam
