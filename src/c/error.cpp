#include "c/error.h"

#include <sys/stat.h>

#include <cerrno>
#include <stdexcept>

#include "text/web_address.h"

namespace roam::c {
namespace {

thread_local std::string text;  ///< of the last failure
thread_local const char* shown = "";
constexpr const char* no_memory = "the machine has too little free memory";

roam_status failed(roam_status status, const char* why) noexcept {
  try {
    text = without_secrets(why);
    shown = text.c_str();
    return status;
  } catch (...) {
    shown = no_memory;
    return ROAM_NO_MEMORY;
  }
}

/// Allocates nothing: memory may have run out.
bool is_missing(const char* path) noexcept {
  if (scheme_size(path) > 0) return false;
  struct stat facts {};
  return ::stat(path, &facts) != 0 && (errno == ENOENT || errno == ENOTDIR);
}

}  // namespace

roam_status caught(const char* path) noexcept {
  try {
    throw;
  } catch (const Invalid& error) {
    return failed(ROAM_INVALID, error.what());
  } catch (const Error& error) {
    if (path == nullptr) return failed(ROAM_INVALID, error.what());
    return failed(is_missing(path) ? ROAM_NOT_FOUND : ROAM_UNREADABLE, error.what());
  } catch (const Cancelled& cancelled) {
    return failed(ROAM_CANCELLED, cancelled.what());
  } catch (const std::bad_alloc&) {
    return failed(ROAM_NO_MEMORY, no_memory);
  } catch (const std::length_error&) {
    return failed(ROAM_NO_MEMORY, no_memory);
  } catch (const std::exception& error) {
    return failed(ROAM_FAILED, error.what());
  } catch (...) {
    return failed(ROAM_FAILED, "an unknown error");
  }
}

}  // namespace roam::c

const char* roam_error(void) { return roam::c::shown; }
