// Wrong command lines: each is named in roam's words, with what was likely meant.
#include <gtest/gtest.h>

#include "cli/spelling.h"
#include "messages.h"
#include "program.h"

namespace {

using Arguments = std::vector<std::string>;

struct Wrong {
  Arguments arguments;
  const char* first_line;  ///< of standard error
};

void expect_refused(const std::vector<Wrong>& cases) {
  for (const Wrong& wrong : cases) {
    const ProgramResult result = run_program(ROAM_PROGRAM, wrong.arguments);
    std::string line;
    for (const std::string& argument : wrong.arguments) line += argument + " ";
    SCOPED_TRACE(line);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err.substr(0, result.err.find('\n')), wrong.first_line);
  }
}

TEST(Usage, NamesTheVerbThatWasMeant) {
  expect_refused({
      {{"wlak", "x"}, "roam: there is no verb 'wlak'. Did you mean 'walk'?"},
      {{"wlak", "--help"}, "roam: there is no verb 'wlak'. Did you mean 'walk'?"},
      {{"help", "wlak"}, "roam: there is no verb 'wlak'. Did you mean 'walk'?"},
      {{"make", "castle", "-o", "c.ply"}, "roam make: there is no kind 'castle'. There is gallery, terrain or city."},
      {{"make"}, "roam make: a kind is missing: gallery, terrain or city"},
      {{"verify", "store", "more"}, "roam verify: unexpected argument 'more'"},
  });
}

TEST(Usage, OffersToViewASceneWithoutAVerb) {
  const TestFolder folder;
  const std::string scene = folder.write("house.obj", "");
  const std::string line = "roam: there is no verb '" + scene + "'. Did you mean 'roam view " + scene + "'?";
  expect_refused({{{scene}, line.c_str()}});
}

TEST(Usage, NamesTheOptionThatWasMeantBeforeAnyOtherComplaint) {
  const char* const height = "roam walk: unknown option '--hieght'. Did you mean '--height'?";
  expect_refused({
      {{"walk", "d.obj", "--hieght", "1.8"}, height},
      {{"walk", "d.obj", "--hieght=1.8", "--path", "a"}, height},
      {{"walk", "--hieght"}, height},
      {{"walk", "d.obj", "--radius", "abc", "--hieght", "1.8"}, height},
      {{"walk", "d.obj", "-radius", "3"}, "roam walk: unknown option '-radius'. Did you mean '--radius'?"},
      {{"walk", "d.obj", "--support", "3"}, "roam walk: unknown option '--support'. Did you mean '--support-radius'?"},
      {{"info", "d.obj", "--quack"}, "roam info: unknown option '--quack'"},
      {{"--quack"}, "roam: unknown option '--quack'"},
  });
}

TEST(Usage, SaysWhichValueIsWrongAndWhatFits) {
  const Arguments walk = {"walk", "d.obj", "--wander", "5"};
  const auto with = [&](Arguments more) {
    more.insert(more.begin(), walk.begin(), walk.end());
    return more;
  };
  expect_refused({
      {with({"--radius", "abc"}), "roam walk: --radius: 'abc' is not a number"},
      {with({"--from", "1,2"}), "roam walk: --from needs three numbers X,Y,Z; got '1,2'"},
      {with({"--from", "1,2,3,4"}), "roam walk: --from needs three numbers X,Y,Z; got '1,2,3,4'"},
      {with({"--from", "1,b,3"}), "roam walk: --from needs three numbers X,Y,Z; got '1,b,3'"},
      {with({"--radius"}), "roam walk: --radius needs a value: --radius R"},
      {with({"--radius", "1", "--radius", "2"}), "roam walk: --radius is given 2 times; give it once"},
      {with({"--mode", "swim"}), "roam walk: --mode: 'swim' is not fly, walk or ghost"},
      {with({"--up", "w"}), "roam walk: --up: 'w' is not x, y, z, -x, -y or -z"},
      {with({"--threads", "x"}), "roam walk: --threads: 'x' is not a whole number from 1 to 4096"},
      {with({"--memory", "4x"}), "roam walk: --memory: '4x' is not a size such as 64M or 8G"},
      {with({"--path", "a"}), "roam walk: --path and --wander exclude each other: leave one out"},
      {{"walk", "d.obj", "--path", "a", "--from", "1,2,3"}, "roam walk: --from needs --wander"},
      {{"walk", "--path", "a"}, "roam walk: SCENE is missing"},
      {{"walk", "d.obj"}, "roam: walk: where to? Give it a --path FILE, or --wander S for S seconds"},
      {{"make", "city"}, "roam make city: --output FILE is missing"},
      {{"make", "city", "-o", "c.ply", "--triangles", "4q"},
       "roam make city: --triangles: '4q' is not a whole number such as 5000, 500k or 20M"},
      {{"make", "city", "-o", "c.ply", "--seed", "99999999999999999999"},
       "roam make city: --seed: '99999999999999999999' is not a whole number from 0 to 9223372036854775807"},
  });
}

TEST(Usage, TakesTheSceneAfterAPlace) {
  for (const Arguments& arguments : std::vector<Arguments>{{"build", "--near", "1,2,3", "gone.ply"},
                                                           {"build", "--near=1,2,-3", "gone.ply"},
                                                           {"build", "--near", "1", "2", "3", "gone.ply"},
                                                           {"probe", "--from", "1,2,3", "gone.ply", "--to", "1,2,3"},
                                                           {"view", "--origin", "1,2,3", "gone.ply"},
                                                           {"walk", "--wander", "5", "--from", "1,2,3", "gone.ply"}}) {
    const ProgramResult result = run_program(ROAM_PROGRAM, arguments);
    EXPECT_EQ(result.err.substr(0, result.err.find('\n')),
              "roam: gone.ply: there is no such file or folder. Check the spelling.")
        << arguments[0];
  }
}

TEST(Usage, RefusesAnEmptyNameOfAFile) {
  expect_refused({
      {{"walk", "x.obj", "--wander", "1", "--certify", ""}, "roam walk: --certify: a file needs a name"},
      {{"walk", "x.obj", "--wander", "1", "--trace", ""}, "roam walk: --trace: a file needs a name"},
      {{"make", "gallery", "-o", ""}, "roam make gallery: --output: a file needs a name"},
      {{"build", "x.obj", "-o", ""}, "roam build: --output: a folder needs a name"},
  });
}

TEST(Usage, TakesUnitsOfTrianglesAndBytes) {
  const TestFolder folder;
  const std::string scene = folder.file("city.obj");
  for (const char* count : {"10k", "10K", "0.01M", "10000"}) {
    const ProgramResult made = run_program(ROAM_PROGRAM, {"make", "city", "-o", scene, "--triangles", count});
    EXPECT_EQ(made.status, 0) << count << made.err;
  }
  for (const char* memory : {"512M", "512MB", "0.5GiB", "524288k", "536870912"}) {
    const ProgramResult read = run_program(ROAM_PROGRAM, {"info", scene, "--memory", memory});
    EXPECT_EQ(read.status, 0) << memory << read.err;
  }
}

TEST(Usage, HelpAndVersionHaveShortWays) {
  for (const auto& [shorter, longer] :
       std::vector<std::pair<Arguments, Arguments>>{{{"help"}, {"--help"}},
                                                    {{"help", "walk"}, {"walk", "--help"}},
                                                    {{"help", "make", "city"}, {"make", "city", "--help"}},
                                                    {{"-v"}, {"--version"}}}) {
    const ProgramResult result = run_program(ROAM_PROGRAM, shorter);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_FALSE(result.out.empty());
    EXPECT_EQ(result.out, run_program(ROAM_PROGRAM, longer).out);
  }
}

TEST(Spelling, GuessesOnlyWhatIsNear) {
  const Arguments names = {"--height", "--radius", "--support-radius", "-o"};
  EXPECT_EQ(roam::app::likely_meant("--heigth", names), "--height");
  EXPECT_EQ(roam::app::likely_meant("hight", names), "--height");
  EXPECT_EQ(roam::app::likely_meant("--rad", names), "--radius");
  EXPECT_EQ(roam::app::likely_meant("--weight-of-body", names), "");
  EXPECT_EQ(roam::app::likely_meant("--x", names), "");
  EXPECT_EQ(roam::app::likely_meant("--", names), "");
}

}  // namespace
