#pragma once
/// \file
/// Reading of a displayed scene's pages on demand.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <list>
#include <mutex>
#include <string>
#include <vector>

#include "import/display_part.h"
#include "roam/import.h"

namespace roam {

/// Reads pages in child processes, one for each path. A few of them, those used last, stay for further pages. A page
/// that makes its reader crash or send invalid data ends that reader; the next page has a new one.
class PageReader {
 public:
  /// Takes the `paths` and `options` of read_display. It does not call the progress function.
  PageReader(std::vector<std::filesystem::path> paths, const ImportOptions& options);
  ~PageReader();
  PageReader(const PageReader&) = delete;
  PageReader& operator=(const PageReader&) = delete;

  /// The contents of a page (DisplayLevel::page), given the source and origin of the part that names it. Blocks; calls
  /// from several threads wait for each other. Throws roam::Error if the page is absent or unreadable, and
  /// roam::Cancelled.
  [[nodiscard]] DisplayPart read(std::uint32_t source, const Vec3& origin, const std::string& page);

  /// Cancels the present read and all later ones. Any thread.
  void cancel() { cancelled_ = true; }

 private:
  struct Reader;
  Reader& reader_of(std::uint32_t source, const Vec3& origin);

  std::vector<std::filesystem::path> paths_;
  ImportOptions options_;
  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;
  std::list<Reader> readers_;  ///< most recently used first
};

}  // namespace roam
