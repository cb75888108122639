// What a reader sends of a scene to be seen is checked value by value: a hostile one ends the reading, and no more.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "import/find_reader.h"
#include "import/part_format.h"
#include "import/part_receiver.h"
#include "import/stream.h"
#include "shown_scene.h"

namespace roam::test {
namespace {

using namespace reader;

/// A part with everything that there is: images, looks, groups, geometries of all kinds, pages.
DisplayPart full_part() {
  DisplayPart part;
  part.origin = {1000, 0, 0};
  part.bounds = {{999, 0, 0}, {1001, 1, 1}};
  part.textures.push_back(
      {2, 3, DisplayTexels::rgb, DisplayWrap::repeat, DisplayWrap::clamp, 1, std::vector<std::uint8_t>(18, 7)});
  part.textures.push_back({8, 4, DisplayTexels::dxt5, DisplayWrap::mirror, DisplayWrap::repeat, 4,
                           std::vector<std::uint8_t>(DisplayTexture::bytes_of(DisplayTexels::dxt5, 8, 4, 4), 9)});
  constexpr std::uint32_t none = DisplayLook::no_texture;
  part.looks = {{none, DisplayCover::opaque, 0.5f, 0.25f, 1.0f, none, {255, 128, 0}, none},
                {0, DisplayCover::cut, 0.25f},
                {none, DisplayCover::blended, 0.5f, 1.0f, 1.0f, 1, {1, 1, 1}, 0}};
  part.groups = 3;
  for (std::uint32_t i = 0; i < 3; ++i) {
    DisplayGeometry geometry;
    geometry.group = i;
    geometry.look = i;
    geometry.cell = {256, 0, 0};
    geometry.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    geometry.colours.assign(4, {1, 2, 3, 4});
    if (i == 1) geometry.normals.assign(4, {0, 0, 1});
    if (i > 0) geometry.coordinates.assign(4, {0.5f, 0.25f});
    geometry.indices = {0, 1, 2, 0, 2, 3};
    if (i == 1) geometry.runs = {{1, 1}, {0, 1}};
    part.geometries.push_back(geometry);
  }
  part.objects = {"wall", "door"};
  part.triangles = 6;
  part.pages.push_back({0, {1, 2, 3}, 5.0f, DisplayMeasure::pixels, {{0, 100, 1, {}}, {100, 1e30f, 0, "a page"}}});
  part.pages.push_back(
      {1, {1, 2, 3}, 2.0f, DisplayMeasure::metres, {{0, 50, 2, {}}, {0, 10, 0, "one"}, {5, 20, 0, "two"}}});
  return part;
}

/// What a viewer may rely on, said again in other words.
bool is_valid(const DisplayPart& part) {
  bool valid = part.groups > 0;
  for (const DisplayTexture& t : part.textures) {
    const std::size_t bytes[] = {1, 2, 3, 4};
    valid = valid && t.width > 0 && t.height > 0 && t.width <= 16384 && t.height <= 16384 && t.levels <= 15;
    if (t.texels < DisplayTexels::dxt1 && t.levels == 1) {
      valid = valid && t.bytes.size() == std::size_t{t.width} * t.height * bytes[static_cast<int>(t.texels)];
    } else {
      valid = valid && t.bytes.size() * 16 >= std::size_t{t.width} * t.height * 8;
    }
  }
  for (const DisplayLook& look : part.looks) {
    for (const std::uint32_t image : {look.texture, look.gloss_texture, look.emission_texture}) {
      valid = valid && (image == DisplayLook::no_texture || image < part.textures.size());
    }
    for (const float share : {look.cutoff, look.roughness, look.metalness}) {
      valid = valid && share >= 0.0f && share <= 1.0f;
    }
  }
  std::uint64_t triangles = 0;
  for (const DisplayGeometry& g : part.geometries) {
    valid = valid && g.group < part.groups && g.look < part.looks.size() && g.indices.size() % 3 == 0;
    valid = valid && g.colours.size() == g.positions.size();
    valid = valid && (g.normals.empty() || g.normals.size() == g.positions.size());
    if (!valid) return false;
    const bool textured = part.looks[g.look].has_image();
    valid = valid && g.coordinates.size() == (textured ? g.positions.size() : 0);
    for (const std::uint16_t i : g.indices) valid = valid && i < g.positions.size();
    for (const glm::vec3& p : g.positions) {
      for (int k = 0; k < 3; ++k) valid = valid && std::abs(g.cell[k] + double(p[k])) <= 4e9;
    }
    for (const glm::vec3& n : g.normals) valid = valid && std::isfinite(n.x) && std::isfinite(n.y);
    std::size_t in_runs = 0;
    for (const DisplayRun& run : g.runs) {
      valid = valid && run.object < part.objects.size();
      in_runs += run.triangles;
    }
    valid = valid && (g.runs.empty() || in_runs == g.indices.size() / 3);
    triangles += g.indices.size() / 3;
  }
  std::vector<int> shown(part.groups, 0);
  for (const DisplayPages& pages : part.pages) {
    valid = valid && pages.group < part.groups && pages.radius >= 0.0f && std::isfinite(pages.radius);
    valid = valid && pages.error >= 0.0f && std::isfinite(pages.error) && std::isfinite(pages.half.x + pages.half.z);
    for (const DisplayLevel& level : pages.levels) {
      valid = valid && level.group < part.groups && level.page.size() <= 4096 && !std::isnan(level.from);
      valid = valid && (level.group == 0) != level.page.empty();
      if (valid && level.group != 0) ++shown[level.group];
    }
  }
  for (std::size_t i = 1; i < shown.size(); ++i) valid = valid && shown[i] == 1;
  return valid && triangles == part.triangles;
}

/// How a part is damaged; empty where it is not.
std::string damage_of(const std::vector<std::byte>& bytes, std::uint64_t triangles) {
  DisplayPart part;
  part.triangles = triangles;
  try {
    decode(bytes, part);
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
  decode(encode(sent), part);
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

/// What the reader sends of a file to be seen.
std::string recorded_stream(const TemporaryFolder& folder, const std::filesystem::path& file) {
  const std::filesystem::path record = folder.path() / "recorded";
  ImportOptions options;
  options.reader =
      folder.write_script("reader.sh", "exec 4>&3\n'" + find_reader({}).string() + "' \"$@\" 3>&1 4>&- | cat > '" +
                                           record.string() + "'\ncat '" + record.string() + "' >&4\n");
  EXPECT_EQ(display_error(file, options), "");
  std::ifstream stream(record, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
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

TEST(ImportDisplayStream, SurvivesRecordedStreamsThatAreDamaged) {
  const TemporaryFolder folder;
  folder.write("wall.bmp", bmp(std::vector<std::array<std::uint8_t, 3>>(5, {9, 8, 7})));
  folder.write("a.mtl", "newmtl a\nmap_Kd wall.bmp\n");
  const std::string good = recorded_stream(
      folder, folder.write("a.obj",
                           "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\nmtllib a.mtl\nf 1 2 3\nusemtl a\nf 1/1/1 "
                           "2/1/1 3/1/1\n"));
  ASSERT_GT(good.size(), 500u);
  ASSERT_TRUE(is_taken(good, 1u << 20));
  std::mt19937_64 random(5);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  std::size_t refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string stream = good;
    for (std::size_t n = 1 + below(4); n > 0; --n) stream[below(stream.size())] ^= static_cast<char>(1 + below(255));
    if (i % 5 == 0) stream.resize(below(stream.size()));
    if (i % 7 == 0) stream.insert(below(stream.size() + 1), good.substr(below(good.size()), 1 + below(64)));
    refused += is_taken(stream, 1u << 20) ? 0 : 1;
  }
  EXPECT_GT(refused, 10'000u);
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
