// Where memory runs out while a file is harvested, nothing is thrown into the pager's thread, and the file may be read
// again. Instrumented builds have an operator new of their own.
#include "counted_allocations.h"
#include "paged_files.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

using osgRoam::Harvester;

/// Has the file already; OpenSceneGraph's own allocations are no matter of this.
class Given : public osgDB::ReadFileCallback {
 public:
  explicit Given(osg::Node* node) : node_(node) {}
  osgDB::ReaderWriter::ReadResult readNode(const std::string&, const osgDB::Options*) override {
    const long failing = failing_allocation.exchange(0);
    osgDB::ReaderWriter::ReadResult result(node_.get());
    failing_allocation = failing;
    return result;
  }

 private:
  osg::ref_ptr<osg::Node> node_;
};

TEST(OsgHarvesterAllocations, NothingIsThrownAndTheFileMayBeReadAgain) {
  const osg::ref_ptr<Given> given =
      new Given(paged_files::group({paged_files::tile(0, paged_files::slab(0, 1, "coarse"), "fine.osgt")}).get());
  const std::string file = "root.osgt";
  for (const bool all : {false, true}) {
    SCOPED_TRACE(all ? "and all that follow" : "alone");
    long failed = 0;
    for (bool more = true; more;) {
      const auto space = std::make_shared<roam::Patchwork>();
      const osg::ref_ptr<Harvester> harvester = new Harvester(space);
      harvester->setNextCallback(given);
      allocations = 0;
      failing_on = all;
      failing_allocation = ++failed;
      EXPECT_NO_THROW(harvester->readNode(file, nullptr)) << failed;
      more = allocations >= failed;
      failing_allocation = 0;
      failing_on = false;
      harvester->readNode(file, nullptr);
      EXPECT_LE(harvester->getStats().expected, 1U) << failed << ": all but what is to refine it has come, or failed";
    }
    EXPECT_GT(failed, 30);
  }
}

}  // namespace

#endif
