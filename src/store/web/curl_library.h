#pragma once
/// \file
/// libcurl, loaded when a store is first read from a web server.

#define CURL_DISABLE_TYPECHECK
#include <curl/curl.h>

namespace roam::web {

/// Functions of libcurl, without "curl_" in their names.
class Curl {
 public:
  /// Loads the library at the first call. Throws roam::Error if it is not installed, or too old.
  [[nodiscard]] static const Curl& library();

 private:
  Curl();
  template <class Function>
  Function* find(const char* name);

  void* library_ = nullptr;

 public:
#define ROAM_CURL(name) decltype(::curl_##name)* const name = find<decltype(::curl_##name)>("curl_" #name)
  ROAM_CURL(global_init);
  ROAM_CURL(version_info);
  ROAM_CURL(slist_append);
  ROAM_CURL(slist_free_all);
  ROAM_CURL(easy_init);
  ROAM_CURL(easy_cleanup);
  ROAM_CURL(easy_reset);
  ROAM_CURL(easy_setopt);
  ROAM_CURL(easy_getinfo);
  ROAM_CURL(multi_init);
  ROAM_CURL(multi_cleanup);
  ROAM_CURL(multi_setopt);
  ROAM_CURL(multi_add_handle);
  ROAM_CURL(multi_remove_handle);
  ROAM_CURL(multi_perform);
  ROAM_CURL(multi_info_read);
  ROAM_CURL(multi_poll);
  ROAM_CURL(multi_wakeup);
#undef ROAM_CURL
};

}  // namespace roam::web
