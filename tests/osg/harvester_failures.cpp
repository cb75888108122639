// What a harvester cannot bring: it is told, the rest comes, and nothing becomes solid or free that should not.

#include "paged_files.h"
#include "roam/error.h"

namespace {

using osgRoam::Harvester;
using paged_files::group;
using paged_files::slab;
using paged_files::tile;
using roam::Vec3;
using OsgHarvesterFailures = paged_files::PagedFiles;

TEST_F(OsgHarvesterFailures, TellsWhatIsMissingOrBroken) {
  write("root.osgt", *group({tile(0, slab(0, 1, "coarse"), "gone.osgt"), tile(30, nullptr, "broken.osgt")}));
  folder_.write("broken.osgt", "#Ascii Scene\n#Version 161\nosg::Gr");
  start();
  ASSERT_TRUE(read("root.osgt"));
  for (int i = 0; i < 3; ++i) {  // a pager asks again and again
    EXPECT_FALSE(read("gone.osgt"));
    read("broken.osgt");
  }
  EXPECT_EQ(below(0), "coarse 1");
  const Harvester::Stats stats = harvester_->getStats();
  ASSERT_GE(stats.failed, 1u);
  EXPECT_EQ(stats.failedFiles[0], path("gone.osgt"));
  EXPECT_EQ(stats.expected, 0u);
  // It may come after all.
  write("gone.osgt", *slab(0, 3, "late"));
  ASSERT_TRUE(read("gone.osgt"));
  EXPECT_EQ(below(0), "late 3");
  EXPECT_EQ(harvester_->getStats().failed, stats.failed - 1);
}

TEST_F(OsgHarvesterFailures, LeavesOutWhatIsUnderATransformThatIsNotFinite) {
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    space_ = std::make_shared<roam::Patchwork>();
    osg::ref_ptr<osg::MatrixTransform> nowhere = new osg::MatrixTransform(osg::Matrixd::translate(0, bad, 0));
    nowhere->addChild(tile(0, slab(0, 1, "coarse"), path("one.osgt")));
    write("one.osgt", *slab(0, 3, "fine"));
    start();
    harvester_->add(*group({nowhere, slab(30, 0, "floor")}));
    EXPECT_EQ(below(30), "floor 0");
    EXPECT_EQ(below(0), "nothing");
    EXPECT_EQ(harvester_->getStats().leftOut, 2u);
    EXPECT_EQ(harvester_->getStats().failed, 1u);
    EXPECT_EQ(harvester_->getStats().failedFiles, std::vector<std::string>{path("one.osgt")});
    EXPECT_EQ(harvester_->getStats().expected, 0u);
    ASSERT_TRUE(read("one.osgt"));
    EXPECT_EQ(below(0), "nothing") << "it is no root";
  }
}

TEST_F(OsgHarvesterFailures, GivesWhatHasNoSphereTheBoxOfTheFileThatNamesItOrNone) {
  const auto sizeless = [](const std::string& file) {
    osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
    lod->setFileName(0, file);
    lod->setRange(0, 0.0f, 1e9f);
    return lod;
  };
  write("root.osgt", *group({slab(30, 0, "floor"), sizeless("free.osgt"), tile(0, nullptr, "one.osgt")}));
  write("one.osgt", *group({sizeless("two.osgt")}));
  write("two.osgt", *slab(0, 3, "fine"));
  write("free.osgt", *slab(60, 2, "free"));
  start();
  ASSERT_TRUE(read("root.osgt"));
  EXPECT_EQ(below(30), "floor 0");
  EXPECT_EQ(below(60), "nothing");
  EXPECT_EQ(harvester_->getStats().failed, 1u);
  ASSERT_TRUE(read("one.osgt"));
  EXPECT_EQ(below(0), "? 8");
  ASSERT_TRUE(read("two.osgt"));
  EXPECT_EQ(below(0), "fine 3");
  ASSERT_TRUE(read("free.osgt"));
  EXPECT_EQ(below(60), "free 2");
  EXPECT_EQ(harvester_->getStats().failed, 0u);
  EXPECT_EQ(harvester_->getStats().expected, 0u);
}

/// Stored less exactly than a patchwork takes.
osg::ref_ptr<osg::Geometry> vast() {
  const osg::ref_ptr<osg::Geometry> geometry = slab(0, 5, "vast");
  auto& vertices = *static_cast<osg::Vec3Array*>(geometry->getVertexArray());
  vertices[0] = {0.123f, 0.456f, 0.789f};
  for (int i = 1; i < 4; ++i) vertices[i] *= 2e7f;
  return geometry;
}

TEST_F(OsgHarvesterFailures, BringsTheRestOfAFileWhereAPartCannotCome) {
  write("root.osgt", *group({tile(0, vast(), "one.osgt"), tile(30, slab(30, 1, "coarse"), "two.osgt")}));
  write("one.osgt", *slab(0, 3, "fine"));
  start();
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(read("root.osgt"));
    space_->update();
    EXPECT_EQ(space_->stats().triangles, 2u);
    EXPECT_EQ(space_->stats().failed, 1u);
    EXPECT_EQ(space_->stats().unknown, 1u);
    EXPECT_EQ(space_->stats().coming, 2u) << "nothing is expected twice";
    EXPECT_EQ(harvester_->getStats().failed, 1u);
    EXPECT_EQ(harvester_->getStats().expected, 2u);
  }
  const roam::Impact inside = space_->sweep({0.25}, {0, 0, 1e5}, Vec3(0.0));
  ASSERT_TRUE(inside.unknown);
  EXPECT_NE(space_->object_name(inside.triangle).find("1 mm"), std::string::npos);
  ASSERT_TRUE(read("one.osgt"));
  EXPECT_EQ(below(0), "fine 3");
}

TEST_F(OsgHarvesterFailures, ThrowsNothingWhereASubstituteCannotCome) {
  write("root.osgt", *tile(0, vast(), "gone.osgt"));
  start(Harvester::FINEST_ONLY);
  ASSERT_TRUE(read("root.osgt"));
  EXPECT_NO_THROW(EXPECT_FALSE(read("gone.osgt")));
  space_->update();
  EXPECT_EQ(space_->stats().failed, 1u);
  write("gone.osgt", *slab(0, 3, "late"));
  ASSERT_TRUE(read("gone.osgt"));
  EXPECT_EQ(below(0), "late 3");
}

TEST_F(OsgHarvesterFailures, SaysOfAGraphWhatCouldNotCome) {
  start();
  EXPECT_THROW(harvester_->add(*group({vast(), tile(30, slab(30, 1, "coarse"), "two.osgt")})), roam::Error);
  space_->update();
  EXPECT_EQ(space_->stats().triangles, 2u);
  EXPECT_EQ(space_->stats().failed, 1u);
}

}  // namespace
