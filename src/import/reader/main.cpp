// roam-reader: the child process that opens scene files for roam. It trusts no file, and roam trusts nothing of it.

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/personality.h>
#endif

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

#include "import/reader/display/part_pool.h"
#include "import/reader/file_names.h"
#include "import/reader/frame_writer.h"
#include "import/reader/machine_failure.h"
#include "import/reader/mesh_sink.h"
#include "import/reader/numbers.h"
#include "import/reader/page_requests.h"
#include "import/reader/piece_cutter.h"
#include "import/reader/read_path.h"
#include "import/reader/sandbox/sandbox.h"
#include "import/reader/scene_files.h"
#include "import/reader/tileset/outline.h"
#include "import/stream.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

/// Address space of the program's own code, its libraries and their plugins, before a file is opened.
constexpr std::uint64_t own_address_space = std::uint64_t{1} << 30;

/// More memory than any machine has.
constexpr std::uint64_t any_memory = std::uint64_t{1} << 56;

/// The part of the memory limit for reading in pieces that is not data of this process: code of the program and its
/// libraries, and the window and piece of the receiver.
constexpr std::uint64_t memory_beside_data = 28u << 20;

struct Request {
  ReadingSettings settings;
  bool display = false;
  bool pieces = false;
  bool pages = false;
  std::optional<Vec3> origin;
  SceneScope scope;  ///< the files that may be read
  int highest_landlock = any_landlock;
  std::optional<ArchiveEntry> entry;  ///< of the part, in an archive
  bool only_walls = false;            ///< read nothing; only report which walls hold
};

/// Most bytes of vertices in the temporary file. The shortest vertex of a file has three bytes and is stored as three
/// doubles. Foreign readers may pack more tightly, but keep their data in memory, at least as floats. A file whose
/// compression or instances make more of less than that is refused, with the advice to allow more memory.
std::uint64_t temporary_bytes(const Request& request) {
  const std::uint64_t memory_limit = request.settings.memory_limit;
  std::filesystem::path file = request.scope.scene;
  std::error_code none;
  const auto folder = std::filesystem::is_directory(file, none) ? file : file.parent_path();
  // A part of a tileset counts with its content, in an archive with the whole archive.
  const auto content = content_of(request.settings.tile, folder);
  if (content && !is_archive_name(file)) file = request.scope.find(content->file);
  const auto bytes = std::filesystem::is_regular_file(file, none) ? std::filesystem::file_size(file, none) : 0;
  return 8 * std::min<std::uint64_t>(none ? 0 : bytes, any_memory) + 2 * std::min(memory_limit, any_memory);
}

double number(const std::string& word) {
  double value = 0.0;
  if (!parse(word, value)) throw std::invalid_argument(word);
  return value;
}

/// Parses the arguments, which the library writes. Invalid ones mean mixed versions, or a person's command.
bool parse_arguments(const std::vector<std::string>& arguments, Request& request) {
  ReadingSettings& settings = request.settings;
  std::size_t i = 0;
  const auto left = [&] { return arguments.size() - i; };
  while (left() > 0) {
    const std::string& name = arguments[i++];
    if (name == "--" && left() == 1) {
      request.scope.scene = arguments[i];
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
    } else if (name == "--entry" && left() > 1) {
      request.entry = ArchiveEntry{.record = std::stoull(arguments[i]), .number = std::stoull(arguments[i + 1])};
      i += 2;
    } else if (name == "--folder" && left() > 0) {
      request.scope.folders.emplace_back(arguments[i++]);
    } else if (name == "--file" && left() > 0) {
      request.scope.files.emplace_back(arguments[i++]);
    } else if (name == "--highest-landlock" && left() > 0) {
      request.highest_landlock = std::stoi(arguments[i++]);
    } else if (name == "--only-walls") {
      request.only_walls = true;
    } else if (name == "--only-list") {
      settings.only_list = true;
    } else if (name == "--pieces") {
      request.pieces = true;
    } else if (name == "--display") {
      request.display = true;
    } else if (name == "--pages") {
      request.pages = true;
    } else if (name == "--origin" && left() > 2) {
      request.origin = Vec3(0.0);
      for (int k = 0; k < 3; ++k) (*request.origin)[k] = number(arguments[i++]);
    } else {
      return false;
    }
  }
  return false;
}

void greet(FrameWriter& frames, const Confinement& walls) {
  const auto flag = [](bool holds) { return static_cast<std::uint8_t>(holds); };
  frames.send(FrameKind::hello, PayloadWriter().add(Greeting{stream_version, walls.landlock, flag(walls.system_calls),
                                                             flag(walls.no_new_privileges), flag(walls.limits),
                                                             flag(walls.empty_folder)}));
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
  const std::uint64_t memory = request.settings.memory_limit;
  const std::string path = request.scope.scene.string();
  Rights rights;
  rights.scope = request.scope;
  rights.address_space = std::min(memory, any_memory) + own_address_space;
  rights.data = request.pieces ? memory - std::min(memory, memory_beside_data) : memory;
  rights.file_size = request.pieces ? temporary_bytes(request) : 0;
  // Listing files needs no library.
  const bool reads = !request.only_walls && !request.settings.only_list;
  FrameWriter frames(stream_fd);
  std::optional<PieceCutter> pieces;
  const Confinement walls = confine(rights, stream_fd, request.highest_landlock, [&] {
    if (reads) load_libraries(path, request.display || request.pages);
    if (request.pieces) pieces.emplace(frames, memory);
  });
  SceneFiles files(request.scope, frames, request.entry);
  PartPool parts(frames, files, request.origin);
  MeshSink sink(frames, request.settings, request.display ? &parts : nullptr, pieces ? &*pieces : nullptr);
  if (request.pages) {
    return serve_pages(frames, request.settings, request.origin, request.scope, [&] { greet(frames, walls); });
  }
  greet(frames, walls);
  // Flush at once, so that a reader with a long computation does not seem to have failed to start.
  frames.flush();
  if (request.only_walls) return EXIT_SUCCESS;
  const auto fail = [&](const Error& error) {
    std::string sentence = error.what();
    if (files.left_any_out()) {
      sentence += fmt::format(" It refers to {}, which lies outside of its folder; --allow lets a folder in.",
                              files.first_left_out());
    }
    frames.fail(Error::at(error.where(), sentence));
    return EXIT_FAILURE;
  };
  if (reads && walls.landlock == 0 && extension_of(path) == "iv") {
    return fail({path,
                 "Inventor files are not read here: their library opens whatever they name, and this system has no "
                 "Landlock to keep it to the scene. Convert the file to glTF, OBJ or PLY."});
  }
  try {
    read_path(path, files, sink, request.settings);
    sink.end();
    return EXIT_SUCCESS;
  } catch (const Error& error) {
    return fail(error);
  } catch (const MachineFailure& failure) {
    return fail(failure.error());
  } catch (const std::bad_alloc&) {
    // The program makes the message, because it knows the limit. See cause_of_death.
    std::fputs("out of memory\n", stderr);
    return EXIT_FAILURE;
  } catch (const std::exception& error) {
    return fail({path, fmt::format("its reader gave up: {}. The file is probably damaged.", error.what())});
  }
}

}  // namespace
}  // namespace roam::reader

int main(int argc, char** argv) {
#ifdef __linux__
  // Old personalities let this process and its children execute any readable memory. A new start ends that.
  const int ways = personality(0xFFFFFFFF);
  if (ways >= 0 && (ways & READ_IMPLIES_EXEC) != 0 && personality(ways & ~READ_IMPLIES_EXEC) >= 0) {
    execv("/proc/self/exe", argv);
  }
#endif
  const int status = roam::reader::run(std::vector<std::string>(argv + 1, argv + argc));
  // All output is written. Plugins of foreign libraries need not be unloaded, and some crash when they are.
  std::fflush(stderr);
  _exit(status);
}
