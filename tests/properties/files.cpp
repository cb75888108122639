// Paths, rows of `roam sweep` and JSON are read back as they were written.

#include <charconv>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "files/json_text.h"
#include "generated.h"
#include "import_files.h"
#include "roam/path_file.h"
#include "sweep/rows.h"

namespace {

using roam::Vec3;
using Json = nlohmann::ordered_json;

/// Any double up to `most`, also the smallest ones and minus zero.
rc::Gen<double> any_double(double most) {
  const auto wild = [most](const rc::Random& random, int) {
    rc::Random bits = random;
    const double digits = static_cast<double>(bits.next() >> 11) * 0x1p-53;
    const double size = std::ldexp(digits, static_cast<int>(bits.next() % 1104) - 1074);
    const double value = std::copysign(std::min(size, most), bits.next() % 2 == 0 ? 1.0 : -1.0);
    return rc::shrinkable::shrinkRecur(value, &generated::simpler);
  };
  return rc::gen::oneOf(rc::Gen<double>(wild), generated::number(-most, most), rc::gen::just(-0.0));
}

rc::Gen<Vec3> any_place() {
  return rc::gen::apply([](double x, double y, double z) { return Vec3(x, y, z); }, any_double(1e9), any_double(1e9),
                        any_double(1e9));
}

/// At least two places.
rc::Gen<std::vector<Vec3>> any_path() {
  return rc::gen::apply(
      [](const Vec3& a, const Vec3& b, std::vector<Vec3> rest) {
        rest.insert(rest.begin(), {a, b});
        return rest;
      },
      any_place(), any_place(), rc::gen::container<std::vector<Vec3>>(any_place()));
}

std::string shown(const std::vector<Vec3>& path) {
  std::string text;
  for (const Vec3& p : path) text += generated::text(p);
  return text;
}

/// To the last bit, also the sign of zero.
bool same(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

std::string fields(const Vec3& v, char between) {
  return roam::number_text(v.x) + between + roam::number_text(v.y) + between + roam::number_text(v.z);
}

TEST(FileProperties, APathIsReadBackToTheLastBit) {
  const roam::test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "way.path";
  generated::check(100, [&] {
    const std::vector<Vec3> path = *any_path();
    RC_LOG() << shown(path);
    roam::save_path(file, path);
    RC_ASSERT(same(roam::positions(roam::load_path(file)), path));
  });
}

TEST(FileProperties, BlanksAndCommentsChangeNoPath) {
  generated::check(1000, [] {
    const std::vector<Vec3> path = *any_path();
    RC_LOG() << shown(path);
    std::string text;
    for (const Vec3& p : path) {
      text += *rc::gen::element<std::string>("", "# 1 2 3\n", "\n", " \t", "\r\n");
      text += fields(p, *rc::gen::element(' ', '\t'));
      text += *rc::gen::element<std::string>("\n", "\r\n", " # 4\n", "\t\n");
    }
    std::istringstream in(text);
    RC_ASSERT(same(roam::positions(roam::read_path(in, "way.path")), path));
  });
}

TEST(FileProperties, AQueryIsReadBackToTheLastBit) {
  generated::check(1000, [] {
    const Vec3 from = *any_place(), motion = *any_place();
    const double radius = std::abs(*any_double(1e3)), half_height = std::abs(*any_double(1e3));
    const std::string row = fields(from, ',') + ',' + fields(motion, ',') + ',' + roam::number_text(radius) + ',' +
                            roam::number_text(half_height);
    RC_LOG() << row;
    const roam::app::SweepQuery q = roam::app::parse_query(row);
    RC_ASSERT(same({q.from, q.motion, Vec3(q.body.radius, q.body.half_height, 0.0)},
                   {from, motion, Vec3(radius, half_height, 0.0)}));
  });
}

TEST(FileProperties, AnAnswerIsReadBackToTheLastBit) {
  generated::check(1000, [] {
    roam::Impact hit;
    hit.hit = true;
    hit.point = *any_place();
    hit.normal = *any_place();
    hit.time = *any_double(1.0);
    hit.distance = *any_double(1e9);
    hit.triangle = *rc::gen::inRange<std::uint64_t>(0, std::uint64_t{1} << 60);
    std::string row;
    roam::app::append_answer(row, hit);
    RC_LOG() << row;
    std::vector<std::string> texts;
    std::istringstream in(row);
    for (std::string field; std::getline(in, field, ',');) texts.push_back(field);
    RC_ASSERT(texts.size() == 11U);
    const auto number = [&](int i) {
      double value = 0.0;
      std::from_chars(texts[i].data(), texts[i].data() + texts[i].size(), value);
      return value;
    };
    const Vec3 rest(number(1), std::strtod(texts[10].c_str(), nullptr), 0.0);
    RC_ASSERT(same({{number(2), number(3), number(4)}, {number(5), number(6), number(7)}, rest},
                   {hit.point, hit.normal, Vec3(hit.time, hit.distance, 0.0)}));
    RC_ASSERT(texts[8] == std::to_string(hit.triangle));
  });
}

/// A type of its own, because RapidCheck takes JSON for a string.
struct Value {
  Json json;
};
std::ostream& operator<<(std::ostream& out, const Value& value) { return out << value.json.dump(); }

/// At most `levels` deep.
rc::Gen<Value> any_value(int levels) {
  const auto of = [](const auto& plain) { return Value{Json(plain)}; };
  const auto text = rc::gen::container<std::string>(rc::gen::inRange<char>(0, 127));
  const auto plain = rc::gen::oneOf(rc::gen::map(any_double(1e9), of), rc::gen::map(text, of),
                                    rc::gen::map(rc::gen::arbitrary<std::int64_t>(), of),
                                    rc::gen::map(rc::gen::arbitrary<bool>(), of));
  if (levels == 0) return plain;
  const auto below = rc::gen::lazy([levels] { return any_value(levels - 1); });
  const auto list = rc::gen::map(rc::gen::scale(0.1, rc::gen::container<std::vector<Value>>(below)),
                                 [](const std::vector<Value>& values) {
                                   Value all{Json::array()};
                                   for (const Value& value : values) all.json.push_back(value.json);
                                   return all;
                                 });
  using Members = std::vector<std::pair<std::string, Value>>;
  const auto object = rc::gen::map(rc::gen::scale(0.1, rc::gen::container<Members>(rc::gen::pair(text, below))),
                                   [](const Members& members) {
                                     Value all{Json::object()};
                                     for (const auto& [name, value] : members) all.json[name] = value.json;
                                     return all;
                                   });
  return rc::gen::weightedOneOf<Value>({{2, plain}, {1, list}, {1, object}});
}

TEST(FileProperties, JsonIsReadBack) {
  int nested = 0;
  const int held = generated::check(5000, [&] {
    const Value value = *any_value(5);
    const std::string text = value.json.dump(*rc::gen::element(-1, 2));
    const bool same = roam::files::parse_json(text) == value.json;
    RC_ASSERT(same);
    nested += value.json.is_structured() && !value.json.empty() && value.json.front().is_structured();
  });
  EXPECT_GE(nested, held / 20);
}

}  // namespace
