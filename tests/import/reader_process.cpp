// A reader that crashes, hangs, eats memory or talks nonsense costs an error message, not the program.

#include <dirent.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "import/stream.h"
#include "import_files.h"
#include "sanitizer.h"

namespace roam::test {
namespace {

using reader::FrameHeader;
using reader::FrameKind;
using reader::PayloadWriter;
using reader::Totals;

const std::string one_triangle = "v 1 2 3\nv 4 5 6\nv 7 9 8\nf 1 2 3\n";

/// A stream that a reader might send.
class Stream {
 public:
  Stream& frame(FrameKind kind, const std::string& payload) {
    FrameHeader header;
    header.kind = kind;
    header.number = number_++;
    header.bytes = static_cast<std::uint32_t>(payload.size());
    bytes_ += bytes_of(header) + payload;
    return *this;
  }
  Stream& frame(FrameKind kind, const PayloadWriter& payload) {
    return frame(kind, std::string(reinterpret_cast<const char*>(payload.bytes().data()), payload.bytes().size()));
  }
  Stream& hello() { return frame(FrameKind::hello, PayloadWriter().add(reader::Greeting{})); }
  Stream& object() { return frame(FrameKind::object, PayloadWriter().add_text("wall").add(std::uint8_t{0})); }
  Stream& vertices(const std::vector<double>& coordinates) {
    PayloadWriter payload;
    for (const double c : coordinates) payload.add(c);
    return frame(FrameKind::vertices, payload);
  }
  Stream& triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return frame(FrameKind::triangles, PayloadWriter().add(a).add(b).add(c));
  }
  Stream& end(std::uint64_t vertices, std::uint64_t triangles) {
    Totals totals;
    totals.vertices = vertices;
    totals.triangles = triangles;
    return frame(FrameKind::end, PayloadWriter().add(totals).add(std::uint32_t{0}));
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::uint32_t number_ = 0;
};

const std::vector<double> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};

class ImportReaderProcess : public testing::Test {
 protected:
  /// What importing a good file says when a script with these commands is the reader.
  std::string error_of(const std::string& commands, ImportOptions options = {}) {
    options.reader = folder_.write_script("reader.sh", commands);
    return import_error(file_, options);
  }
  /// What it says when the reader sends this and ends.
  std::string error_of_stream(const std::string& bytes) {
    const auto data = folder_.write("stream", bytes);
    return error_of("cat '" + data.string() + "' >&3\n");
  }

  const TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.write("scene.obj", one_triangle);
};

TEST_F(ImportReaderProcess, TakesAWholeStream) {
  EXPECT_EQ(error_of_stream(Stream().hello().object().vertices(corners).triangle(0, 1, 2).end(3, 1).bytes()), "");
}

TEST_F(ImportReaderProcess, NamesTheSignalOfACrash) {
  const std::string killed = error_of("kill -KILL $$\n");
  EXPECT_TRUE(contains(killed, "scene.obj"));
  EXPECT_TRUE(contains(killed, "its reader was killed"));
  const std::string crashed = error_of("echo 'vertex list corrupt' >&2; kill -SEGV $$\n");
  EXPECT_TRUE(contains(crashed, "crash with signal 11"));
  EXPECT_TRUE(contains(crashed, "its last words: vertex list corrupt"));
}

TEST_F(ImportReaderProcess, TellsAReaderThatStopsWithoutAnAnswer) {
  EXPECT_TRUE(contains(error_of("exit 5\n"), "stop without an answer, with status 5"));
  EXPECT_TRUE(contains(error_of_stream(Stream().hello().object().vertices(corners).bytes()), "without an answer"));
}

TEST_F(ImportReaderProcess, EndsAReaderThatHangs) {
  ImportOptions options;
  options.silence_limit = 0.3;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(contains(error_of("exec sleep 600\n", options), "said nothing for"));
  // A hang that also closed its stream.
  EXPECT_TRUE(contains(error_of("exec sleep 600 3>&- \n", options), "without an answer"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
}

TEST_F(ImportReaderProcess, PassesOnWhatTheReaderSaysIsWrong) {
  const auto failure = PayloadWriter().add_text("scene.obj:7").add_text("scene.obj:7: so");
  EXPECT_EQ(error_of_stream(Stream().hello().frame(FrameKind::failure, failure).bytes()), "scene.obj:7: so");
}

TEST_F(ImportReaderProcess, RefusesADamagedStream) {
  const auto refused = [&](const Stream& stream, const std::string& how) {
    const std::string error = error_of_stream(stream.bytes());
    EXPECT_TRUE(contains(error, "its reader sent " + how)) << error;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused(Stream().hello().object().vertices({0, 0, nan}), "a vertex that is not finite");
  refused(Stream().hello().object().vertices({0, 0, 2e9}), "a vertex that is not finite");
  refused(Stream().hello().object().vertices({0, 0}), "a frame of broken length");
  refused(Stream().hello().object().vertices(corners).triangle(0, 1, 3), "a triangle without its vertices");
  refused(Stream().hello().vertices(corners), "vertices of no object");
  refused(Stream().hello().triangle(0, 0, 0), "triangles of no object");
  refused(Stream().hello().object().vertices(corners).triangle(0, 1, 2).end(3, 2), "totals that are not those");
  refused(Stream().hello().frame(FrameKind::object, "\xff\xff\xff\xff"), "a frame of broken length");
  refused(Stream().hello().frame(static_cast<FrameKind>(77), ""), "a frame of unknown kind");
  refused(Stream().object(), "no greeting");
  refused(Stream().frame(FrameKind::hello, PayloadWriter().add(std::uint32_t{999})), "another version");
  EXPECT_TRUE(contains(error_of("head -c 100000 /dev/zero >&3\n"), "bytes that are no frame"));
  const std::string hello = Stream().hello().bytes();
  EXPECT_TRUE(contains(error_of_stream(hello + hello), "frames out of order"));
}

TEST_F(ImportReaderProcess, BoundsTheMemoryOfWhatAReaderSends) {
  Stream stream;
  stream.hello().object();
  const std::vector<double> many(3 * 100000, 1.0);
  for (int i = 0; i < 40; ++i) stream.vertices(many);
  const auto data = folder_.write("stream", stream.bytes());
  ImportOptions options;
  options.memory_limit = 64u << 20;
  EXPECT_TRUE(
      contains(error_of("cat '" + data.string() + "' >&3\n", options), "needs more than the 0.0625 GiB of memory"));
}

TEST_F(ImportReaderProcess, BoundsTheMemoryOfTheReader) {
  ROAM_NEEDS_PLAIN_MEMORY();
  // The header of an OFF file makes its reader ask for 0.5 GB, which this machine has.
  const auto file = folder_.write("huge.off", "OFF\n20000000 20000000 0\n0 0 0\n");
  ImportOptions options;
  options.memory_limit = 256u << 20;
  EXPECT_TRUE(contains(import_error(file, options), "GiB of memory that importing may use"));
}

TEST_F(ImportReaderProcess, CancelsAtTheCallersWish) {
  ImportOptions options;
  options.reader = folder_.write_script("reader.sh", "exec sleep 600\n");
  int calls = 0;
  options.progress = [&](const ImportProgress& progress) {
    EXPECT_EQ(progress.path, file_);
    EXPECT_EQ(progress.bytes_total, one_triangle.size());
    return ++calls < 3;
  };
  EXPECT_THROW(static_cast<void>(import_scene(file_, options)), Cancelled);
  EXPECT_EQ(calls, 3);
}

TEST_F(ImportReaderProcess, CancelsWhileTheFilesOfAFolderAreCounted) {
  constexpr std::uint64_t files = 5000;
  for (std::uint64_t i = 0; i < files; ++i) (void)folder_.write("folder/" + std::to_string(i), "x");
  ImportOptions options;
  std::uint64_t counted = 0;
  options.progress = [&](const ImportProgress& progress) {
    counted = progress.bytes_total;
    return false;
  };
  EXPECT_THROW(static_cast<void>(import_scene(folder_.path() / "folder", options)), Cancelled);
  EXPECT_LT(counted, files);
}

TEST_F(ImportReaderProcess, PassesOnWhatTheCallbackThrows) {
  ImportOptions options;
  options.progress = [](const ImportProgress&) -> bool { throw std::logic_error("enough"); };
  EXPECT_THROW(static_cast<void>(import_scene(file_, options)), std::logic_error);
}

TEST_F(ImportReaderProcess, RefusesSettingsThatMakeNoSense) {
  EXPECT_TRUE(contains(import_error(file_, {.memory_limit = 1000}), "at least 64 MiB"));
  EXPECT_TRUE(contains(import_error(file_, {.silence_limit = 0}), "above 0"));
  EXPECT_TRUE(contains(import_error(file_, {.silence_limit = std::numeric_limits<double>::quiet_NaN()}), "above 0"));
}

TEST_F(ImportReaderProcess, SaysWhereItLookedForTheReader) {
  EXPECT_TRUE(contains(import_error(file_, {.reader = folder_.path() / "none"}), "is not a program that can be run"));
  setenv("ROAM_READER", file_.c_str(), 1);
  EXPECT_TRUE(contains(import_error(file_), "named by the environment variable ROAM_READER"));
  unsetenv("ROAM_READER");
  EXPECT_EQ(import_error(file_), "");
}

std::size_t open_descriptors() {
  std::size_t count = 0;
  DIR* folder = opendir("/proc/self/fd");
  if (folder == nullptr) return 0;
  while (readdir(folder) != nullptr) ++count;
  closedir(folder);
  return count;
}

TEST_F(ImportReaderProcess, LeavesNoChildAndNoDescriptorBehind) {
  const std::size_t before = open_descriptors();
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(import_error(file_), "");
    EXPECT_NE(error_of("exit 1\n"), "");
    EXPECT_NE(error_of("head -c 99 /dev/zero >&3; exec sleep 600\n"), "");
  }
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST_F(ImportReaderProcess, WorksWhereTheProgramIgnoresItsChildren) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(import_error(file_), "");
  EXPECT_NE(error_of("exit 1\n"), "");
  std::signal(SIGCHLD, before);
}

TEST_F(ImportReaderProcess, SurvivesAReaderThatNeverStopsComplaining) {
  ImportOptions options;
  options.silence_limit = 0.5;
  EXPECT_TRUE(contains(error_of("while true; do echo complaint; done\n", options), "said nothing for"));
}

TEST_F(ImportReaderProcess, ServesSeveralThreadsAtOnce) {
  std::vector<std::thread> threads;
  std::vector<std::size_t> counts(8, 0);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    threads.emplace_back([&, i] {
      for (int k = 0; k < 5; ++k) counts[i] += import_scene(file_).meshes.size();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::size_t count : counts) EXPECT_EQ(count, 5u);
}

}  // namespace
}  // namespace roam::test
