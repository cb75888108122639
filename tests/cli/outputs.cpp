// No output overwrites what is read, nor a file of another kind: the scene may refer to it.
#include <gtest/gtest.h>

#include "cli_scenes.h"
#include "messages.h"
#include "program.h"

namespace {

TEST(Outputs, AreNotWrittenOverWhatIsRead) {
  const TestFolder folder;
  const std::string scene = folder.write("scene.obj", room_obj()), path = folder.write("p.path", "2 0 1\n3 0 1\n");
  for (const std::string& file : {scene, path}) {
    const ProgramResult result = run_program(ROAM_PROGRAM, {"walk", scene, "--path", path, "--trace", file});
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(contains(result.err, "would overwrite")) << result.err;
  }
  EXPECT_EQ(folder.read("scene.obj"), room_obj());
}

TEST(Outputs, AreWrittenOverTheirLikeThatAPersonMadeOrEdited) {
  const TestFolder folder;
  const std::string scene = folder.write("scene.obj", room_obj()), path = folder.write("p.path", "2 0 1\n3 0 1\n");
  for (const char* by_hand : {"# by hand\n1 0 1\n2 0 1\n", "# roam: frame up y unit m\n# roam: mode walk\n"}) {
    folder.write("way.path", by_hand);
    const ProgramResult probed = run_program(
        ROAM_PROGRAM, {"probe", scene, "--from", "2,0,1", "--to", "3,0,1", "--path", folder.file("way.path")});
    EXPECT_EQ(probed.status, 0) << probed.err;
  }
  folder.write("trace.csv", "\xef\xbb\xbfstep,t,x,y,z,radius\n");
  const ProgramResult walked =
      run_program(ROAM_PROGRAM, {"walk", scene, "--path", path, "--trace", folder.file("trace.csv")});
  EXPECT_EQ(walked.status, 0) << walked.err;
}

TEST(Outputs, AreWrittenOverNoFileOfAnotherKind) {
  const TestFolder folder;
  const std::string scene = folder.write("scene.obj", room_obj()), file = folder.file("scene.bin");
  const std::string path = folder.write("p.path", "2 0 1\n3 0 1\n"), buffer = "a buffer that the scene refers to";
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"walk", scene, "--path", path, "--trace", file},
                                             {"walk", scene, "--path", path, "--certify", file},
                                             {"probe", scene, "--from", "2,0,1", "--to", "3,0,1", "--path", file},
                                             {"train", scene, "-o", file}}) {
    folder.write("scene.bin", buffer);
    const ProgramResult refused = run_program(ROAM_PROGRAM, arguments);
    const std::string& option = arguments[arguments.size() - 2];
    EXPECT_EQ(refused.status, 2) << option;
    EXPECT_TRUE(contains(refused.err, option + " " + file + ": this would overwrite a file of another kind"))
        << refused.err;
    EXPECT_EQ(folder.read("scene.bin"), buffer) << option;
    folder.write("scene.bin", "");
    for (int again = 0; again < 2; ++again) {
      const ProgramResult written = run_program(ROAM_PROGRAM, arguments);
      EXPECT_TRUE(written.status == 0 || written.status == 3) << written.err;
      EXPECT_GT(folder.read("scene.bin").size(), 10U) << option;
    }
  }
}

}  // namespace
