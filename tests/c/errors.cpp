// Wrong arguments give a status and a text, never a crash.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <thread>

#include "c/structs.h"
#include "c_rig.h"
#include "roam/version.h"

namespace {

TEST(CErrors, TheLibrarySaysItsVersion) {
  EXPECT_EQ(roam_interface(), std::uint32_t{ROAM_INTERFACE});
  EXPECT_STREQ(roam_version(), ROAM_VERSION_STRING);
}

TEST(CErrors, NullIsRefused) {
  const c_rig::Room room;
  roam_query query{};
  query.size = sizeof query;
  roam_impact impact{};
  impact.size = sizeof impact;
  EXPECT_EQ(roam_sweep(nullptr, &query, &impact), ROAM_INVALID);
  EXPECT_STREQ(roam_error(), "the space is NULL; it is needed");
  EXPECT_EQ(roam_sweep(room.handle, nullptr, &impact), ROAM_INVALID);
  EXPECT_EQ(roam_sweep(room.handle, &query, nullptr), ROAM_INVALID);
  EXPECT_EQ(roam_world_open(nullptr, nullptr, nullptr), ROAM_INVALID);
  EXPECT_EQ(roam_walker_step(nullptr, nullptr, 1.0, nullptr), ROAM_INVALID);
  EXPECT_EQ(roam_probe(nullptr, nullptr, nullptr, nullptr), ROAM_INVALID);
  EXPECT_EQ(roam_object_name(nullptr, 0, nullptr, 0), 0u);
  roam_space_free(nullptr);
  roam_walker_free(nullptr);
  roam_survey_free(nullptr);
  roam_profile_free(nullptr);
  roam_path_free(nullptr);
}

TEST(CErrors, AProgramOfAnEarlierVersionHasFewerMembers) {
  roam_store_options earlier{};
  earlier.size = offsetof(roam_store_options, cache);
  earlier.horizon = 5.0;
  earlier.cache = "of something else that lies there";
  EXPECT_EQ(roam::c::given(&earlier, "roam_store_options").horizon, 5.0);
  EXPECT_EQ(roam::c::given(&earlier, "roam_store_options").cache, nullptr);
  earlier.size -= 1;
  EXPECT_THROW((void)roam::c::given(&earlier, "roam_store_options"), roam::c::Invalid);
}

TEST(CErrors, ACacheIsForWebServersAndHasASize) {
  roam_store_options options{};
  options.size = sizeof options;
  options.cache = "web.cache";
  options.cache_bytes = 1;
  roam_space* store = nullptr;
  EXPECT_EQ(roam_store_open("http://127.0.0.1:1/x.roam", &options, &store), ROAM_INVALID);
  EXPECT_NE(std::string(roam_error()).find("4 MiB"), std::string::npos) << roam_error();
  options.cache = nullptr;
  options.patience = -1.0;
  EXPECT_EQ(roam_store_open("http://127.0.0.1:1/x.roam", &options, &store), ROAM_INVALID);
  EXPECT_NE(std::string(roam_error()).find("patience"), std::string::npos) << roam_error();
}

TEST(CErrors, AServerThatIsWaitedForCanBeLeft) {
  roam_store_options options{};
  options.size = sizeof options;
  options.progress = [](double done, void*) { return done == 0.0 ? 1 : 0; };
  roam_space* store = nullptr;
  EXPECT_EQ(roam_store_open("http://127.0.0.1:1/x.roam", &options, &store), ROAM_CANCELLED) << roam_error();
}

TEST(CErrors, AddressesOfTheWrongKind) {
  roam_space* space = nullptr;
  EXPECT_NE(roam_world_open("http://127.0.0.1:1/x.roam?sig=SECRET", nullptr, &space), ROAM_OK);
  EXPECT_NE(std::string(roam_error()).find("opened as a store"), std::string::npos) << roam_error();
  EXPECT_EQ(std::string(roam_error()).find("SECRET"), std::string::npos) << roam_error();
  EXPECT_EQ(roam_store_open("ftp://127.0.0.1:1/x.roam", nullptr, &space), ROAM_NOT_FOUND);
  EXPECT_NE(std::string(roam_error()).find("read by http:// and https://"), std::string::npos) << roam_error();
  EXPECT_EQ(roam_store_open("", nullptr, &space), ROAM_NOT_FOUND);
  EXPECT_NE(std::string(roam_error()).find("the name of a store is empty"), std::string::npos) << roam_error();
}

TEST(CErrors, StructsOfOtherVersions) {
  const c_rig::Room room;
  roam_impact impact{};
  impact.size = sizeof impact;
  roam_query query{};
  EXPECT_EQ(roam_sweep(room.handle, &query, &impact), ROAM_INVALID);
  EXPECT_STREQ(roam_error(), "roam_query has the size 0; set its member `size` to sizeof (88)");

  struct Later {
    roam_query query;
    double unknown_member;
  } later{};
  later.query.size = sizeof later;
  EXPECT_EQ(roam_sweep(room.handle, &later.query, &impact), ROAM_OK);
  later.unknown_member = 1.0;
  EXPECT_EQ(roam_sweep(room.handle, &later.query, &impact), ROAM_INVALID);

  struct LaterImpact {
    roam_impact impact;
    double unknown_member;
  } result{};
  result.impact.size = sizeof result;
  result.unknown_member = 7.0;
  later.unknown_member = 0.0;
  ASSERT_EQ(roam_sweep(room.handle, &later.query, &result.impact), ROAM_OK);
  EXPECT_EQ(result.unknown_member, 7.0);
  EXPECT_EQ(result.impact.size, sizeof result);
}

TEST(CErrors, FailuresWriteNothing) {
  const c_rig::Room room;
  roam_query query{};
  query.size = sizeof query;
  query.radius = -1.0;
  roam_impact impact;
  std::memset(&impact, 0x5A, sizeof impact);
  impact.size = sizeof impact;
  const roam_impact before = impact;
  EXPECT_EQ(roam_sweep(room.handle, &query, &impact), ROAM_INVALID);
  EXPECT_EQ(std::memcmp(&impact, &before, sizeof impact), 0);
  roam_space* world = room.handle;
  EXPECT_EQ(roam_world_open("/nowhere/house.obj", nullptr, &world), ROAM_NOT_FOUND);
  EXPECT_EQ(world, room.handle);
}

TEST(CErrors, FilesAndFolders) {
  const c_rig::Room room;
  roam_space* space = nullptr;
  EXPECT_EQ(roam_world_open("/nowhere/house.obj", nullptr, &space), ROAM_NOT_FOUND);
  EXPECT_NE(std::string(roam_error()).find("/nowhere/house.obj"), std::string::npos) << roam_error();
  const std::string empty = (room.folder.path() / "empty.obj").string();
  std::ofstream(empty) << "\n";
  EXPECT_EQ(roam_world_open(empty.c_str(), nullptr, &space), ROAM_UNREADABLE);
  EXPECT_EQ(roam_store_open("/nowhere/house.roam", nullptr, &space), ROAM_NOT_FOUND);
  EXPECT_EQ(roam_store_open(room.folder.path().c_str(), nullptr, &space), ROAM_UNREADABLE);
  roam_profile* profile = nullptr;
  EXPECT_EQ(roam_profile_beside("/nowhere/house.obj", &profile), ROAM_NOT_FOUND);
}

TEST(CErrors, MeshesThatAreWrong) {
  roam_mesh mesh = c_rig::of(c_rig::room_meshes()[0]);
  const double vertices[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::uint32_t triangle[3] = {0, 1, 3};
  mesh.name = "leaf";
  mesh.vertices = vertices;
  mesh.vertex_count = 3;
  mesh.triangles = triangle;
  mesh.triangle_count = 1;
  roam_space* world = nullptr;
  EXPECT_EQ(roam_world_build(&mesh, 1, nullptr, &world), ROAM_INVALID);
  EXPECT_NE(std::string(roam_error()).find("leaf"), std::string::npos) << roam_error();
  triangle[2] = 2;
  // More than any machine has, in one triangle repeated.
  mesh.triangle_stride = 0;
  mesh.triangle_count = std::size_t{1} << 50;
  EXPECT_EQ(roam_world_build(&mesh, 1, nullptr, &world), ROAM_NO_MEMORY);
  EXPECT_EQ(roam_world_build(nullptr, 0, nullptr, &world), ROAM_OK);
  roam_space_free(world);
}

TEST(CErrors, ANullForTheResultIsSeenFirst) {
  EXPECT_EQ(roam_profile_load("/nowhere/house.json", nullptr), ROAM_INVALID);
  EXPECT_STREQ(roam_error(), "the address for the profile is NULL; it is needed");
  EXPECT_EQ(roam_walker_copy(nullptr, nullptr), ROAM_INVALID);
  EXPECT_STREQ(roam_error(), "the address for the walker is NULL; it is needed");
}

TEST(CErrors, EachThreadHasItsText) {
  roam_space* world = nullptr;
  EXPECT_EQ(roam_world_open("/nowhere/a.obj", nullptr, &world), ROAM_NOT_FOUND);
  std::thread([] { EXPECT_STREQ(roam_error(), ""); }).join();
  EXPECT_NE(std::string(roam_error()), "");
}

}  // namespace
