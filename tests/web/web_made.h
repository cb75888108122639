#pragma once
/// \file
/// A yard with boxes as a store that web servers serve.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <vector>

#include "changing_room.h"
#include "clutter.h"
#include "pager_made.h"
#include "roam/route.h"
#include "store/web_files.h"
#include "walker_judged.h"
#include "web_servers.h"

namespace made {

using namespace scenes;
using roam::Body;
using roam::Pager;
using roam::Store;
using roam::WebAccess;

/// A floor of tiles with boxes on it, 40 m by 40 m.
inline Mesh yard_mesh(std::uint64_t seed) {
  Random random(seed);
  Mesh m;
  m.name = "yard";
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) add_floor(m, i, j, i + 1.0, j + 1.0, 0.0);
  }
  for (int i = 0; i < 300; ++i) {
    const Vec3 at(random.between(1.0, 39.0), random.between(1.0, 39.0), 0.0);
    add_box(m, at, at + Vec3(random.between(0.1, 1.0), random.between(0.1, 1.0), random.between(0.2, 3.0)));
  }
  return m;
}

constexpr Vec3 middle(20.5, 20.5, 1.5);

/// x.roam in a folder of its own, which is served.
struct Served {
  explicit Served(const std::string& name, std::uint64_t seed = 1) : folder(name), mesh(yard_mesh(seed)), judge(mesh) {
    for (const char* proxy : {"http_proxy", "https_proxy", "all_proxy"}) ::unsetenv(proxy);
    made::store(root() / "x.roam", {&mesh, 1}, {.page_tiles = 8, .tile_triangles = 100});
  }
  [[nodiscard]] std::filesystem::path root() const { return folder.path() / "root"; }
  [[nodiscard]] std::string store() const { return (root() / "x.roam").string(); }

  made::Folder folder;
  Mesh mesh;
  Judge judge;
};

inline WebAccess patient(double seconds) {
  WebAccess web;
  web.patience = seconds;
  return web;
}
inline WebAccess following(double seconds) {
  WebAccess web = patient(seconds);
  web.redirects = true;
  return web;
}
inline WebAccess with_cache(const std::filesystem::path& file, std::uint64_t bytes) {
  WebAccess web = patient(2.0);
  web.cache = file;
  web.cache_bytes = bytes;
  return web;
}

inline std::shared_ptr<const Store> opened(const std::string& address, const WebAccess& web = patient(2.0)) {
  return Store::open(address, Store::usual_memory, web);
}

/// The message of an address that cannot be opened.
inline std::string refusal(const std::string& address, const WebAccess& web = patient(0.3)) {
  try {
    static_cast<void>(opened(address, web));
  } catch (const roam::Error& error) {
    return error.what();
  }
  return "no error";
}

/// All triangles and their numbers, as bytes.
inline std::string all_bytes(const Store& store) {
  std::string all;
  const auto add = [&](const auto& values) {
    all.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  };
  store.for_each_triangle(store.info().bounds, [&](auto triangles, auto ids) {
    add(triangles);
    add(ids);
  });
  return all;
}

/// Walks about. Every step waits until what the body reaches is known, so that nothing depends on time. Returns all
/// places and clearances as bytes.
inline std::string way_of(std::shared_ptr<const Store> store, std::uint64_t seed, int steps) {
  Pager pager(std::move(store), {.memory = Pager::least_memory});
  EXPECT_TRUE(pager.wait({0.3, 0.6}, middle, Vec3(0.0), 20.0, 2.0));
  Walker walker(pager, {}, Mode::walk, middle);
  Random random(seed);
  double heading = 0.0;
  std::string way;
  for (int i = 0; i < steps; ++i) {
    if (walker.report().blocked || random.chance(0.02)) heading = random.between(0.0, 6.28);
    walker.step({.velocity = {4.0 * std::cos(heading), 4.0 * std::sin(heading), 0.0}}, frame);
    const Vec3 at = walker.position();
    const double gap = pager.clearance(walker.body(), at, 1.0).distance;
    way.append(reinterpret_cast<const char*>(&at), sizeof at).append(reinterpret_cast<const char*>(&gap), sizeof gap);
    EXPECT_TRUE(pager.wait(walker.body(), at, walker.velocity(), 20.0, 2.0));
  }
  return way;
}

/// Walks about in real time, and judges every step by all triangles. Returns the length.
inline double judged_length(const Served& served, Pager& pager, std::uint64_t seed, int steps) {
  Random random(seed);
  static_cast<void>(pager.wait({0.3, 0.6}, middle, Vec3(0.0), 0.2));
  Walker walker(pager, {}, Mode::fly, middle);
  double heading = 0.0, length = 0.0;
  Vec3 before = walker.position();
  for (int i = 0; i < steps; ++i) {
    if (walker.report().blocked || random.chance(0.02)) heading = random.between(0.0, 6.28);
    walker.step({.velocity = {10.0 * std::cos(heading), 10.0 * std::sin(heading), 1.2 - walker.position().z}}, frame);
    if (!walker.report().held) {
      EXPECT_GE(margin(served.judge, walker.report(), walker.settings().radius), 0.0) << i;
    }
    length += glm::length(walker.position() - before);
    before = walker.position();
    static_cast<void>(pager.update(walker.body(), before, walker.velocity()));
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
  return length;
}

}  // namespace made
