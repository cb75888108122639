#include "files/unnamed_file.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "roam/error.h"

namespace roam::files {
namespace {

Descriptor open_one() {
  const std::string folder = temporary_folder();
#ifdef O_TMPFILE
  Descriptor file(::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
  if (file.is_open()) return file;
#endif
  std::string name = folder + "/roam-XXXXXX";
  Descriptor named(::mkostemp(name.data(), O_CLOEXEC));
  if (named.is_open()) ::unlink(name.c_str());
  return named;
}

/// Advice for people.
const char* advice(int reason) {
  switch (reason) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "Free some space, or name a folder that has some";
    case ENOENT:
    case ENOTDIR:
      return "Make that folder, or name another";
    case EACCES:
    case EPERM:
    case EROFS:
      return "Name a folder that you may write to";
    default:
      return "Name another folder";
  }
}

Error refused(const std::string& what, const char* verb, int reason) {
  return Error(temporary_folder(),
               fmt::format("{} cannot be {} there: {}. {} by the environment variable TMPDIR, or allow more memory.",
                           what, verb, std::strerror(reason), advice(reason)));
}

}  // namespace

UnnamedFile::UnnamedFile(std::string what) : what_(std::move(what)), file_(open_one()), why_none_(errno) {}

void UnnamedFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
  if (!file_.is_open()) throw refused(what_, "kept", why_none_);
  if (write_fully(file_.number(), offset, bytes) < bytes.size()) throw refused(what_, "kept", errno);
}

void UnnamedFile::read_at(std::uint64_t offset, std::span<std::byte> bytes) const {
  if (read_fully(file_.number(), offset, bytes) < bytes.size()) throw refused(what_, "read", errno);
}

}  // namespace roam::files
