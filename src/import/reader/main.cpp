// roam-reader: the child process that opens scene files for roam. It trusts no file, and roam trusts nothing of it.

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "import/reader/display/part_pool.h"
#include "import/reader/frame_writer.h"
#include "import/reader/mesh_sink.h"
#include "import/reader/numbers.h"
#include "import/reader/piece_cutter.h"
#include "import/reader/read_path.h"
#include "import/stream.h"
#include "roam/error.h"

// Sanitizers reserve terabytes of address space; a limit on it would end the reader before it begins.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ROAM_SHADOW_MEMORY 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ROAM_SHADOW_MEMORY 1
#endif
#endif

namespace roam::reader {
namespace {

/// Address space that the program's own code, its libraries and their plugins take before a file is opened.
[[maybe_unused]] constexpr rlim_t own_address_space = rlim_t{1} << 30;

/// Of the memory for reading in pieces, what is not data of this process: its code and that of its libraries, and the
/// receiver's window and piece.
[[maybe_unused]] constexpr std::uint64_t memory_beside_data = 28u << 20;

void limit(int resource, rlim_t value, rlim_t soft) {
  const struct rlimit both { soft, value };
  setrlimit(static_cast<__rlimit_resource_t>(resource), &both);
}
void limit(int resource, rlim_t value) { limit(resource, value, value); }

/// Bytes that vertices may take outside the memory. The shortest vertex of a file has three bytes, and is kept as three
/// doubles; foreign readers pack more tightly, but hold in memory what they read, in floats at least.
rlim_t temporary_bytes(const std::string& path, std::uint64_t memory_limit) {
  std::error_code none;
  const auto bytes = std::filesystem::is_regular_file(path, none) ? std::filesystem::file_size(path, none) : 0;
  return 8 * static_cast<rlim_t>(none ? 0 : bytes) + 2 * static_cast<rlim_t>(memory_limit);
}

/// What a file must not be able to do: take more memory, leave a core, write a file, or outlive the program.
void confine([[maybe_unused]] std::uint64_t memory_limit, [[maybe_unused]] bool pieces, rlim_t temporary_bytes) {
#ifndef ROAM_SHADOW_MEMORY
  limit(RLIMIT_AS, static_cast<rlim_t>(memory_limit) + own_address_space);
  // Foreign readers hold a whole file; where that must fit, all that can be written counts.
  if (pieces) limit(RLIMIT_DATA, static_cast<rlim_t>(memory_limit - std::min(memory_limit, memory_beside_data)));
#endif
  limit(RLIMIT_CORE, 0);
  // PagedVertices lifts it for its own file.
  limit(RLIMIT_FSIZE, temporary_bytes, 0);
#ifdef __linux__
  const pid_t parent = getppid();
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(EXIT_FAILURE);
  // Descriptors that the program holds open and did not mark are no business of a reader.
  close_range(stream_fd + 1, ~0u, 0);
#endif
}

struct Request {
  ReadingSettings settings;
  bool display = false;
  bool pieces = false;
  std::optional<Vec3> origin;
  std::string path;
};

double number(const std::string& word) {
  double value = 0.0;
  if (!parse(word, value)) throw std::invalid_argument(word);
  return value;
}

/// The arguments are written by the library; a wrong one is a mix of versions, or a person.
bool parse_arguments(const std::vector<std::string>& arguments, Request& request) {
  ReadingSettings& settings = request.settings;
  std::size_t i = 0;
  const auto left = [&] { return arguments.size() - i; };
  while (left() > 0) {
    const std::string& name = arguments[i++];
    if (name == "--" && left() == 1) {
      request.path = arguments[i];
      return true;
    }
    if (name == "--unit" && left() > 0) {
      settings.metres_per_unit = number(arguments[i++]);
    } else if (name == "--memory" && left() > 0) {
      settings.memory_limit = std::stoull(arguments[i++]);
    } else if (name == "--up" && left() > 0) {
      settings.up = parse_up_axis(arguments[i++]);
    } else if (name == "--ignore" && left() > 0) {
      settings.ignore.push_back(arguments[i++]);
    } else if (name == "--frame" && left() > 3) {
      Georeference frame;
      for (int k = 0; k < 3; ++k) frame.origin[k] = number(arguments[i++]);
      frame.srs = arguments[i++];
      settings.frame = frame;
    } else if (name == "--tile" && left() > 0) {
      settings.tile = arguments[i++];
    } else if (name == "--only-list") {
      settings.only_list = true;
    } else if (name == "--pieces") {
      request.pieces = true;
    } else if (name == "--display") {
      request.display = true;
    } else if (name == "--origin" && left() > 2) {
      request.origin = Vec3(0.0);
      for (int k = 0; k < 3; ++k) (*request.origin)[k] = number(arguments[i++]);
    } else {
      return false;
    }
  }
  return false;
}

int run(const std::vector<std::string>& arguments) {
  Request request;
  bool understood = false;
  try {
    understood = parse_arguments(arguments, request);
  } catch (const std::exception&) {
    understood = false;
  }
  if (!understood || fcntl(stream_fd, F_GETFD) < 0) {
    std::fputs("roam-reader opens scene files for roam, which starts it; there is nothing to run by hand.\n", stderr);
    return 2;
  }
  confine(request.settings.memory_limit, request.pieces,
          request.pieces ? temporary_bytes(request.path, request.settings.memory_limit) : 0);

  FrameWriter frames(stream_fd);
  frames.send(FrameKind::hello, PayloadWriter().add(stream_version));
  PartPool parts(frames, request.origin);
  std::optional<PieceCutter> pieces;
  if (request.pieces) pieces.emplace(frames, request.settings.memory_limit);
  MeshSink sink(frames, request.settings, request.display ? &parts : nullptr, pieces ? &*pieces : nullptr);
  const auto fail = [&](const std::string& sentence) {
    frames.send(FrameKind::failure, PayloadWriter().add_text(sentence));
    frames.flush();
    return EXIT_FAILURE;
  };
  try {
    read_path(request.path, sink, request.settings);
    sink.end();
    return EXIT_SUCCESS;
  } catch (const Error& error) {
    return fail(error.what());
  } catch (const std::bad_alloc&) {
    // The program words this one: it knows the limit. See cause_of_death.
    std::fputs("out of memory\n", stderr);
    return EXIT_FAILURE;
  } catch (const std::exception& error) {
    return fail(fmt::format("{}: its reader gave up: {}. The file is probably damaged.", request.path, error.what()));
  }
}

}  // namespace
}  // namespace roam::reader

int main(int argc, char** argv) {
  const int status = roam::reader::run(std::vector<std::string>(argv + 1, argv + argc));
  // Everything is said: plugins of foreign libraries need not be unloaded, and some crash when they are.
  std::fflush(stderr);
  _exit(status);
}
