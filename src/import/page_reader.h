#pragma once
/// \file
/// Pages of a scene that is shown, read as they are wanted.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "import/display_part.h"
#include "roam/import.h"

namespace roam {

/// Reads pages in child processes that stay, one a path, of which as many are kept as are in use. A page that makes its
/// reader crash, or say what is no page, costs that reader: the next page has a new one.
class PageReader {
 public:
  /// `paths` and `options` are those that read_display was given; its progress is not asked.
  PageReader(std::vector<std::filesystem::path> paths, const ImportOptions& options);
  ~PageReader();
  PageReader(const PageReader&) = delete;
  PageReader& operator=(const PageReader&) = delete;

  /// What is in a page (DisplayLevel::page) that a part of that source and origin has named. Blocks; calls wait for
  /// each other. Throws roam::Error when it is absent or unreadable, and roam::Cancelled.
  [[nodiscard]] DisplayPart read(std::uint32_t source, const Vec3& origin, const std::string& page);

  /// From any thread: ends what is being read, and every reading after it.
  void cancel() { cancelled_ = true; }

 private:
  struct Reader;
  Reader& reader_of(std::uint32_t source, const Vec3& origin);

  std::vector<std::filesystem::path> paths_;
  ImportOptions options_;
  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;
  std::list<Reader> readers_;  ///< that used last first
};

}  // namespace roam
