#include "scenes/web_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/help.h"
#include "cli/tell.h"
#include "cli/user_folder.h"
#include "cli/values.h"
#include "roam/error.h"
#include "store/web/disk_cache.h"

namespace roam::app {
namespace {

/// Without a cache, all is as it is with one, but slower.
void drop_unusable_cache(WebAccess& web) {
  if (web.cache.empty() || web.cache_bytes < web::DiskCache::least_bytes) return;
  try {
    static_cast<void>(web::DiskCache(web.cache, web.cache_bytes));
  } catch (const Error& error) {
    tell(std::string("note: nothing is kept for the next time: ") + error.what());
    web.cache.clear();
  }
}

}  // namespace

void take_query_of(CLI::Option& store, WebAccess& web) {
  store.transform(CLI::Validator(
      [&web](std::string& text) {
        const std::size_t question = Store::is_address(text) ? text.find('?') : std::string::npos;
        if (question == std::string::npos) return std::string();
        web.query = text.substr(question + 1);
        text.resize(question);
        return std::string();
      },
      ""));
}

void add_web_options(CLI::App& verb, CLI::Option& store, WebAccess& web) {
  take_query_of(store, web);
  verb.option_defaults()->group(scene_group);
  verb.add_option_function<std::uint64_t>(
          "--cache",
          [&web](const std::uint64_t& size) {
            const std::filesystem::path folder = user_folder("XDG_CACHE_HOME", ".cache");
            if (folder.empty()) throw CLI::ValidationError("--cache", "there is no folder for it: set XDG_CACHE_HOME");
            web.cache = folder / "web.cache";
            web.cache_bytes = size;
          },
          "Keep what is read in a file of this size in ~/.cache/roam, for the next time, e.g. 2G")
      ->transform(bytes())
      ->type_name("SIZE");
  verb.add_flag("--redirects", web.redirects, "Follow the server's redirects to other hosts and folders");
  verb.option_defaults()->group(other_group);
  verb.parse_complete_callback([&verb, &store, &web] {
    std::vector<std::string> names = store.results();
    if (const CLI::Option* const other = verb.get_option_no_throw("--store")) {
      const std::vector<std::string> more = other->results();
      names.insert(names.end(), more.begin(), more.end());
    }
    if (std::any_of(names.begin(), names.end(), &Store::is_address)) drop_unusable_cache(web);
  });
}

}  // namespace roam::app
