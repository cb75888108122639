#include "c/error.h"

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "text/web_address.h"

namespace roam::c {
namespace {

thread_local std::string text;  ///< of the last failure
thread_local const char* shown = "";

roam_status failed(roam_status status, const char* why) noexcept {
  try {
    text = without_secrets(why);
    shown = text.c_str();
  } catch (...) {
    shown = "the machine has too little free memory";
  }
  return status;
}

bool is_missing(const char* path) {
  if (scheme_size(path) > 0) return false;
  std::error_code none;
  const auto status = std::filesystem::status(path, none);
  return status.type() == std::filesystem::file_type::not_found;
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
    return failed(ROAM_NO_MEMORY, "the machine has too little free memory");
  } catch (const std::length_error&) {
    return failed(ROAM_NO_MEMORY, "the machine has too little free memory");
  } catch (const std::exception& error) {
    return failed(ROAM_FAILED, error.what());
  } catch (...) {
    return failed(ROAM_FAILED, "an unknown error");
  }
}

}  // namespace roam::c

const char* roam_error(void) { return roam::c::shown; }
