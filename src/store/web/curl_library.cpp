#include "store/web/curl_library.h"

#include <dlfcn.h>

#include <string>

#include "roam/error.h"

namespace roam::web {

const Curl& Curl::library() {
  // Never unloaded: libraries that it brings have threads and hooks at the end of the process.
  static const Curl* const loaded = new Curl;
  return *loaded;
}

template <class Function>
Function* Curl::find(const char* name) {
  for (const char* file : {"libcurl.so.4", "libcurl-gnutls.so.4"}) {
    if (library_ == nullptr) library_ = ::dlopen(file, RTLD_NOW | RTLD_LOCAL);
  }
  void* const found = library_ == nullptr ? nullptr : ::dlsym(library_, name);
  if (found == nullptr) {
    throw Error(
        "stores on web servers are read with libcurl 7.85 or later, which is not here; install it (Debian: "
        "libcurl4), or copy the store");
  }
  return reinterpret_cast<Function*>(found);
}

Curl::Curl() {
  const curl_version_info_data& version = *version_info(CURLVERSION_NOW);
  if (version.version_num < 0x075500) {
    throw Error(std::string("stores on web servers are read with libcurl 7.85 or later, and this is ") +
                version.version + "; install a later one, or copy the store");
  }
  if (global_init(CURL_GLOBAL_DEFAULT) != CURLE_OK) throw Error("libcurl cannot be started; copy the store");
}

}  // namespace roam::web
