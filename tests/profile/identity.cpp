// What has no identity, and what can have none.
#include <gtest/gtest.h>

#include <vector>

#include "messages.h"
#include "roam/profile.h"

namespace {

std::vector<roam::Mesh> hall_scene() {
  roam::Mesh mesh;
  mesh.name = "hall";
  mesh.vertices = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return {roam::Mesh{}, mesh};
}

TEST(ProfileIdentity, OfAMeshWithAVertexThatIsNotThereIsRefused) {
  auto meshes = hall_scene();
  meshes[1].triangles[1][2] = 99;
  const std::string said = error_of([&] { static_cast<void>(roam::identity_of(meshes)); });
  EXPECT_TRUE(contains(said, "triangle 1 of mesh 1 (\"hall\") uses vertex 99, but the mesh has 4 vertices")) << said;
}

TEST(ProfileIdentity, OfNoSceneBelongsToNone) {
  EXPECT_FALSE(roam::Profile{}.belongs_to({}));
  roam::Profile profile;
  EXPECT_FALSE(profile.belongs_to(roam::identity_of(hall_scene())));
  profile.scene = roam::identity_of(hall_scene());
  EXPECT_TRUE(profile.belongs_to(roam::identity_of(hall_scene())));
  EXPECT_FALSE(profile.belongs_to({}));
}

}  // namespace
