// roam walk --certify and roam check: a walk is accepted, a forgery is refused and its segment named.
#include "check/check.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "cli_scenes.h"
#include "messages.h"
#include "program.h"
#include "roam/profile.h"

namespace {

using nlohmann::json;
using Arguments = std::vector<std::string>;

/// A floor with a step of 0.2 m at x = 4 to 6, and a beam 1.3 m above it at x = 9 to 11.
std::string course_obj() {
  return "v 0 -2 0\nv 20 -2 0\nv 20 2 0\nv 0 2 0\nv 4 -2 0.2\nv 6 -2 0.2\nv 6 2 0.2\nv 4 2 0.2\nv 4 -2 0\nv 4 2 0\n"
         "v 6 -2 0\nv 6 2 0\nv 9 -2 1.3\nv 11 -2 1.3\nv 11 2 1.3\nv 9 2 1.3\nv 9 -2 3\nv 9 2 3\nv 11 -2 3\nv 11 2 3\n"
         "o floor\nf 1 2 3 4\no step\nf 5 6 7 8\nf 9 5 8 10\nf 11 6 7 12\n"
         "o beam\nf 13 14 15 16\nf 13 16 18 17\nf 14 15 20 19\n";
}

class CheckVerb : public testing::Test {
 protected:
  /// Walks in a scene and returns the certificate's text.
  std::string certify(const std::string& scene, Arguments how) {
    how.insert(how.begin(), {"walk", folder_.write("scene.obj", scene), "--certify", folder_.file("certificate")});
    const ProgramResult result = run_program(ROAM_PROGRAM, how);
    EXPECT_EQ(result.status, 0) << result.out << result.err;
    return folder_.read("certificate");
  }
  std::string course() { return certify(course_obj(), {"--path", folder_.write("p.path", "1 0 0.9\n18 0 0.9\n")}); }
  ProgramResult check(Arguments more = {}) {
    more.insert(more.begin(), {"check", folder_.file("certificate"), folder_.file("scene.obj")});
    return run_program(ROAM_PROGRAM, more);
  }
  json report(const Arguments& more = {}) {
    Arguments all = more;
    all.emplace_back("--json");
    return json::parse(check(all).out, nullptr, false);
  }
  void expect_accepted(const std::string& what) {
    const ProgramResult result = check();
    EXPECT_EQ(result.status, 0) << what << ": " << result.out << result.err;
    EXPECT_TRUE(result.out.starts_with("ACCEPTED: ")) << what << ": " << result.out;
  }
  /// Replaces the certificate by these lines with a right checksum, and expects the refusal.
  void expect_refused(const std::vector<std::string>& lines, const json& segment, const std::string& why) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    folder_.write("certificate", text + roam::checking::checksum_line(text));
    const json found = report();
    EXPECT_EQ(found["accepted"], false) << why;
    EXPECT_EQ(found["segment"], segment) << why;
    EXPECT_TRUE(contains(found["why"], why)) << found["why"];
    const ProgramResult result = check();
    EXPECT_EQ(result.status, 3);
    EXPECT_TRUE(result.out.starts_with("REFUSED: ")) << result.out;
  }

  TestFolder folder_;
};

/// Without the checksum.
std::vector<std::string> certified_lines(const std::string& certificate) {
  std::istringstream in(certificate);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  EXPECT_TRUE(lines.back().starts_with("checksum "));
  lines.pop_back();
  return lines;
}

/// The line of a segment, and its words.
std::size_t line_of(const std::vector<std::string>& lines, std::size_t number) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].starts_with("segment " + std::to_string(number) + " ")) return i;
  }
  ADD_FAILURE() << "no segment " << number;
  return 0;
}
std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), {}};
}
std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}
/// `text` as a number plus `by`.
std::string shifted(const std::string& text, double by) { return std::to_string(std::stod(text) + by); }

TEST_F(CheckVerb, AcceptsAPersonWhoStepsUpAndCrouches) {
  const std::string text = course();
  EXPECT_TRUE(contains(text, "\nsize 0.3 0.6")) << text.substr(0, 300);
  expect_accepted("course");
  const json found = report();
  EXPECT_EQ(found["accepted"], true);
  EXPECT_EQ(found["sizes"].size(), 2U);
  EXPECT_EQ(found["sizes"][0]["radius"], 0.3);
  EXPECT_NEAR(found["sizes"][1]["height"].get<double>(), 1.1, 1e-9);
  EXPECT_GT(found["segments"], 300);
  EXPECT_EQ(found["triangles"], 14);
  EXPECT_NEAR(found["to"][0].get<double>(), 18.0, 1e-6);
  EXPECT_GE(found["least_gap_m"].get<double>(), -1e-6);
}

TEST_F(CheckVerb, AcceptsFlyingAndWandering) {
  certify(room_obj(), {"--path", folder_.write("p.path", "2 0 1.5\n18 1 1\n3 -1 2\n"), "--mode", "fly", "--sphere",
                       "--speed", "20"});
  expect_accepted("a sphere");
  certify(room_obj(), {"--wander", "60"});
  expect_accepted("wandering on foot");
  certify(room_obj(), {"--wander", "60", "--mode", "fly", "--speed", "10"});
  expect_accepted("wandering in flight");
  certify(course_obj(), {"--path", folder_.write("p.path", "1 0 0.9\n18 0 0.9\n"), "--support-radius", "0.4"});
  expect_accepted("with a support disc");
}

TEST_F(CheckVerb, SaysHowNearTheBodyComes) {
  const std::string text = certify(room_obj(), {"--path", folder_.write("p.path", "2 0 1.5\n18 1 1\n3 -1 2\n"),
                                                "--mode", "fly", "--sphere", "--speed", "20"});
  EXPECT_TRUE(contains(check().out, "nearest     at least 0.")) << check().out;
  // A bound without any gap claims less, and is as true.
  std::string weaker;
  for (const std::string& line : certified_lines(text)) {
    std::vector<std::string> words = words_of(line);
    if (words[0] == "segment") words.back() = words[8];
    weaker += joined(words) + "\n";
  }
  folder_.write("certificate", weaker + roam::checking::checksum_line(weaker));
  EXPECT_TRUE(contains(check().out, "nearest     it may touch something, by 0.001 mm at most")) << check().out;
}

TEST_F(CheckVerb, RefusesASmallerRadius) {
  const std::vector<std::string> lines = certified_lines(course());
  std::vector<std::string> forged = lines;
  const std::size_t at = line_of(lines, 20);
  std::vector<std::string> words = words_of(lines[at]);
  words[8] = "0.25";
  forged[at] = joined(words);
  expect_refused(forged, 20, "does not name this size");
  forged.insert(forged.begin() + 3, "size 0.25 " + words[9]);
  expect_refused(forged, 20, "moves sideways");
  // A smaller radius throughout is true, and the certificate of another walk.
  for (std::string& line : forged) {
    words = words_of(line);
    if (words[0] == "segment") words[8] = "0.25";
    if (words[0] == "size") words[1] = "0.25";
    line = joined(words);
  }
  std::string text;
  for (const std::string& line : forged) text += line + "\n";
  folder_.write("certificate", text + roam::checking::checksum_line(text));
  EXPECT_EQ(report()["sizes"][0]["radius"], 0.25);
  EXPECT_EQ(check({"--radius", "0.25"}).status, 0);
  const ProgramResult thin = check({"--radius", "0.3"});
  EXPECT_EQ(thin.status, 3);
  EXPECT_TRUE(contains(thin.out, "segment 1, from ")) << thin.out;
  EXPECT_TRUE(contains(thin.out, "the body's radius is 0.25 m, below --radius 0.3")) << thin.out;
  const json low = report({"--height", "1.65"});
  EXPECT_EQ(low["why"], "the body is 1 m high, below --height 1.65");
  EXPECT_GT(low["segment"], 1);
}

TEST_F(CheckVerb, RefusesACornerThatWasMoved) {
  const std::vector<std::string> lines = certified_lines(course());
  const std::size_t at = line_of(lines, 20);
  std::vector<std::string> forged = lines, words = words_of(lines[at]), next = words_of(lines[at + 1]);
  words[7] = shifted(words[7], -0.01);  // into the floor
  forged[at] = joined(words);
  expect_refused(forged, 21, "does not begin where the one before it ends");
  next[4] = words[7];
  forged[at + 1] = joined(next);
  expect_refused(forged, 20, "triangle");
}

TEST_F(CheckVerb, RefusesARaisedBound) {
  const std::vector<std::string> lines = certified_lines(course());
  for (const std::size_t number : {std::size_t{20}, std::size_t{200}}) {
    std::vector<std::string> forged = lines;
    const std::size_t at = line_of(lines, number);
    std::vector<std::string> words = words_of(lines[at]);
    words[10] = shifted(words[10], 0.01);
    forged[at] = joined(words);
    expect_refused(forged, number, "of the scene is nearer than it says");
  }
}

TEST_F(CheckVerb, RefusesAWayWithAPieceLeftOut) {
  std::vector<std::string> forged = certified_lines(course());
  forged.erase(forged.begin() + static_cast<std::ptrdiff_t>(line_of(forged, 30)));
  expect_refused(forged, 31, "a segment before it is missing");
  for (std::string& line : forged) {  // and all numbers made right
    std::vector<std::string> words = words_of(line);
    if (words[0] == "way") words[1] = std::to_string(std::stoi(words[1]) - 1);
    if (words[0] == "segment" && std::stoi(words[1]) > 30) words[1] = std::to_string(std::stoi(words[1]) - 1);
    line = joined(words);
  }
  expect_refused(forged, 30, "does not begin where the one before it ends");
}

TEST_F(CheckVerb, RefusesAnotherScene) {
  const std::vector<std::string> lines = certified_lines(course());
  std::string moved = course_obj();
  moved.replace(moved.find("v 20 2 0"), 8, "v 20 2.001 0");
  folder_.write("scene.obj", moved);
  expect_refused(lines, nullptr, "the scene, or its frame, is not that of the certificate");
  folder_.write("scene.obj", course_obj() + "v 8 -2 0\nv 8 2 0\nv 8 0 3\no wall\nf 21 22 23\n");
  expect_refused(lines, report()["segment"], "triangle 14 of the scene is nearer than it says; the scene");
  EXPECT_TRUE(report()["segment"].is_number());
  EXPECT_TRUE(contains(check().out, "REFUSED: " + folder_.file("certificate") + ": segment ")) << check().out;
}

TEST_F(CheckVerb, AcceptsNothingWithAWrongByte) {
  const std::string text = course();
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    std::string other = text;
    other[random() % other.size()] ^= static_cast<char>(1 + random() % 255);
    EXPECT_THROW((void)roam::checking::read_certificate(other), std::invalid_argument) << i;
    if (i % 30 > 0) continue;
    folder_.write("certificate", other);
    EXPECT_EQ(check().status, 1);
  }
}

TEST_F(CheckVerb, SaysThatTheBodyWasPutElsewhere) {
  const std::string scene = folder_.write("scene.obj", room_obj()), file = folder_.file("certificate");
  const auto walk_from = [&](const std::string& start) {
    const std::string path = folder_.write("p.path", start + "\n5 0 0.9\n");
    return run_program(ROAM_PROGRAM, {"walk", scene, "--path", path, "--certify", file});
  };
  const ProgramResult inside = walk_from("0.05 0 0.9");
  EXPECT_EQ(inside.status, 0) << inside.out;
  EXPECT_TRUE(contains(inside.err, "the certificate begins at (0.300, 0.000, 0.9")) << inside.err;
  expect_accepted("from a place beside the wall");
  const ProgramResult off = walk_from("-0.1 0 0.9");  // off the floor: it falls, and is put back
  EXPECT_EQ(off.status, 1) << off.out;
  EXPECT_TRUE(contains(off.err, "no certificate: segment")) << off.err;
  EXPECT_TRUE(contains(off.err, "a body that was put elsewhere on its way has none")) << off.err;
}

TEST_F(CheckVerb, SaysHowATextWasChangedThatIsNotAsItWasWritten) {
  const std::string text = course();
  std::string windows, next;
  for (const std::string& line : certified_lines(text)) {
    windows += line + "\r\n";
    next += (next.empty() ? "roam certificate 2" : line) + "\n";
  }
  const auto summed = [](const std::string& lines) { return lines + roam::checking::checksum_line(lines); };
  for (const auto& [other, why] :
       {std::pair{windows + "checksum 0\r\n", "checksum is wrong; its lines end with CR LF"},
        {summed(windows), "it is no certificate of version 1; its lines end with CR LF"},
        {summed(next), "it is no certificate of version 1; check it by the roam that wrote it"},
        {text + "\n", "checksum is wrong; an empty line was added at its end"},
        {text.substr(0, text.size() / 2), "checksum is wrong; it is damaged or cut short"}}) {
    folder_.write("certificate", other);
    const ProgramResult result = check();
    EXPECT_EQ(result.status, 1) << why;
    EXPECT_TRUE(contains(result.err, why)) << result.err;
    EXPECT_TRUE(report().contains("error")) << why;
  }
}

TEST_F(CheckVerb, ReadsACertificateBehindAByteOrderMarkAndSaysWhichTextItCannotRead) {
  const std::string text = course();
  folder_.write("certificate", "\xef\xbb\xbf" + text);
  expect_accepted("a byte order mark before it");
  std::string wide = "\xff\xfe";
  for (const char c : text) wide += {c, '\0'};
  folder_.write("certificate", wide);
  const ProgramResult result = check();
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "this is UTF-16 text; save it as UTF-8")) << result.err;
}

TEST_F(CheckVerb, CountsOneSegmentAsOne) {
  certify(course_obj(), {"--path", folder_.write("p.path", "2 0 1.5\n2 0 1.5\n"), "--mode", "fly"});
  EXPECT_TRUE(contains(check().out, "its 1 segment keeps away from all ")) << check().out;
}

TEST_F(CheckVerb, NeedsTheSceneOfAStore) {
  const std::string text = course();
  const std::string scene = folder_.file("scene.obj"), store = folder_.file("s.roam"), way = folder_.file("p.path");
  ASSERT_EQ(run_program(ROAM_PROGRAM, {"build", scene, "-o", store}).status, 0);
  const ProgramResult stored = run_program(ROAM_PROGRAM, {"check", folder_.file("certificate"), store});
  EXPECT_EQ(stored.status, 2);
  EXPECT_TRUE(contains(stored.err, "this is a store")) << stored.err;
  Arguments walk{"walk", store, "--path", way, "--certify", folder_.file("certificate")};
  const ProgramResult alone = run_program(ROAM_PROGRAM, walk);
  EXPECT_EQ(alone.status, 2);
  EXPECT_TRUE(contains(alone.err, "--against")) << alone.err;
  folder_.write("certificate", "");
  const ProgramResult empty = check();
  EXPECT_EQ(empty.status, 1);
  EXPECT_TRUE(contains(empty.err, "this file is empty")) << empty.err;
  walk.insert(walk.end(), {"--against", scene});
  EXPECT_EQ(run_program(ROAM_PROGRAM, walk).status, 0);
  expect_accepted("a walk in a store");
}

TEST_F(CheckVerb, SaysWhatIsNoCertificate) {
  (void)course();
  const std::string scene = folder_.file("scene.obj"), certificate = folder_.file("certificate");
  const ProgramResult swapped = run_program(ROAM_PROGRAM, {"check", scene, certificate});
  EXPECT_EQ(swapped.status, 1);
  const ProgramResult twice = run_program(ROAM_PROGRAM, {"check", scene, scene});
  EXPECT_EQ(twice.status, 1);
  EXPECT_TRUE(contains(twice.err, "this is no certificate")) << twice.err;
  const ProgramResult ghost = run_program(ROAM_PROGRAM, {"walk", scene, "--path", folder_.file("p.path"), "--mode",
                                                         "ghost", "--certify", folder_.file("ghost")});
  EXPECT_EQ(ghost.status, 2);
  EXPECT_TRUE(contains(ghost.err, "--certify with --mode ghost")) << ghost.err;
}

TEST(Certify, WritesOverNoTraceAndNoSceneOfAStore) {
  const TestFolder folder;
  const std::string scene = folder.write("scene.obj", room_obj()), store = folder.file("s.roam");
  ASSERT_EQ(run_program(ROAM_PROGRAM, {"build", scene, "-o", store}).status, 0);
  const auto expect_refused = [&](const std::vector<std::string>& more, const std::string& why) {
    std::vector<std::string> all{"walk", store, "--wander", "1", "--against", scene};
    all.insert(all.end(), more.begin(), more.end());
    const ProgramResult result = run_program(ROAM_PROGRAM, all);
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(contains(result.err, why)) << result.err;
  };
  expect_refused({"--certify", scene}, "this would overwrite the scene");
  expect_refused({"--certify", "/dev/null"}, "--certify /dev/null: that is a pipe or a device; name a file");
  const std::string both = folder.file("both");
  expect_refused({"--trace", roam::profile_path(store).string()}, "this would overwrite the profile");
  expect_refused({"--trace", store + "/CURRENT"}, "this would overwrite a file of the scene");
  expect_refused({"--trace", both, "--certify", both}, "this would overwrite the file of --trace");
  EXPECT_EQ(folder.read("scene.obj"), room_obj());
}

}  // namespace
