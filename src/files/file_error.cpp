#include "files/file_error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

namespace roam::files {
namespace {

/// Advice for people.
const char* advice(int error, bool reading) {
  if (reading && (error == EACCES || error == EPERM)) return "give yourself the right to read it";
  if (!reading && (error == ENOENT || error == ENOTDIR)) return "make its folder first or choose another place";
  switch (error) {
    case EISDIR:
      return "name a file";
    case EFBIG:
      return reading ? "is it the right file?" : "";
    case ENOENT:
      return "check its name";
    case ENOSPC:
    case EDQUOT:
      return "make room there or choose another place";
    case EACCES:
    case EPERM:
      return "give yourself the right to write there or choose another place";
    case EROFS:
      return "the file system can only be read; choose another place";
    case EIO:
      return "the disk or the network does not work; see the system's log";
    case EMFILE:
    case ENFILE:
      return "too many files are open; raise the limit (ulimit -n)";
    default:
      return "";
  }
}

}  // namespace

void fail(const char* what, const std::filesystem::path& file, int error) {
  const std::string advised = advice(error, std::strcmp(what, "read") == 0);
  throw FileError(Error::at(file.string(), fmt::format("cannot {} {}: {}{}{}", what, file.string(),
                                                       std::strerror(error), advised.empty() ? "" : "; ", advised)),
                  error);
}

}  // namespace roam::files
