#include "reading.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <optional>

#include "display_part_made.h"
#include "import/assembler.h"
#include "import/part_receiver.h"
#include "import/piece_receiver.h"
#include "import/reader/machine_failure.h"
#include "import/reader/mesh_sink.h"
#include "import/reader/read_path.h"
#include "import/scene_scope.h"
#include "roam/import.h"
#include "roam/mesh.h"

namespace fuzz {
namespace {

using namespace roam::reader;

/// Bytes. More than any input of a fuzzer justifies.
constexpr std::uint64_t memory_limit = 64 << 20;

void add_mesh(Outcome& outcome, const roam::Mesh& mesh) {
  for (const roam::Vec3& v : mesh.vertices) {
    const double most = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    demand(most <= roam::coordinate_limit && !std::isnan(v.x + v.y + v.z), "a vertex that is nowhere");
  }
  for (const auto& corners : mesh.triangles) {
    for (const std::uint32_t corner : corners) {
      demand(corner < mesh.vertices.size(), "a triangle without its vertices");
      for (int k = 0; k < 3; ++k) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &mesh.vertices[corner][k], sizeof bits);
        outcome.corners = (outcome.corners ^ bits) * 0x9E3779B97F4A7C15ULL;
      }
    }
  }
  outcome.triangles += mesh.triangles.size();
}

/// Passes the stream on in pieces, as a pipe does. Returns whether it ended in a scene.
template <class Receiver>
bool pass(Receiver& receiver, std::string_view stream) {
  while (!stream.empty() && !receiver.ended()) {
    const std::span<std::byte> room = receiver.room();
    const std::size_t count = std::min<std::size_t>(room.size(), stream.size());
    std::memcpy(room.data(), stream.data(), count);
    stream.remove_prefix(count);
    receiver.take(count);
  }
  return receiver.ended();
}

bool pass_to_receiver(Outcome& outcome, std::string_view stream, Wanted wanted) {
  if (wanted == Wanted::meshes) {
    roam::ImportedScene scene;
    Assembler receiver(scene, 0, memory_limit);
    const bool ended = pass(receiver, stream);
    if (ended) {
      for (const roam::Mesh& mesh : scene.meshes) add_mesh(outcome, mesh);
      demand(scene.report.triangles == outcome.triangles, "a report of other triangles");
    }
    return ended;
  }
  if (wanted == Wanted::pieces) {
    roam::ImportReport report;
    const roam::PieceSink sink = [&](const roam::Mesh& piece, bool) { add_mesh(outcome, piece); };
    PieceReceiver receiver(report, 0, sink);
    return pass(receiver, stream);
  }
  roam::DisplayReport report;
  std::optional<roam::Vec3> origin;
  const std::function<bool(roam::DisplayPart &&)> give = [&](roam::DisplayPart&& part) {
    demand(roam::test::is_valid(part), "a part that cannot be drawn");
    outcome.triangles += part.triangles;
    return true;
  };
  PartReceiver receiver(report, origin, 0, memory_limit, give);
  return pass(receiver, stream);
}

}  // namespace

Stream::Stream() : descriptor_(memfd_create("stream", MFD_CLOEXEC)) {
  if (descriptor_ < 0) fail("no file in memory");
}

void Stream::clear() const {
  if (ftruncate(descriptor_, 0) != 0 || lseek(descriptor_, 0, SEEK_SET) != 0) fail("the stream cannot be cleared");
}

std::string Stream::bytes() const {
  struct stat state {};
  if (fstat(descriptor_, &state) != 0) fail("the stream has no size");
  std::string all(static_cast<std::size_t>(state.st_size), '\0');
  if (pread(descriptor_, all.data(), all.size(), 0) != state.st_size) fail("the stream cannot be read");
  return all;
}

void read_to(const Stream& stream, const std::string& file, Wanted wanted,
             const std::function<void(const std::function<void()>& prepare)>& confine) {
  ReadingSettings settings;
  settings.memory_limit = memory_limit;
  FrameWriter frames(stream.descriptor());
  std::optional<PieceCutter> pieces;
  const SceneScope scope = scope_of(file, {});
  confine([&] {
    if (wanted == Wanted::pieces) pieces.emplace(frames, memory_limit);
  });
  SceneFiles files(scope, frames);
  PartPool parts(frames, files, std::nullopt);
  MeshSink sink(frames, settings, wanted == Wanted::display ? &parts : nullptr, pieces ? &*pieces : nullptr);
  frames.send(FrameKind::hello, PayloadWriter().add(Greeting{}));
  try {
    read_path(file, files, sink, settings);
    sink.end();
    frames.flush();
  } catch (const roam::Error& error) {
    frames.fail(error);
  } catch (const MachineFailure& failure) {
    frames.fail(failure.error());
  }
}

Outcome taken(std::string_view stream, Wanted wanted, bool hostile) {
  Outcome outcome;
  bool ended = false;
  outcome.error = complaint([&] {
    try {
      ended = pass_to_receiver(outcome, stream, wanted);
    } catch (const StreamReceiver::StreamDamaged& damage) {
      if (!hostile) fail("the reader sent " + damage.how);
      throw roam::Error(damage.how);
    } catch (const StreamReceiver::ContentTooLarge&) {
      throw roam::Error("too large");
    }
    if (!ended) throw roam::Error("no end");
  });
  return outcome;
}

}  // namespace fuzz
