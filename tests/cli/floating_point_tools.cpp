// Training, stores and made scenes in every floating-point environment of a host.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "roam/generate.h"
#include "roam/pager.h"
#include "roam/probe.h"
#include "roam/profile.h"
#include "roam/size_learner.h"
#include "roam/train.h"
#include "same_bits.h"
#include "store_builds.h"
#include "store_made.h"
#include "words/probe.h"

namespace {

using roam::Vec3;
using same_bits::Bits;
using same_bits::expect_same;

void add_box(roam::Mesh& mesh, const Vec3& a, const Vec3& b) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back({(i & 1) != 0 ? b.x : a.x, (i & 2) != 0 ? b.y : a.y, (i & 4) != 0 ? b.z : a.z});
  }
  for (const auto& side : {std::array{0U, 1U, 3U, 2U},
                           {4U, 5U, 7U, 6U},
                           {0U, 1U, 5U, 4U},
                           {2U, 3U, 7U, 6U},
                           {0U, 2U, 6U, 4U},
                           {1U, 3U, 7U, 5U}}) {
    mesh.triangles.push_back({first + side[0], first + side[1], first + side[2]});
    mesh.triangles.push_back({first + side[0], first + side[2], first + side[3]});
  }
}

/// Two rooms and a door of 0.81 m between them.
roam::Mesh rooms() {
  roam::Mesh mesh;
  add_box(mesh, {-3.1, -2.2, 0.0}, {3.1, 2.2, 2.6});
  add_box(mesh, {-0.1, -2.2, 0.0}, {0.1, -0.41, 2.6});
  add_box(mesh, {-0.1, 0.4, 0.0}, {0.1, 2.2, 2.6});
  return mesh;
}

void add(Bits& bits, const roam::Passage& passage) {
  bits(passage.radius);
  bits(passage.bound);
  bits(passage.length);
  for (const Vec3& place : passage.way) bits(place);
}

TEST(FloatingPoint, WaysAndTraining) {
  const std::vector<roam::Mesh> meshes{rooms()};
  const Vec3 from(-1.7, 0.3, 0.9), to(1.9, -0.6, 0.9);
  roam::TrainOptions training;
  training.paths = 2;
  roam::ProbeQuestion question;
  question.from = from;
  question.to = to;
  const std::vector<roam::ProbedSize> sizes{{0.3, 1.8}, {0.45, 1.8}};
  expect_same([&](Bits& bits) {
    const roam::Survey survey = roam::Survey::build(meshes);
    for (const roam::TriangleId id : survey.floor_triangles()) bits(id);
    add(bits, roam::widest_way(survey, from, to));
    add(bits, roam::widest_way(survey, from, to, {.mode = roam::Mode::fly}));
    const roam::Training trained = roam::train(survey, training);
    bits(trained.radius);
    bits(trained.smallest);
    bits(trained.largest.value_or(-1.0));
    for (const roam::ProbeAnswer& answer : roam::probe(survey, question, sizes)) {
      bits(static_cast<std::uint64_t>(answer.passable));
      bits(answer.missing);
      add(bits, answer.passage);
      for (const char c : roam::words::report(question, answer).sentences()) bits(static_cast<std::uint64_t>(c));
    }
  });
}

TEST(FloatingPoint, MadeScenes) {
  const auto all = [](Bits& bits, const roam::generate::Scene& scene) {
    for (const roam::Mesh& mesh : roam::generate::collect(scene)) {
      for (const Vec3& v : mesh.vertices) bits(v);
    }
  };
  expect_same([&](Bits& bits) {
    all(bits, roam::generate::gallery({.triangles = 20000}));
    all(bits, roam::generate::terrain({.triangles = 10000}));
    all(bits, roam::generate::city({.triangles = 20000}));
  });
}

TEST(FloatingPoint, Stores) {
  const made::Folder folder("floating_point");
  const std::string scene =
      store_builds::write_ply(folder.path() / "field.ply", store_builds::field(120, 0.37, Vec3(0.1)));
  // The library of C++ reckons when it joins paths, so that is done before.
  std::vector<roam::StoreBuildOptions> builds;
  for (std::size_t i = 0; i <= host::environments().size(); ++i) {
    builds.push_back(store_builds::options({scene}, folder.path() / ("store" + std::to_string(i))));
  }
  std::size_t count = 0;
  const roam::Body body{0.3, 0.5};
  const Vec3 place(12.3, 21.7, 1.9), motion(1.3, 0.7, -2.9);
  expect_same([&](Bits& bits) {
    const roam::StoreBuildOptions& build = builds.at(count++);
    const auto& output = build.output;
    static_cast<void>(roam::build_store(build));
    bits(static_cast<std::uint64_t>(roam::verify_store(output).whole()));
    const auto store = roam::Store::open(output);
    bits(store->info().bounds.lower);
    bits(store->info().bounds.upper);
    bits(store->info().largest_error);
    for (const Vec3& sample : store->sample(5)) bits(sample);
    roam::Pager pager(store, {.memory = 64U << 20});
    bits(static_cast<std::uint64_t>(pager.wait(body, place, motion, 20.0, 3.0)));
    bits(pager.sweep(body, place, motion));
    bits(pager.clearance(body, place, 2.0));
    bits(pager.gap_bound(body, place, motion, 2.0));
    roam::Contact contacts[8];
    for (std::size_t i = pager.contacts(body, place, motion, 2.0, contacts); i-- > 0;) bits(contacts[i]);
  });
  for (const roam::StoreBuildOptions& build : builds) store_builds::expect_same(builds[0].output, build.output);
}

}  // namespace
