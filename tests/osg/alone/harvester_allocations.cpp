// Where memory runs out while a file is harvested, nothing is thrown into the pager's thread, and the file may be read
// again. Instrumented builds have an operator new of their own.
#include "fallible_calls.h"
#include "paged_files.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

using osgRoam::Harvester;

/// Has the file already; OpenSceneGraph's own allocations are no matter of this.
class Given : public osgDB::ReadFileCallback {
 public:
  explicit Given(osg::Node* node) : node_(node) {}
  osgDB::ReaderWriter::ReadResult readNode(const std::string&, const osgDB::Options*) override {
    const Spare spare;
    return {node_.get()};
  }

 private:
  osg::ref_ptr<osg::Node> node_;
};

TEST(OsgHarvesterAllocations, NothingIsThrownAndTheFileMayBeReadAgain) {
  const osg::ref_ptr<Given> given =
      new Given(paged_files::group({paged_files::tile(0, paged_files::slab(0, 1, "coarse"), "fine.osgt")}).get());
  const std::string file = "root.osgt";
  std::shared_ptr<roam::Patchwork> space;
  osg::ref_ptr<Harvester> harvester;
  const auto begin = [&](bool failed) {
    EXPECT_FALSE(failed) << "thrown";
    if (harvester) {
      harvester->readNode(file, nullptr);
      EXPECT_LE(harvester->getStats().expected, 1U) << "all but what is to refine it has come, or failed";
    }
    space = std::make_shared<roam::Patchwork>();
    harvester = new Harvester(space);
    harvester->setNextCallback(given);
  };
  begin(false);
  fail_calls({{.name = "readNode",
               .bits =
                   [&] {
                     harvester->readNode(file, nullptr);
                     return std::string("read");
                   },
               .after = begin,
               .throws = false}});
}

}  // namespace

#endif
