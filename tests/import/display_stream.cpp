// What a reader sends of a scene to be seen is checked value by value: a hostile one ends the reading, and no more.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "display_part_made.h"
#include "import/part_format.h"
#include "import/part_receiver.h"
#include "import/stream.h"
#include "memory_cost.h"
#include "shown_scene.h"

namespace roam::test {
namespace {

using namespace reader;

constexpr std::uint64_t unlimited = ~std::uint64_t{0};

/// How a part is damaged; empty where it is not.
std::string damage_of(const std::vector<std::byte>& bytes, std::uint64_t triangles) {
  DisplayPart part;
  part.triangles = triangles;
  try {
    decode(bytes, part, unlimited);
  } catch (const StreamReceiver::StreamDamaged& damage) {
    return damage.how;
  }
  EXPECT_TRUE(is_valid(part));
  return "";
}
std::string damage_of(const DisplayPart& part) { return damage_of(encode(part), part.triangles); }

TEST(ImportDisplayStream, BringsEveryValue) {
  const DisplayPart sent = full_part();
  DisplayPart part;
  part.triangles = sent.triangles;
  decode(encode(sent), part, unlimited);
  EXPECT_TRUE(is_valid(part));
  EXPECT_EQ(encode(part), encode(sent));
  EXPECT_EQ(part.pages[1].levels[2].page, "two");
  EXPECT_EQ(part.objects[1], "door");
  EXPECT_EQ(part.geometries[1].runs[0].object, 1u);
  EXPECT_EQ(part.textures[1].bytes.size(), 16u * (2 + 1 + 1 + 1));
  EXPECT_EQ(part.geometries[1].normals[3], glm::vec3(0, 0, 1));
}

TEST(ImportDisplayStream, RefusesWhatIsNoValue) {
  const auto with = [](auto change) {
    DisplayPart part = full_part();
    change(part);
    return damage_of(part);
  };
  const float nan = std::nanf("");
  EXPECT_EQ(with([](DisplayPart&) {}), "");
  EXPECT_EQ(with([](DisplayPart& p) { p.textures[0].width = 0; }), "an image of no size");
  EXPECT_EQ(with([](DisplayPart& p) { p.textures[0].height = 16385; }), "an image of no size");
  EXPECT_EQ(with([](DisplayPart& p) { p.textures[0].width = 3; }), "an image of another size");
  EXPECT_EQ(with([](DisplayPart& p) { p.textures[0].texels = DisplayTexels::rgba; }), "an image of another size");
  EXPECT_EQ(with([](DisplayPart& p) { p.textures[1].levels = 3; }), "an image of other levels");
  EXPECT_EQ(with([](DisplayPart& p) { p.textures[0].up = DisplayWrap(3); }), "a value of no meaning");
  EXPECT_EQ(with([](DisplayPart& p) { p.textures[0].texels = DisplayTexels(8); }), "a value of no meaning");
  EXPECT_EQ(with([](DisplayPart& p) { p.looks[1].texture = 2; }), "a look without its image");
  EXPECT_EQ(with([](DisplayPart& p) { p.looks[2].gloss_texture = 2; }), "a look without its image");
  EXPECT_EQ(with([](DisplayPart& p) { p.looks[2].emission_texture = 7; }), "a look without its image");
  EXPECT_EQ(with([&](DisplayPart& p) { p.looks[1].cutoff = nan; }), "a value of no meaning");
  EXPECT_EQ(with([&](DisplayPart& p) { p.looks[1].roughness = nan; }), "a value of no meaning");
  EXPECT_EQ(with([](DisplayPart& p) { p.looks[0].metalness = 1.5f; }), "a value of no meaning");
  EXPECT_EQ(with([](DisplayPart& p) { p.geometries[0].look = 3; }), "a geometry without a place");
  EXPECT_EQ(with([](DisplayPart& p) { p.geometries[0].group = 3; }), "a geometry without a place");
  EXPECT_EQ(with([](DisplayPart& p) { p.geometries[0].indices[5] = 4; }), "a triangle of vertices that are not there");
  EXPECT_EQ(with([](DisplayPart& p) { p.geometries[0].indices.pop_back(); }), "a geometry that is not whole");
  EXPECT_EQ(with([](DisplayPart& p) { p.geometries[1].runs[0].object = 2; }), "triangles of no object");
  EXPECT_EQ(with([](DisplayPart& p) { p.geometries[1].runs[0].triangles = 2; }), "triangles of no object");
  EXPECT_EQ(with([](DisplayPart& p) { p.geometries[1].runs.pop_back(); }), "triangles of no object");
  EXPECT_EQ(with([](DisplayPart& p) { p.objects[0].assign(DisplayPart::name_limit + 1, 'x'); }),
            "a list that is too long");
  EXPECT_EQ(with([](DisplayPart& p) { p.geometries[0].colours.pop_back(); }), "a geometry that is not whole");
  EXPECT_EQ(with([](DisplayPart& p) { p.geometries[1].normals.pop_back(); }), "a geometry that is not whole");
  EXPECT_EQ(with([](DisplayPart& p) { p.geometries[1].coordinates.clear(); }), "a geometry that is not whole");
  EXPECT_EQ(with([&](DisplayPart& p) { p.geometries[0].positions[1].y = nan; }), "a place beyond all scenes");
  EXPECT_EQ(with([](DisplayPart& p) { p.geometries[0].positions[1].y = 5e9f; }), "a place beyond all scenes");
  EXPECT_EQ(with([](DisplayPart& p) { p.geometries[0].cell.z = 1e300; }), "a place beyond all scenes");
  EXPECT_EQ(with([&](DisplayPart& p) { p.geometries[1].normals[0].x = nan; }), "a number that is none");
  EXPECT_EQ(with([](DisplayPart& p) { p.triangles = 7; }), "a part of other triangles");
  EXPECT_EQ(with([](DisplayPart& p) { p.groups = 4; }), "groups that are no tree");
  EXPECT_EQ(with([](DisplayPart& p) { p.groups = 0; }), "groups that are no tree");
  EXPECT_EQ(with([](DisplayPart& p) { p.groups = 0xffffffff; }), "groups that are no tree");
  EXPECT_EQ(with([](DisplayPart& p) { p.pages[1].levels[0].group = 1; }), "groups that are no tree");
  EXPECT_EQ(with([](DisplayPart& p) { std::swap(p.pages[0], p.pages[1]); }), "pages without a place");
  EXPECT_EQ(with([&](DisplayPart& p) { p.pages[0].radius = nan; }), "pages without a size");
  EXPECT_EQ(with([&](DisplayPart& p) { p.pages[0].error = nan; }), "pages without a size");
  EXPECT_EQ(with([&](DisplayPart& p) { p.pages[0].half.y = -1.0f; }), "pages without a size");
  EXPECT_EQ(with([&](DisplayPart& p) { p.pages[0].levels[0].from = nan; }), "a number that is none");
  EXPECT_EQ(with([](DisplayPart& p) { p.pages[0].levels[1].page.assign(4097, 'x'); }), "a list that is too long");
  EXPECT_EQ(with([](DisplayPart& p) { p.pages[0].levels[1].page.clear(); }), "a level of nothing");
  EXPECT_EQ(with([](DisplayPart& p) { std::swap(p.pages[0].levels[0], p.pages[0].levels[1]); }), "a level of nothing");
}

TEST(ImportDisplayStream, RefusesGroupsThatAreNestedWithoutEnd) {
  DisplayPart part;
  part.groups = 1000;
  for (std::uint32_t i = 0; i + 1 < part.groups; ++i)
    part.pages.push_back({i, {}, 1.0f, DisplayMeasure::metres, {{0, 1, i + 1, {}}}});
  EXPECT_EQ(damage_of(part), "pages without a place");
}

TEST(ImportDisplayStream, SurvivesEveryFlippedBitAndEveryTruncation) {
  const DisplayPart part = full_part();
  const std::vector<std::byte> good = encode(part);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const unsigned mask : {1u, 2u, 4u, 8u, 16u, 32u, 64u, 128u, 255u}) {
      std::vector<std::byte> bytes = good;
      bytes[i] ^= std::byte(mask);
      refused += damage_of(bytes, part.triangles).empty() ? 0 : 1;
    }
    EXPECT_NE(damage_of({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(i)}, part.triangles), "") << i;
  }
  EXPECT_GT(refused, 1000u);
}

/// Whether a receiver takes all of it and is content.
bool is_taken(const std::string& stream, std::uint64_t memory) {
  DisplayReport report;
  std::optional<Vec3> origin;
  const std::function<bool(DisplayPart &&)> give = [](DisplayPart&& part) {
    EXPECT_TRUE(is_valid(part));
    return true;
  };
  PartReceiver receiver(report, origin, 0, memory, give);
  try {
    for (std::size_t at = 0; at < stream.size() && !receiver.ended();) {
      const std::span<std::byte> room = receiver.room();
      const std::size_t count = std::min(room.size(), stream.size() - at);
      std::memcpy(room.data(), stream.data() + at, count);
      receiver.take(count);
      at += count;
    }
  } catch (const StreamReceiver::StreamDamaged&) {
  } catch (const StreamReceiver::ContentTooLarge&) {
  } catch (const Error&) {
    return false;
  }
  return receiver.ended();
}

std::string frame(std::uint32_t number, FrameKind kind, std::span<const std::byte> payload) {
  const FrameHeader header{frame_magic, kind, 0, number, static_cast<std::uint32_t>(payload.size())};
  return bytes_of(header) + std::string(reinterpret_cast<const char*>(payload.data()), payload.size());
}

const std::string hello = frame(0, FrameKind::hello, PayloadWriter().add(Greeting{}).bytes());

TEST(ImportDisplayStream, CountsWhatSmallThingsTakeWhereTheyAreDrawn) {
  DisplayPart part = full_part();
  part.pages.clear();
  part.groups = 1;
  part.geometries.resize(1);
  part.geometries.resize(1000, part.geometries[0]);
  part.triangles = 2000;
  const std::vector<std::byte> bytes = encode(part);
  ASSERT_LT(bytes.size(), 200'000u);
  Totals totals;
  totals.triangles = part.triangles;
  const PartHeader header{{1000, 0, 0}, {0, 0, 0}, {1, 1, 1}, part.triangles, bytes.size()};
  const std::string stream = hello + frame(1, FrameKind::part, PayloadWriter().add(header).bytes()) +
                             frame(2, FrameKind::part_bytes, bytes) +
                             frame(3, FrameKind::end, PayloadWriter().add(totals).add(std::uint32_t{0}).bytes());
  EXPECT_TRUE(is_taken(stream, 4u << 20));
  EXPECT_FALSE(is_taken(stream, 1u << 20));
}

/// A name without letters has 8 bytes in the stream, and takes four times as many in memory.
TEST(ImportDisplayStream, RefusesNamesBeforeItMakesRoomForThem) {
  DisplayPart sent = full_part();
  sent.objects.resize(2'000'000);
  const std::vector<std::byte> bytes = encode(sent);
  const auto refused = [&](std::uint64_t most) {
    DisplayPart part;
    part.triangles = sent.triangles;
    try {
      decode(bytes, part, most);
    } catch (const StreamReceiver::ContentTooLarge&) {
      return true;
    }
    return false;
  };
  const std::uint64_t names = DisplayPart::name_cost * sent.objects.size();
  EXPECT_LT(memory_cost::cost_of([&] { EXPECT_TRUE(refused(names)); }).mebibytes, 16u) << "its groups leave less";
  EXPECT_FALSE(refused(sent.node_bytes()));
}

TEST(ImportDisplayStream, TakesNoPartThatFillsMoreThanHalfOfTheMemory) {
  DisplayPart part = full_part();
  DisplayTexture& texture = part.textures.at(0);
  texture.texels = roam::DisplayTexels::rgba;
  texture.width = texture.height = 512;
  texture.levels = 1;
  texture.bytes.assign(DisplayTexture::bytes_of(texture.texels, 512, 512), 7);
  const std::vector<std::byte> bytes = encode(part);
  Totals totals;
  totals.triangles = part.triangles;
  const PartHeader header{{1000, 0, 0}, {0, 0, 0}, {1, 1, 1}, part.triangles, bytes.size()};
  const std::string stream = hello + frame(1, FrameKind::part, PayloadWriter().add(header).bytes()) +
                             frame(2, FrameKind::part_bytes, bytes) +
                             frame(3, FrameKind::end, PayloadWriter().add(totals).add(std::uint32_t{0}).bytes());
  ASSERT_LT(part.node_bytes(), bytes.size() / 2);
  EXPECT_TRUE(is_taken(stream, 2 * bytes.size()));
  EXPECT_FALSE(is_taken(stream, 2 * bytes.size() - 2)) << "what comes and what is made of it are there together";
}

TEST(ImportDisplayStream, RefusesADamagedOrder) {
  const TemporaryFolder folder;
  const auto file = folder.write("scene.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  const auto error_of = [&](const std::string& stream) {
    const auto data = folder.write("stream", stream);
    ImportOptions options;
    options.reader = folder.write_script("reader.sh", "cat '" + data.string() + "' >&3\n");
    return display_error(file, options);
  };
  const std::vector<std::byte> bytes = encode(full_part());
  const PartHeader good{{1000, 0, 0}, {0, 0, 0}, {1, 1, 1}, 6, bytes.size()};
  PartHeader nowhere = good, empty = good, huge = good, other = good;
  nowhere.lower[1] = std::nan("");
  empty.bytes = 0;
  huge.origin[2] = 1e300;
  other.triangles = 7;
  Totals totals;
  totals.triangles = 6;
  const auto begin = [&](const PartHeader& header) {
    return hello + frame(1, FrameKind::part, PayloadWriter().add(header).bytes());
  };
  const auto end = [&](std::uint32_t number) {
    return frame(number, FrameKind::end, PayloadWriter().add(totals).add(std::uint32_t{0}).bytes());
  };
  EXPECT_EQ(error_of(begin(good) + frame(2, FrameKind::part_bytes, bytes) + end(3)), "");
  EXPECT_TRUE(contains(error_of(begin(nowhere)), "a part without a place"));
  EXPECT_TRUE(contains(error_of(begin(huge)), "a part without a place"));
  EXPECT_TRUE(contains(error_of(begin(empty)), "a frame of broken length"));
  EXPECT_TRUE(contains(error_of(begin(other) + frame(2, FrameKind::part_bytes, bytes)), "a part of other triangles"));
  EXPECT_TRUE(contains(error_of(begin(good) + end(2)), "a part that is not whole"));
  EXPECT_TRUE(contains(error_of(hello + frame(1, FrameKind::part_bytes, bytes)), "bytes of no part"));
  EXPECT_TRUE(contains(error_of(hello + frame(1, FrameKind::object, PayloadWriter().add_text("Wall").bytes())),
                       "unknown kind"));
  totals.triangles = 8;
  EXPECT_TRUE(contains(error_of(begin(good) + frame(2, FrameKind::part_bytes, bytes) + end(3)), "totals"));
}

}  // namespace
}  // namespace roam::test
