// roam publish: copies a store to where a web server serves it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "cli/exit_status.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/standard_streams.h"
#include "cli/tell.h"
#include "roam/error.h"
#include "roam/store_build.h"
#include "scenes/web_options.h"
#include "verbs.h"
#include "words/measures.h"

namespace roam::app {
namespace {

struct PublishOptions {
  std::filesystem::path store, folder;
  WebAccess web;
  bool nginx = false, json = false;
};

/// Lines for the `server` of nginx. Only a store's own files are served. All but CURRENT never change.
constexpr const char* nginx_lines =
    R"(location ~ "^/{0}/(?<roam_file>CURRENT|(packs|parts|manifests)/[0-9a-f]{{64}}[.](pack|part|json))$" {{
  alias "{1}/$roam_file";
  disable_symlinks on from="{1}";
  default_type application/octet-stream;
  gzip off;
  max_ranges 1;
  limit_except GET OPTIONS {{ deny all; }}
  set $roam_lasts "public, max-age=31536000, immutable";
  if ($roam_file = CURRENT) {{ set $roam_lasts "no-cache"; }}
  if ($request_method = OPTIONS) {{ return 204; }}
  add_header Cache-Control $roam_lasts;
  add_header Access-Control-Allow-Origin * always;
  add_header Access-Control-Allow-Methods "GET, OPTIONS" always;
  add_header Access-Control-Allow-Headers "Range, Cache-Control" always;
  add_header Access-Control-Expose-Headers "Content-Range, Content-Length, ETag" always;
  add_header Access-Control-Max-Age 86400 always;
}}
)";

/// The folder, complete, and its last name.
std::pair<std::string, std::string> names_of(const std::filesystem::path& folder) {
  std::filesystem::path whole = std::filesystem::absolute(folder).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  return {whole.string(), whole.filename().string()};
}

std::string nginx_text(const std::filesystem::path& folder) {
  const auto [whole, name] = names_of(folder);
  std::string pattern;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
    pattern += plain ? std::string(1, c) : fmt::format("[{}]", c);
  }
  return fmt::format(nginx_lines, pattern, whole);
}

/// Names with other characters would mean something else in nginx's file.
void demand_plain_name(const std::filesystem::path& folder) {
  const auto [whole, name] = names_of(folder);
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.' || c == '/' || c == '+';
  };
  if (!name.empty() && std::all_of(whole.begin(), whole.end(), is_plain)) return;
  throw UsageError("--nginx", fmt::format("{} has other characters than letters, digits and . _ - + /: serve it from "
                                          "a folder without",
                                          whole));
}

std::string text_report(const PublishOptions& options, const StorePublication& published) {
  const std::string store = printable_part(options.store.string()), folder = printable_part(options.folder.string());
  if (published.unchanged) return fmt::format("{}: {} is published there already\n", folder, store);
  return fmt::format("{}: {} is published: {} copied, {}B; {} there already\n", folder, store,
                     words::counted(published.files, "file"), short_count(static_cast<double>(published.bytes)),
                     words::grouped(published.present));
}

ExitStatus publish(const PublishOptions& options) {
  demand_no_address("DIR", options.folder);
  if (options.folder.empty()) throw UsageError("DIR", "a folder needs a name");
  if (options.nginx) demand_plain_name(options.folder);
  StorePublication published;
  {
    Progress progress("publishing " + options.store.string(), "B");
    published = publish_store(
        options.store, options.folder,
        [&](std::uint64_t bytes, std::uint64_t total) { return progress.goes_on(bytes, total); }, options.web);
  }
  if (options.json) {
    print(Json{{"store", options.store.string()},
               {"folder", options.folder.string()},
               {"hash", published.hash},
               {"unchanged", published.unchanged},
               {"files", published.files},
               {"bytes", published.bytes},
               {"present", published.present}});
  } else {
    print(options.nginx ? nginx_text(options.folder) : text_report(options, published));
  }
  return done;
}

constexpr const char* publish_help =
    R"(Publishing copies a store into DIR, from which a web server serves it. Each file that it copies is
compared with its SHA-256 and renamed into place, CURRENT last: readers see the old store or the new one. A file
that is there with its size stays, also if `roam verify` calls it damaged: remove it before. Files of the version
before stay, for those who walk in it; older ones are removed. Publish every version with the same command.

Any web server that serves ranges will do. --nginx prints lines for nginx, with CORS for web pages.

Examples:
  roam publish dam.roam /srv/www/dam.roam
  roam publish dam.roam /srv/www/dam.roam --nginx > dam.conf
  roam publish https://example.org/dam.roam mirror/dam.roam
)";

}  // namespace

void add_publish(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("publish", "Copy a store to where a web server serves it");
  verb->footer(publish_help);
  const auto options = std::make_shared<PublishOptions>();
  PublishOptions& o = *options;
  CLI::Option* store =
      verb->add_option("STORE", o.store, "The store's folder, or its address")->required()->type_name("");
  verb->add_option("DIR", o.folder, "The folder to be served")->required()->type_name("");
  verb->option_defaults()->group("Options");
  CLI::Option* nginx = verb->add_flag("--nginx", o.nginx, "Print lines for the server { } of nginx");
  verb->add_flag("--json", o.json, "Print one JSON object")->excludes(nginx);
  add_web_options(*verb, *store, o.web);
  verb->callback([options, &run] {
    if (is_standard(options->folder)) throw UsageError("publish -", "a store is a folder: name one");
    run = [options] { return publish(*options); };
  });
}

}  // namespace roam::app
