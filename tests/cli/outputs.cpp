// No output overwrites what is read, nor a file that somebody else made: the scene may refer to it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/output_file.h"
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
    EXPECT_TRUE(contains(refused.err, option + " " + file + ": this would overwrite a file that is no "))
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

TEST(Outputs, CountNoFileAsEmptyThatCannotBeRead) {
  const TestFolder folder;
  std::filesystem::create_symlink("circle", folder.file("circle"));
  std::filesystem::create_directory(folder.file("folder"));
  const roam::app::FileKind traces = roam::app::beginning_with("step", "trace");
  const int empty = ::open(folder.write("empty", "").c_str(), O_RDONLY | O_CLOEXEC);
  for (const auto& kind : {traces, roam::app::paths(), roam::app::marked("picture")}) EXPECT_TRUE(kind.has(empty));
  ::close(empty);
  for (const char* name : {"circle", "folder", "absent"}) {
    const int opened = ::open(folder.file(name).c_str(), O_RDONLY | O_CLOEXEC);
    EXPECT_FALSE(traces.has(opened)) << name;
    EXPECT_FALSE(roam::app::paths().has(opened)) << name;
    EXPECT_FALSE(roam::app::marked("picture").has(opened)) << name;
    if (opened >= 0) ::close(opened);
  }
}

TEST(Outputs, PicturesReplaceOnlyPicturesThatRoamMade) {
  const TestFolder folder;
  const std::string scene = folder.write("scene.obj", room_obj()), path = folder.write("p.path", "2 0 1\n3 0 1\n");
  const std::string theirs = "a texture that the scene refers to";
  for (const char* name : {"a.svg", "a.PNG", "a.dxf"}) {
    const std::string file = folder.file(name);
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"walk", scene, "--path", path, "--picture", file},
                                               {"probe", scene, "--from", "2,0,1", "--to", "3,0,1", "--picture", file},
                                               {"train", scene, "--no-profile", "--picture", file}}) {
      folder.write(name, theirs);
      const ProgramResult refused = run_program(ROAM_PROGRAM, arguments);
      EXPECT_EQ(refused.status, 2) << arguments[0];
      EXPECT_TRUE(contains(refused.err, "--picture " + file +
                                            ": this would overwrite a file that is no picture made by "
                                            "roam; name another file, or move that one away"))
          << refused.err;
      EXPECT_EQ(folder.read(name), theirs) << arguments[0];
      std::filesystem::remove(file);
      for (int again = 0; again < 2; ++again) {
        const ProgramResult written = run_program(ROAM_PROGRAM, arguments);
        EXPECT_TRUE(written.status == 0 || written.status == 3) << written.err;
        EXPECT_GT(folder.read(name).size(), theirs.size()) << arguments[0];
      }
    }
  }
}

TEST(Outputs, PicturesReplaceAnEmptyFile) {
  const TestFolder folder;
  const std::string scene = folder.write("scene.obj", room_obj()), path = folder.write("p.path", "2 0 1\n3 0 1\n");
  const ProgramResult written =
      run_program(ROAM_PROGRAM, {"walk", scene, "--path", path, "--picture", folder.write("a.svg", "")});
  EXPECT_TRUE(written.status == 0 || written.status == 3) << written.err;
  EXPECT_GT(folder.read("a.svg").size(), 0U);
}

TEST(Outputs, MadeScenesReplaceOnlyMadeScenes) {
  const TestFolder folder;
  const std::string theirs = "v 0 0 0\n";
  for (const char* name : {"a.obj", "a.ply", "a.stl"}) {
    const std::vector<std::string> arguments{"make", "gallery", "-o", folder.file(name), "--triangles", "20k"};
    folder.write(name, theirs);
    const ProgramResult refused = run_program(ROAM_PROGRAM, arguments);
    EXPECT_EQ(refused.status, 2) << name;
    EXPECT_TRUE(contains(refused.err, "-o " + folder.file(name) + ": this would overwrite a file that is no mesh"))
        << refused.err;
    EXPECT_EQ(folder.read(name), theirs);
    std::filesystem::remove(folder.file(name));
    for (int again = 0; again < 2; ++again) {
      const ProgramResult made = run_program(ROAM_PROGRAM, arguments);
      EXPECT_EQ(made.status, 0) << made.err;
    }
  }
}

TEST(Outputs, MadeGalleriesReplaceNoPathOfAPersonBesideThem) {
  const TestFolder folder;
  const std::string tour = folder.write("dam-corner.path", "1 2 3\n4 5 6\n"), scene = folder.file("dam.ply");
  const ProgramResult refused = run_program(ROAM_PROGRAM, {"make", "gallery", "-o", scene, "--triangles", "20k"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(contains(refused.err, tour + ": this would overwrite a file that is no path of Table 1")) << refused.err;
  EXPECT_EQ(folder.read("dam-corner.path"), "1 2 3\n4 5 6\n");
  EXPECT_FALSE(std::filesystem::exists(scene));
  EXPECT_FALSE(std::filesystem::exists(folder.file("dam-straight.path")));
}

TEST(Outputs, MadeGalleriesReplaceNoPathOfTheirsThatAPersonEdited) {
  const TestFolder folder;
  const std::vector<std::string> make{"make", "gallery", "-o", folder.file("dam.ply"), "--triangles", "20k"};
  ASSERT_EQ(run_program(ROAM_PROGRAM, make).status, 0);
  const std::string edited = folder.read("dam-corner.path") + "1 2 3\n";
  folder.write("dam-corner.path", edited);
  EXPECT_EQ(run_program(ROAM_PROGRAM, make).status, 2);
  EXPECT_EQ(folder.read("dam-corner.path"), edited);
}

TEST(Outputs, MadeGalleriesFollowNoLinkBesideThem) {
  const TestFolder folder;
  std::filesystem::create_symlink("elsewhere", folder.file("dam-corner.path"));
  const ProgramResult refused =
      run_program(ROAM_PROGRAM, {"make", "gallery", "-o", folder.file("dam.ply"), "--triangles", "20k"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(contains(refused.err, folder.file("dam-corner.path") + ": that is a link")) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("elsewhere")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("dam.ply")));
}

TEST(Outputs, AreWrittenThroughLinksThatAPersonNames) {
  const TestFolder folder;
  const std::string scene = folder.write("scene.obj", room_obj()), path = folder.write("p.path", "2 0 1\n3 0 1\n");
  for (const char* name : {"way.svg", "trace.csv", "c.txt"}) {
    std::filesystem::create_symlink(std::string("real-") + name, folder.file(name));
  }
  for (int again = 0; again < 2; ++again) {
    const ProgramResult walked =
        run_program(ROAM_PROGRAM, {"walk", scene, "--path", path, "--picture", folder.file("way.svg"), "--trace",
                                   folder.file("trace.csv"), "--certify", folder.file("c.txt")});
    EXPECT_EQ(walked.status, 0) << walked.err;
    for (const char* name : {"way.svg", "trace.csv", "c.txt"}) {
      EXPECT_TRUE(std::filesystem::is_symlink(folder.file(name))) << name;
      EXPECT_GT(folder.read(std::string("real-") + name).size(), 10U) << name;
    }
  }
}

TEST(Outputs, AreRefusedBehindLinksThatAnotherUserPutIntoASharedFolder) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can make a link of another user";
  const TestFolder shared, own;
  const std::string scene = own.write("scene.obj", room_obj()), path = own.write("p.path", "2 0 1\n3 0 1\n");
  ASSERT_EQ(::chmod(shared.file("").c_str(), 01777), 0);
  const std::string target = own.file("target"), link = shared.file("x.svg"), folder = shared.file("x.roam");
  std::filesystem::create_directory(own.file("empty"));
  std::filesystem::create_symlink(target, link);
  std::filesystem::create_symlink(own.file("empty"), folder);
  for (const std::string& planted : {link, folder}) ASSERT_EQ(::lchown(planted.c_str(), 12345, 12345), 0);
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"walk", scene, "--path", path, "--trace", link},
                                             {"walk", scene, "--path", path, "--picture", link},
                                             {"walk", scene, "--path", path, "--certify", link},
                                             {"probe", scene, "--from", "2,0,1", "--to", "3,0,1", "--path", link},
                                             {"train", scene, "-o", link},
                                             {"view", scene, "--headless", "--time", "1", "--record-path", link},
                                             {"build", scene, "-o", folder},
                                             {"build", scene, "-o", folder + "/inner.roam"}}) {
    const ProgramResult refused = run_program(ROAM_PROGRAM, arguments);
    EXPECT_EQ(refused.status, arguments[0] == "build" ? 1 : 2) << arguments[0] << ' ' << arguments.back();
    EXPECT_TRUE(contains(refused.err, " is a link that another user put there; choose another place")) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(target)) << arguments.back();
    EXPECT_TRUE(std::filesystem::is_empty(own.file("empty"))) << arguments.back();
  }
}

TEST(Outputs, ReplaceNothingElseThatCameDuringTheWork) {
  const TestFolder folder;
  const std::string scene = folder.write("scene.obj", room_obj());
  const std::string trace = folder.file("t.csv"), certificate = folder.file("c.txt");
  const ProgramResult result = run_program(
      "/bin/sh", {"-c", ROAM_PROGRAM " walk " + scene + " --wander 1e7 --trace " + trace + " --certify " + certificate +
                            " & pid=$!; until ls " + trace +
                            ".*; do kill -0 $pid || exit 9; sleep 0.1; done > /dev/null 2>&1; printf precious > " +
                            trace + "; printf precious > " + certificate + "; kill $pid; wait $pid"});
  EXPECT_EQ(result.status, 143) << result.err;
  EXPECT_EQ(folder.read("t.csv"), "precious");
  EXPECT_EQ(folder.read("c.txt"), "precious");
  EXPECT_TRUE(contains(result.err, trace + ": this would overwrite a file that is no trace")) << result.err;
  EXPECT_TRUE(contains(result.err, certificate + ": this would overwrite a file that is no certificate")) << result.err;
}

TEST(Outputs, AreRefusedBeforeTheWorkIfThereIsNoFolderBehindALink) {
  const TestFolder folder;
  std::filesystem::create_symlink("absent/way.svg", folder.file("way.svg"));
  const ProgramResult probed =
      run_program(ROAM_PROGRAM, {"probe", folder.write("scene.obj", room_obj()), "--from", "2,0,1", "--to", "3,0,1",
                                 "--picture", folder.file("way.svg")});
  EXPECT_EQ(probed.status, 2);
  EXPECT_TRUE(contains(probed.err, "there is no folder " + folder.file("absent"))) << probed.err;
}

TEST(Outputs, OfAWalkAreRefusedBeforeItsSceneIsRead) {
  const TestFolder folder;
  const std::string path = folder.write("way.path", "1 1 1\n2 2 1\n");
  for (const char* const option : {"--trace", "--picture", "--certify"}) {
    const ProgramResult walked = run_program(
        ROAM_PROGRAM, {"walk", folder.file("absent.obj"), "--path", path, option, folder.file("none/way.svg")});
    EXPECT_EQ(walked.status, 2) << option;
    EXPECT_TRUE(contains(walked.err, "way.svg: there is no folder " + folder.file("none"))) << walked.err;
  }
}

TEST(Outputs, ThatAreNotWrittenLeaveAnEarlierFileAndSaySo) {
  const TestFolder folder;
  const std::string scene = folder.write("scene.obj", room_obj()),
                    stays = "the earlier file of that name stays as it was";
  const std::string path = folder.write("way.path", "1 2 3\n4 5 6\n"), fresh = folder.file("fresh.path");
  const auto probe = [&](const std::string& file) {
    return run_program(ROAM_PROGRAM,
                       {"probe", scene, "--from", "2,0,1", "--to", "3,0,1", "--radius", "50", "--path", file});
  };
  const ProgramResult kept = probe(path), none = probe(fresh);
  EXPECT_TRUE(contains(kept.err, "so it was not written; " + stays)) << kept.err;
  EXPECT_TRUE(contains(none.err, "so it was not written\n")) << none.err;
  EXPECT_EQ(folder.read("way.path"), "1 2 3\n4 5 6\n");

  const std::string off = folder.write("off.path", "-0.1 0 0.9\n5 0 0.9\n"), certificate = folder.file("certificate");
  folder.write("certificate", "roam certificate 1\n");
  const ProgramResult fell = run_program(ROAM_PROGRAM, {"walk", scene, "--path", off, "--certify", certificate});
  EXPECT_EQ(fell.status, 1);
  EXPECT_TRUE(contains(fell.err, "put elsewhere on its way has none); " + stays)) << fell.err;
  EXPECT_EQ(folder.read("certificate"), "roam certificate 1\n");
}

TEST(Outputs, ThatCannotBeWrittenCostNoOtherOne) {
  const TestFolder folder;
  const std::string scene = folder.write("scene.obj", room_obj());
  const ProgramResult result = run_program(
      "/bin/sh", {"-c", "ulimit -f 1000; exec " ROAM_PROGRAM " walk " + scene + " --wander 600 --json --trace " +
                            folder.file("t.csv") + " --picture " + folder.file("way.svg")});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_TRUE(contains(result.err, "t.csv: File too large")) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("t.csv")));
  EXPECT_TRUE(std::filesystem::exists(folder.file("way.svg")));
  EXPECT_TRUE(contains(result.out, "\"outcome\"")) << result.out;
}

/// The trace would get the number of standard error, and what is printed there.
TEST(StandardStreams, ThatAreClosedAreNoFile) {
  const TestFolder folder;
  const std::string floor =
      folder.write("floor.obj", "v -9e3 -9e3 0\nv 9e3 -9e3 0\nv 9e3 9e3 0\nv -9e3 9e3 0\nf 1 2 3 4\n");
  const std::string trace = folder.file("t.csv");
  const ProgramResult result = run_program(
      "/bin/sh",
      {"-c",
       ROAM_PROGRAM " walk " + floor + " --wander 1e7 --trace " + trace + " <&- >&- 2>&- & pid=$!; until ls " + trace +
           ".*; do kill -0 $pid || break; sleep 0.1; done > /dev/null 2>&1; readlink /proc/$pid/fd/0 /proc/$pid/fd/1 "
           "/proc/$pid/fd/2; kill $pid; wait $pid"});
  EXPECT_EQ(result.out, "/dev/null\n/dev/null\n/dev/null\n") << result.err;
  EXPECT_EQ(result.status, 143);
  EXPECT_EQ(folder.read("t.csv").rfind("step,t,x,y,z,", 0), 0u);
}

}  // namespace
