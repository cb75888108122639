// A tileset by its levels of detail: the levels that an eye is given, what is drawn meanwhile, and the memory they
// take.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <osg/NodeCallback>
#include <osg/Viewport>
#include <osgUtil/CullVisitor>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tileset_made.h"
#include "view/page_lod.h"
#include "view_driven.h"

namespace {

namespace fs = std::filesystem;
using namespace roam;
using namespace roam::app;
using test::MadeQuadtree;
using Names = std::set<std::string>;

constexpr float endless = std::numeric_limits<float>::max();

/// Notes when a node is drawn.
class Seen : public osg::NodeCallback {
 public:
  Seen(std::string name, Names& seen) : name_(std::move(name)), seen_(seen) {}
  void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
    seen_.insert(name_);
    traverse(node, visitor);
  }

 private:
  std::string name_;
  Names& seen_;
};

class Requests : public osg::NodeVisitor::DatabaseRequestHandler {
 public:
  void requestNodeFile(const std::string& file, osg::NodePath&, float priority, const osg::FrameStamp*,
                       osg::ref_ptr<osg::Referenced>&, const osg::Referenced*) override {
    wanted[file] = priority;
  }
  std::map<std::string, float> wanted;
};

/// Nodes of pages, drawn by a camera 200 pixels high with a field of view of 90 degrees: a metre at a distance of a
/// metre has 100 pixels.
struct Drawn {
  std::shared_ptr<PageRules> rules = std::make_shared<PageRules>(PageRules{16.0});
  Names seen;
  std::map<std::string, float> wanted;
  float scale = 1.0f;
  osg::Matrixd projection = osg::Matrixd::perspective(90, 1.5, 0.1, 1e4);
  osg::ref_ptr<osg::Viewport> viewport = new osg::Viewport(0, 0, 300, 200);
  unsigned frames = 0;

  osg::ref_ptr<osg::Group> group(const std::string& name) {
    osg::ref_ptr<osg::Group> made = new osg::Group;
    made->setCullCallback(new Seen(name, seen));
    // Nothing is drawn of a group without bounds.
    made->setInitialBound(osg::BoundingSphere(osg::Vec3(0, 0, 0), 50));
    return made;
  }
  /// A node whose error is 4 m, in a box of 20 m by 40 m by 60 m.
  osg::ref_ptr<PageLod> node(float own_to) {
    const DisplayPages pages{0, {0, 0, 0}, 38.0f, DisplayMeasure::error, {}, 4.0f, {10, 20, 30}};
    osg::ref_ptr<PageLod> made = new PageLod(pages, rules);
    made->addChild(group("own"));
    made->add_range(0.0f, own_to);
    made->setFileName(1, "page");
    made->add_range(1.0f, endless);
    return made;
  }
  /// A node of a radius of 38 m that is finer nearer than 25 m to its centre.
  osg::ref_ptr<PageLod> finer_within_25_m(DisplayMeasure measure) {
    const float pixels = 2.0f * 38.0f * 100.0f / 25.0f;
    const bool by_pixels = measure == DisplayMeasure::pixels;
    osg::ref_ptr<PageLod> made = new PageLod({0, {0, 0, 0}, 38.0f, measure, {}}, rules);
    made->addChild(group("own"));
    by_pixels ? made->add_range(0.0f, pixels) : made->add_range(25.0f, endless);
    made->addChild(group("finer"));
    by_pixels ? made->add_range(pixels, endless) : made->add_range(0.0f, 25.0f);
    return made;
  }
  /// The view from a place, looking at zero.
  Names from(osg::Node& node, const osg::Vec3d& eye) {
    seen.clear();
    const osg::ref_ptr<osgUtil::CullVisitor> cull = new osgUtil::CullVisitor;
    const osg::ref_ptr<Requests> requests = new Requests;
    const osg::ref_ptr<osg::FrameStamp> frame = new osg::FrameStamp;
    frame->setFrameNumber(++frames);
    cull->setDatabaseRequestHandler(requests);
    cull->setFrameStamp(frame);
    cull->setLODScale(scale);
    cull->pushViewport(viewport);
    cull->pushProjectionMatrix(new osg::RefMatrix(projection));
    const osg::Vec3d up(0, 0.1, 1);
    cull->pushModelViewMatrix(new osg::RefMatrix(osg::Matrixd::lookAt(eye, osg::Vec3d(0, 0, 0), up)),
                              osg::Transform::ABSOLUTE_RF);
    node.accept(*cull);
    wanted = requests->wanted;
    return seen;
  }
};

TEST(ViewLevels, AreChosenByTheErrorOnTheScreen) {
  Drawn d;
  const osg::ref_ptr<PageLod> node = d.node(1.0f);
  node->addChild(d.group("finer"));
  // 4 m * 100 pixels / 16 pixels: nearer than 25 m to the box.
  const Names own{"own"}, finer{"finer"};
  for (const auto& [eye, names] : std::vector<std::pair<osg::Vec3d, Names>>{{{10 + 24.9, 0, 0}, finer},
                                                                            {{10 + 25.1, 0, 0}, own},
                                                                            {{0, -20 - 24.9, 0}, finer},
                                                                            {{0, -20 - 25.1, 0}, own},
                                                                            {{5, 10, 30 + 24.9}, finer},
                                                                            {{5, 10, 30 + 25.1}, own},
                                                                            {{10 + 17, 20 + 17, 0}, finer},
                                                                            {{10 + 18, 20 + 18, 0}, own},
                                                                            {{9, 19, 29}, finer},
                                                                            {{500, 0, 0}, own}}) {
    EXPECT_EQ(d.from(*node, eye), names) << eye.x() << " " << eye.y() << " " << eye.z();
    EXPECT_TRUE(d.wanted.empty());
  }
  // A larger picture, as the session sets it for its tiles.
  d.scale = 0.5f;
  EXPECT_EQ(d.from(*node, {10 + 49, 0, 0}), finer);
  EXPECT_EQ(d.from(*node, {10 + 51, 0, 0}), own);
  d.scale = 1.0f;
  d.rules->allowed_error = 8.0;
  EXPECT_EQ(d.from(*node, {10 + 49, 0, 0}), finer);
  d.rules->allowed_error = 0.0;
  EXPECT_EQ(d.from(*node, {5000, 0, 0}), finer);
}

TEST(ViewLevels, ByPixelsAndByDistanceAreTheSameInAllPartsOfAPicture) {
  for (const DisplayMeasure measure : {DisplayMeasure::pixels, DisplayMeasure::metres}) {
    Drawn d;
    const osg::ref_ptr<PageLod> node = d.finer_within_25_m(measure);
    const auto look = [&](const char* part) {
      EXPECT_EQ(d.from(*node, {24.9, 0, 0}), Names{"finer"}) << part << int(measure);
      EXPECT_EQ(d.from(*node, {25.1, 0, 0}), Names{"own"}) << part << int(measure);
    };
    look("whole");
    d.viewport = new osg::Viewport(0, 0, 100, 100);
    for (const int column : {0, 1, 2}) {
      for (const int row : {0, 1}) {
        const double left = 0.1 * column - 0.15, lower = 0.1 * row - 0.1;
        d.projection = osg::Matrixd::frustum(left, left + 0.1, lower, lower + 0.1, 0.1, 1e4);
        look("part");
      }
    }
  }
}

TEST(ViewLevels, ByDistanceDoNotDependOnTheSizeOfThePicture) {
  Drawn d;
  const osg::ref_ptr<PageLod> node = d.finer_within_25_m(DisplayMeasure::metres);
  d.scale = 0.1f;
  EXPECT_EQ(d.from(*node, {24.9, 0, 0}), Names{"finer"});
  EXPECT_EQ(d.from(*node, {25.1, 0, 0}), Names{"own"});
  const osg::ref_ptr<PageLod> by_pixels = d.finer_within_25_m(DisplayMeasure::pixels);
  EXPECT_EQ(d.from(*by_pixels, {249, 0, 0}), Names{"finer"});
  EXPECT_EQ(d.from(*by_pixels, {251, 0, 0}), Names{"own"});
}

TEST(ViewLevels, KeepTheCoarserOneUntilTheFinerHasCome) {
  Drawn d;
  const osg::ref_ptr<PageLod> node = d.node(1.0f);
  EXPECT_EQ(d.from(*node, {15, 0, 0}), Names{"own"});
  ASSERT_EQ(d.wanted.size(), 1u);
  const float near = d.wanted.at("page");
  EXPECT_EQ(d.from(*node, {30, 0, 0}), Names{"own"});
  EXPECT_GT(near, d.wanted.at("page")) << "the nearest comes first";
  EXPECT_EQ(d.from(*node, {36, 0, 0}), Names{"own"});
  EXPECT_TRUE(d.wanted.empty());
}

TEST(ViewLevels, ShowTilesThatAreAddedWithThoseAbove) {
  Drawn d;
  const osg::ref_ptr<PageLod> node = d.node(endless);
  EXPECT_EQ(d.from(*node, {15, 0, 0}), Names{"own"});
  EXPECT_EQ(d.wanted.size(), 1u);
  node->addChild(d.group("added"));
  EXPECT_EQ(d.from(*node, {15, 0, 0}), (Names{"own", "added"}));
  EXPECT_EQ(d.from(*node, {36, 0, 0}), Names{"own"});
}

TEST(ViewLevels, OfAParallelViewAreThoseDrawnLast) {
  Drawn d;
  const osg::ref_ptr<PageLod> node = d.node(1.0f);
  const auto by_the_sun = [&] {
    const osg::Matrixd before = std::exchange(d.projection, osg::Matrixd::ortho(-100, 100, -100, 100, 0, 1000));
    const std::uint64_t changes = d.rules->changes;
    Names names = d.from(*node, {15, 0, 0});
    EXPECT_TRUE(d.wanted.empty()) << "it requests no page";
    EXPECT_EQ(d.rules->changes, changes);
    d.projection = before;
    return names;
  };
  const Names own{"own"}, finer{"finer"};
  EXPECT_EQ(by_the_sun(), own) << "before anything is drawn";
  EXPECT_EQ(d.from(*node, {15, 0, 0}), own);
  node->addChild(d.group("finer"));
  EXPECT_EQ(by_the_sun(), own);
  std::uint64_t changes = d.rules->changes;
  EXPECT_EQ(d.from(*node, {15, 0, 0}), finer);
  EXPECT_NE(std::exchange(changes, d.rules->changes), d.rules->changes);
  EXPECT_EQ(by_the_sun(), finer);
  EXPECT_EQ(d.from(*node, {15, 0, 0}), finer);
  EXPECT_EQ(changes, d.rules->changes);
  node->removeChild(1);
  EXPECT_EQ(by_the_sun(), own) << "the page has been dropped";
}

TEST(ViewLevels, AreDroppedOnlyIfTheyWereNotSeenForLong) {
  Drawn d;
  const osg::ref_ptr<PageLod> node = d.node(1.0f);
  node->addChild(d.group("finer"));
  node->setTimeStamp(1, 10.0);
  node->setFrameNumber(1, 100);
  osg::NodeList dropped;
  EXPECT_FALSE(node->removeExpiredChildren(1e6, 1'000'000, dropped)) << "there is room";
  d.rules->drop_before = 9.0;
  EXPECT_FALSE(node->removeExpiredChildren(1e6, 1'000'000, dropped));
  d.rules->drop_before = 11.0;
  EXPECT_TRUE(node->removeExpiredChildren(1e6, 1'000'000, dropped));
  EXPECT_FALSE(node->removeExpiredChildren(1e6, 1'000'000, dropped)) << "its own content stays";
  EXPECT_EQ(dropped.size(), 1u);
}

/// A session over a floor of many tiles.
class OverTiles : public DrivenSession {
 public:
  explicit OverTiles(const MadeQuadtree& made, std::uint64_t memory = 1ull << 30) {
    options.scene.scenes = {made.write(folder.file("tiles"))};
    options.mode = Mode::fly;
    options.at = {20, -20, 3, 0, -20};
    options.page_memory = memory;
    begin();
  }
  /// Draws until nothing more comes. Returns the most bytes that the pages had meanwhile.
  std::uint64_t settle() {
    std::uint64_t most = 0;
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    int quiet = 0;
    for (std::uint64_t events = 0; quiet < 60 && std::chrono::steady_clock::now() < end; ++quiet) {
      EXPECT_TRUE(session->frame());
      session->stage().draw();
      most = std::max(most, pages().bytes());
      if (std::exchange(events, pages().events()) != pages().events() || pages().is_reading()) quiet = 0;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return most;
  }
  void go_to(const Vec3& place) { session->roamer().walker()->place(place); }
  [[nodiscard]] const PageSource& pages() const { return session->scene().pages(); }
};

/// Many tiles are seen at once, so that a page is a small share of them.
const MadeQuadtree seen_from_far{.levels = 5, .quads = 12, .error = 64.0};

TEST(ViewLevels, StayWithinTheirMemoryOnAWalkOverTheWholeScene) {
  const std::vector<double> places{20.0, 90.0, 160.0, 230.0};
  std::uint64_t all = 0;
  {
    OverTiles unlimited(seen_from_far);
    for (const double y : places) {
      unlimited.go_to({20, -y, 3});
      all = std::max(all, unlimited.settle());
    }
    EXPECT_EQ(unlimited.pages().bytes(), all) << "there is room for what is not seen any more";
    EXPECT_EQ(unlimited.pages().coarser(), 1.0);
  }
  const std::uint64_t limit = all * 8 / 10, page = all / 10;
  OverTiles limited(seen_from_far, limit);
  for (const double y : places) {
    limited.go_to({20, -y, 3});
    EXPECT_LE(limited.settle(), limit + page) << y;
    EXPECT_GT(limited.pages().bytes(), limit / 4);
  }
  EXPECT_LT(limited.pages().coarser(), 2.0) << "what is not seen goes first";
  EXPECT_EQ(limited.pages().missing(), 0u);
}

TEST(ViewLevels, AreCoarserWhereWhatIsSeenDoesNotFit) {
  std::uint64_t all = 0;
  {
    OverTiles unlimited(seen_from_far);
    all = unlimited.settle();
  }
  OverTiles limited(seen_from_far, all / 3);
  limited.settle();
  EXPECT_LE(limited.pages().bytes(), all / 3 + all / 10);
  EXPECT_GT(limited.pages().coarser(), 1.0);
  const ViewReport report = limited.finish();
  std::string notes;
  for (const std::string& note : report.notes) notes += note + "\n";
  EXPECT_TRUE(contains(notes, "the picture is coarser than it could be")) << notes;
  EXPECT_GT(report.page_bytes, 0u);
}

/// A still of a tileset.
struct Still {
  Still() {
    use_no_settings(folder);
    unsetenv("ROAM_READER");
  }
  nlohmann::json take(const std::string& scene, const std::string& picture,
                      const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"view",   scene, "--headless", "--size",       "320x200",
                                       "--mode", "fly", "--json",     "--screenshot", folder.file(picture)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run_program(ROAM_PROGRAM, arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    return nlohmann::json::parse(result.out, nullptr, false);
  }
  /// Pixels of two pictures that an eye tells apart.
  [[nodiscard]] int differing(const std::string& a, const std::string& b) const {
    const Shot one(folder.file(a)), other(folder.file(b));
    int count = 0;
    for (int y = 0; y < one.height(); ++y) {
      for (int x = 0; x < one.width(); ++x) count += (one.at(x, y) - other.at(x, y)).length() > 0.02f;
    }
    return count;
  }
  TestFolder folder;
};

/// Films a walk of half a metre. Returns all that is said.
std::string film(const TestFolder& folder, const std::string& scene, const std::string& path,
                 const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"300",        ROAM_PROGRAM,
                                     "view",       scene,
                                     "--headless", "--size",
                                     "160x96",     "--json",
                                     "--path",     folder.write("p.path", path),
                                     "--record",   folder.file("film.mp4")};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ProgramResult result = run_program("/usr/bin/timeout", arguments);
  EXPECT_EQ(result.status, 0) << "124: it has no end. " << result.err;
  return result.out;
}

TEST(ViewLevels, OfAFilmOverFullMemoryComeToAnEnd) {
  const Still still;
  const std::string scene = seen_from_far.write(still.folder.file("tiles")).string();
  const std::string path = "20 -20 0.3\n20.5 -20 0.3\n";
  const std::string said = film(still.folder, scene, path, {"--page-memory", "400K"});
  EXPECT_TRUE(contains(said, "the picture is coarser than it could be")) << said;
  const std::string finest = film(still.folder, scene, path, {"--page-memory", "800K", "--tile-error", "0"});
  EXPECT_TRUE(contains(finest, "the picture is coarser than it could be")) << finest;
  EXPECT_FALSE(contains(finest, "not in the picture")) << "fewer are enough: " << finest;
}

TEST(ViewLevels, ByDistanceThatDoNotFitAreSaid) {
  const Still still;
  const std::string floor =
      "Geode {\nnum_drawables 1\nGeometry {\nPrimitives 1\n{\nDrawArrays QUADS 0 4\n}\nVertexArray Vec3Array 4\n{\n"
      "-20 -20 0\n20 -20 0\n20 20 0\n-20 20 0\n}\n}\n}\n";
  std::string root = "Group {\nnum_children 3\n";
  for (const char* page : {"a.osg", "b.osg", "c.osg"}) {
    still.folder.write(page, floor);
    root += std::string("PagedLOD {\nCenter 0 0 0\nRadius 30\nRangeList 2 {\n1e+9 1e+10\n0 1e+9\n}\nFileNameList 2 ") +
            "{\n\"\"\n\"" + page + "\"\n}\nnum_children 1\n" + floor + "}\n";
  }
  const std::string scene = still.folder.write("root.osg", root + "}\n");
  const std::string said = film(still.folder, scene, "0 0 0.3\n0.5 0 0.3\n", {"--page-memory", "1"});
  EXPECT_TRUE(contains(said, "some pages of the scene are not in the picture")) << said;
  EXPECT_FALSE(contains(said, "coarser than it could be")) << said;
}

TEST(ViewLevels, LookFromNearLikeTheWholeScene) {
  const Still still;
  const TestFolder& folder = still.folder;
  const std::vector<std::string> near{"--at", "100,-100,3,0,-60"}, far{"--at", "128,100,60,-90,-20"};
  MadeQuadtree made;
  const std::string levels = made.write(folder.file("levels")).string();
  made.only_finest = true;
  made.error = 1e6;  // shown from everywhere
  const std::string whole = made.write(folder.file("whole")).string();
  const auto with = [](std::vector<std::string> more, const char* error) {
    more.insert(more.end(), {"--tile-error", error});
    return more;
  };
  const auto near_levels = still.take(levels, "near.png", near), near_whole = still.take(whole, "near-whole.png", near);
  EXPECT_GT(Shot(folder.file("near.png")).colours(), 3u);
  EXPECT_EQ(still.differing("near.png", "near-whole.png"), 0);
  EXPECT_EQ(near_levels["missing_pages"], 0);

  // From far away it is coarser, unless that is not wanted.
  const auto far_levels = still.take(levels, "far.png", far), far_whole = still.take(whole, "far-whole.png", far);
  EXPECT_GT(still.differing("far.png", "far-whole.png"), 0);
  EXPECT_LT(far_levels["memory"]["page_bytes"], far_whole["memory"]["page_bytes"]);
  still.take(levels, "far-0.png", with(far, "0"));
  EXPECT_EQ(still.differing("far-0.png", "far-whole.png"), 0);
}

TEST(ViewLevels, OfADamagedTileAreCoarserThereAndSaid) {
  const Still still;
  const TestFolder& folder = still.folder;
  const MadeQuadtree made;
  const std::string tileset = made.write(folder.file("tiles")).string();
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) std::ofstream(folder.file("tiles/" + MadeQuadtree::file(3, x, y))) << "b3dm";
  }
  const auto report = still.take(tileset, "shot.png", {"--at", "100,-100,3,0,-60"});
  EXPECT_GE(report["missing_pages"], 1);
  EXPECT_TRUE(contains(all(report["notes"]), "could not be read: coarser ones are shown there")) << report["notes"];
  // The level above has no hole.
  MadeQuadtree coarse = made;
  coarse.levels = 3;
  still.take(coarse.write(folder.file("coarse")).string(), "coarse.png", {"--at", "100,-100,3,0,-60"});
  EXPECT_EQ(still.differing("shot.png", "coarse.png"), 0);
}

}  // namespace
