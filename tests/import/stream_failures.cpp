// Streaming that ends early leaves nothing behind and says why.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "import/stream.h"
#include "import_files.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;
using reader::FrameHeader;
using reader::FrameKind;
using reader::PayloadWriter;
using reader::Totals;

/// So many triangles that the reader cannot have said all when the first piece comes.
std::string long_obj() {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 1'000'000; ++i) text += "f 1 2 3\n";
  return text;
}

void expect_no_child() {
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

class ImportStreamFailures : public testing::Test {
 protected:
  ImportReport stream(const PieceSink& sink, const ImportOptions& options = {}) {
    return stream_scene(std::span(&file_, 1), options, sink);
  }

  /// What streaming says when the reader sends this and ends.
  std::string error_of_stream(const std::string& bytes) {
    const auto data = folder_.write("stream", bytes);
    ImportOptions options;
    options.reader = folder_.write_script("reader.sh", "cat '" + data.string() + "' >&3\n");
    try {
      stream([](const Mesh&, bool) {}, options);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  const TemporaryFolder folder_;
  const fs::path file_ = folder_.write("scene.obj", long_obj());
};

TEST_F(ImportStreamFailures, PassOnWhatTheSinkThrowsAndEndTheReader) {
  int pieces = 0;
  EXPECT_THROW(stream([&](const Mesh&, bool) {
                 if (++pieces == 2) throw std::logic_error("enough");
               }),
               std::logic_error);
  EXPECT_EQ(pieces, 2);
  expect_no_child();
}

TEST_F(ImportStreamFailures, CancelAtTheCallersWish) {
  ImportOptions options;
  options.progress = [](const ImportProgress& progress) { return progress.triangles == 0; };
  EXPECT_THROW(stream([](const Mesh&, bool) { usleep(120'000); }, options), Cancelled);
  expect_no_child();
}

TEST_F(ImportStreamFailures, TellAReaderThatIsKilledInTheMiddle) {
  std::string error;
  try {
    stream([&](const Mesh&, bool continues) {
      if (continues) return;
      const std::vector<pid_t> readers = children_of_this_process();
      ASSERT_EQ(readers.size(), 1u);
      kill(readers[0], SIGKILL);
    });
  } catch (const Error& killed) {
    error = killed.what();
  }
  EXPECT_TRUE(contains(error, "scene.obj")) << error;
  EXPECT_TRUE(contains(error, "its reader was killed")) << error;
  expect_no_child();
}

/// A stream that a reader might send.
class Stream {
 public:
  Stream() { frame(FrameKind::hello, PayloadWriter().add(reader::Greeting{})); }
  Stream& frame(FrameKind kind, const PayloadWriter& payload) {
    FrameHeader header;
    header.kind = kind;
    header.number = number_++;
    header.bytes = static_cast<std::uint32_t>(payload.bytes().size());
    bytes += bytes_of(header) + std::string(reinterpret_cast<const char*>(payload.bytes().data()), header.bytes);
    return *this;
  }
  Stream& object(int continues, const std::string& name = "wall") {
    return frame(FrameKind::object, PayloadWriter().add_text(name).add(static_cast<std::uint8_t>(continues)));
  }
  Stream& vertices(int count, double x = 0.0) {
    PayloadWriter payload;
    for (int i = 0; i < 3 * count; ++i) payload.add(x);
    return frame(FrameKind::vertices, payload);
  }
  Stream& triangles(std::uint64_t count, std::uint32_t corner = 0) {
    PayloadWriter payload;
    for (std::uint64_t i = 0; i < 3 * count; ++i) payload.add(corner);
    return frame(FrameKind::triangles, payload);
  }
  Stream& end(std::uint64_t vertices, std::uint64_t triangles) {
    Totals totals;
    totals.vertices = vertices;
    totals.triangles = triangles;
    return frame(FrameKind::end, PayloadWriter().add(totals).add(std::uint32_t{0}));
  }
  std::string bytes;

 private:
  std::uint32_t number_ = 0;
};

TEST_F(ImportStreamFailures, RefuseADamagedStream) {
  EXPECT_EQ(
      error_of_stream(Stream().object(0).vertices(3).triangles(2).object(1).vertices(1).triangles(1).end(4, 3).bytes),
      "");
  const auto refused = [&](const Stream& stream, const std::string& how) {
    const std::string error = error_of_stream(stream.bytes);
    EXPECT_TRUE(contains(error, "its reader sent " + how)) << error;
  };
  refused(Stream().object(1), "a piece of no object");
  refused(Stream().object(0).vertices(1).triangles(1).object(1, "roof"), "a piece of no object");
  refused(Stream().object(2), "a frame of broken length");
  refused(Stream().object(0).object(0), "a piece without triangles");
  refused(Stream().object(0).vertices(1).end(1, 0), "a piece without triangles");
  refused(Stream().object(0).vertices(2, std::numeric_limits<double>::quiet_NaN()), "a vertex that is not finite");
  refused(Stream().object(0).vertices(2, -1.5e9), "a vertex that is not finite");
  refused(Stream().object(0).vertices(3).triangles(1, 3), "a triangle without its vertices");
  refused(Stream().object(0).vertices(3).triangles(1).object(1).triangles(1, 2), "a triangle without its vertices");
  refused(Stream().object(0).vertices(3).triangles(piece_triangles).triangles(1), "a piece that is too large");
  refused(Stream().vertices(1), "vertices of no object");
  refused(Stream().triangles(1), "triangles of no object");
  refused(Stream().object(0).vertices(3).triangles(1).end(3, 2), "totals that are not those");
  refused(Stream().frame(FrameKind::tile, PayloadWriter().add_text("Tile_1").add(std::uint8_t{1}).add_text("")),
          "a frame of unknown kind");
  refused(Stream().frame(FrameKind::opened, PayloadWriter().add_text("/" + std::string(4096, 'a'))),
          "a path that is too long");
}

TEST_F(ImportStreamFailures, CostLittleWhereAReaderNamesDeepFilesOverAndOver) {
  std::string path = folder_.path().string();
  while (path.size() < 4090) path += "/a";
  std::string bytes;
  {
    Stream stream;
    for (int i = 0; i < 20'000; ++i) stream.frame(FrameKind::opened, PayloadWriter().add_text(path));
    bytes = stream.object(0).vertices(3).triangles(1).end(3, 1).bytes;
  }
  EXPECT_EQ(error_of_stream(bytes), "");
}

TEST_F(ImportStreamFailures, EndAReaderThatLeavesOutMoreTrianglesThanItsFileMayHave) {
  const auto left_out = [](std::uint64_t triangles) {
    Stream stream;
    for (const auto reason : {reader::LeftOutReason::bad_vertices, reader::LeftOutReason::ignored}) {
      stream.frame(FrameKind::left_out, PayloadWriter().add(reason).add_text("a").add(std::uint64_t{0}).add(triangles));
    }
    return stream.object(0).vertices(3).triangles(1).end(3, 1).bytes;
  };
  EXPECT_EQ(error_of_stream(left_out(9'000'000)), "");
  for (const std::uint64_t triangles : {std::uint64_t{11'000'000}, std::uint64_t{1} << 63, ~std::uint64_t{0}}) {
    EXPECT_TRUE(contains(error_of_stream(left_out(triangles)), "it repeats itself over and over")) << triangles;
  }
}

TEST_F(ImportStreamFailures, KeepTheStartsOfLongNamesOnly) {
  Stream stream;
  const std::string start = std::string(1023, 'a');
  // The second name's last byte that fits is half of a character.
  for (const std::string end : {"b", "\u00e4", "c"}) {
    const std::string name = start + end + std::string(60'000, 'd');
    stream.frame(FrameKind::left_out, PayloadWriter()
                                          .add(reader::LeftOutReason::bad_vertices)
                                          .add_text(name)
                                          .add(std::uint64_t{1})
                                          .add(std::uint64_t{2}));
    stream.object(0, name).vertices(3).triangles(1);
  }
  const auto data = folder_.write("stream", stream.end(9, 3).bytes);
  ImportOptions options;
  options.reader = folder_.write_script("reader.sh", "cat '" + data.string() + "' >&3\n");
  std::vector<std::string> names;
  const ImportReport report = this->stream([&](const Mesh& piece, bool) { names.push_back(piece.name); }, options);
  EXPECT_EQ(names, (std::vector<std::string>{start + "b", start, start + "c"}));
  ASSERT_EQ(report.bad_objects.size(), 3u);
  EXPECT_EQ(report.bad_objects[1].name, start);
}

}  // namespace
}  // namespace roam::test
