#include "import/reader/page_requests.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>

#include "files/descriptor.h"
#include "import/display_part.h"
#include "import/reader/display/pages.h"
#include "import/reader/display/part_pool.h"
#include "import/reader/machine_failure.h"
#include "import/reader/osg_files.h"
#include "import/reader/tileset/tile_pages.h"
#include "import/stream.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

/// Limit of nested pages. Deeper scenes have no end.
constexpr std::size_t page_nesting_limit = 64;

/// Reads `size` bytes. False at the end of the input.
bool take(void* to, std::size_t size) {
  return files::read_fully(STDIN_FILENO, {static_cast<std::byte*>(to), size}) == size;
}

bool take_request(std::string& token) {
  std::uint32_t length = 0;
  if (!take(&length, sizeof(length)) || length > DisplayLevel::page_limit) return false;
  token.resize(length);
  return take(token.data(), length);
}

/// State kept from page to page.
struct Kept {
  PageStates states;
  TileTrees trees;
  std::shared_ptr<Archive> archive;  ///< of the scene, so that its directory is read once; null unless opened
};

void read_page(const std::string& token, SceneFiles& files, MeshSink& sink, Kept& kept) {
  if (const auto tile = tile_page_of(token)) return read_tile_page(*tile, files, sink, kept.trees);
  const std::optional<PageContext> page = page_of(token);
  if (!page) throw Error("a page was asked for that no part has named; install roam anew.");
  const std::string name = page->file.string();
  const bool circle = std::find(page->above.begin(), page->above.end(), hash_of(page->file)) != page->above.end();
  if (circle || page->above.size() > page_nesting_limit) {
    throw Error(name, "this page is reached through itself, or through too many others; the scene is damaged.");
  }
  prepare_osg(sink, files, true);
  const osg::ref_ptr<osg::Node> root = read_osg_file(page->file, true);
  if (root == nullptr) throw Error(name, "this page is absent or unreadable.");
  sink.set_offset(page->offset);
  sink.parts()->begin_page();
  PageWalk(sink, *page, kept.states).walk(*root);
}

}  // namespace

int serve_pages(FrameWriter& frames, const ReadingSettings& settings, const std::optional<Vec3>& origin,
                const SceneScope& scope, const std::function<void()>& greet) {
  Kept kept;
  std::string token;
  while (take_request(token)) {
    frames.begin_stream();
    greet();
    SceneFiles files(scope, frames, std::nullopt, kept.archive);
    PartPool parts(frames, files, origin);
    MeshSink sink(frames, settings, &parts, nullptr);
    try {
      read_page(token, files, sink, kept);
      sink.end();
      kept.archive = files.opened_archive();
    } catch (const Error& error) {
      frames.fail(error);
    } catch (const MachineFailure& failure) {
      frames.fail(failure.error());
    } catch (const std::bad_alloc&) {
      std::fputs("out of memory\n", stderr);
      return EXIT_FAILURE;
    } catch (const std::exception& error) {
      frames.fail(Error(fmt::format("a page's reader gave up: {}. The file is probably damaged.", error.what())));
    }
  }
  return EXIT_SUCCESS;
}

}  // namespace roam::reader
