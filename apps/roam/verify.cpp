// roam verify: checks every byte of a store.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/exit_status.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/tell.h"
#include "cli/values.h"
#include "roam/error.h"
#include "roam/store.h"
#include "roam/store_build.h"
#include "scenes/beside_scene.h"
#include "scenes/user_key.h"
#include "scenes/web_options.h"
#include "store/files.h"
#include "store/held.h"
#include "verbs.h"
#include "words/measures.h"

namespace roam::app {
namespace {

struct VerifyOptions {
  std::filesystem::path store;
  WebAccess web;
  std::vector<std::filesystem::path> scene;  ///< to repair the store from; empty: no repair
  std::vector<std::filesystem::path> allow;  ///< ImportOptions::allow of the scene
  std::optional<std::uint64_t> memory;       ///< bytes, for the repair
  int threads = 0;
  bool json = false;
};

/// Whether the store was built with your key.
struct Origin {
  bool yours = false;
  std::string why_not;  ///< a clause
};

using Open = std::function<std::shared_ptr<const Store>()>;

Origin origin_of(const Open& open) {
  const UserKey user = user_key();
  if (!user.key) return {false, std::string("no key of yours can be used: ") + user.problem.what()};
  try {
    if (open()->is_authentic(*user.key)) return {true, ""};
  } catch (const Error&) {  // damage is already reported
  }
  return {false, "it was not built with your key"};
}

/// Maximum lines of damage in text; JSON has all.
constexpr std::size_t most_lines = 20;

Json json_report(const VerifyOptions& options, const StoreVerification& found, const Origin& origin,
                 std::uint64_t repaired) {
  Json damage = Json::array();
  for (const StoreDamage& d : found.damage) {
    damage.push_back({{"what", d.what}, {"why", d.why}, {"where", nullptr}});
    if (!d.where.empty()) damage.back()["where"] = to_json(d.where);
  }
  return {{"store", options.store.string()}, {"bytes", found.bytes},       {"tiles", found.tiles},
          {"whole", found.whole()},          {"complete", found.complete}, {"damage", damage},
          {"shards_repaired", repaired},     {"yours", origin.yours}};
}

/// The damage, one item a line, and its amount.
std::string damage_text(const VerifyOptions& options, const StoreVerification& found) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most_lines, found.damage.size()); ++i) {
    text += fmt::format("{}: {}\n", printable_part(found.damage[i].what), printable_part(found.damage[i].why));
  }
  if (found.damage.size() > most_lines) {
    text += fmt::format("... and {} more (--json tells all)\n", found.damage.size() - most_lines);
  }
  return text + fmt::format("{}: {} {} damaged\n", printable_part(options.store.string()),
                            words::counted(found.damage.size(), "thing"), found.damage.size() == 1 ? "is" : "are");
}

std::string text_report(const VerifyOptions& options, const StoreVerification& found, const Origin& origin) {
  const std::string store = printable_part(options.store.string());
  if (!found.complete) {
    return fmt::format(
        "{0}: not complete: its build has not ended; `roam build` with its scene, and `-o {0}`, goes on "
        "where it stopped\n",
        store);
  }
  if (found.damage.empty()) {
    return fmt::format("{}: whole; {}B and {} are as they were written{}\n", store,
                       short_count(static_cast<double>(found.bytes)), words::counted(found.tiles, "tile"),
                       origin.yours ? " by you" : "; by whom is not known: " + printable_part(origin.why_not));
  }
  const std::string text = damage_text(options, found);
  if (Store::is_address(options.store.native())) {
    if (found.damage.front().what == store::current_file) {
      return text + "does a web server answer at this address without a store, such as one that wants a login?\n";
    }
    return text +
           "tiles that are damaged are solid; `roam verify` the published folder, remove its damaged files, and "
           "publish "
           "again\n";
  }
  return text +
         fmt::format("tiles that are damaged are solid; `roam verify {} --repair SCENE` mends the store\n", store);
}

/// For the manifest, bytes.
std::uint64_t memory_of(const VerifyOptions& options) {
  return std::max(Store::usual_memory, options.memory.value_or(0));
}

/// `folder`: the store's; none: it is on a web server.
StoreVerification look(const VerifyOptions& options, const std::optional<store::Folder>& folder) {
  Progress progress("verifying " + options.store.string(), "B");
  const auto goes_on = [&](std::uint64_t done, std::uint64_t total) { return progress.goes_on(done, total); };
  return folder ? store::verify_store(*folder, goes_on, memory_of(options))
                : verify_store(options.store, goes_on, options.web);
}

std::uint64_t repair(const VerifyOptions& options) {
  StoreBuildOptions build;
  build.scene = options.scene;
  build.output = options.store;
  build.import.allow = options.allow;
  build.memory = options.memory.value_or(build.memory);
  build.threads = options.threads;
  build.key = user_key().key.value_or(key_of_this_run());
  StoreBuildReport report;
  {
    Progress progress("repairing " + options.store.string(), "triangles");
    build.progress = [&](const StoreBuildProgress& p) {
      return progress.goes_on(p.triangles_done, std::max(p.triangles_done, p.triangles_total));
    };
    report = repair_store(build);
  }
  for (const std::string& note : notes_as_sentences(report, options.store)) tell("note: " + note);
  return report.shards_built;
}

ExitStatus verify_or_repair(const VerifyOptions& options) {
  demand_memory_of_build(options.memory);
  std::optional<store::Folder> folder;
  if (!Store::is_address(options.store.native())) {
    folder = store::hold_store(options.store);
  } else if (!options.scene.empty()) {
    throw UsageError("--repair", "a store on a web server is repaired where it is made, and published again");
  }
  StoreVerification found = look(options, folder);
  std::uint64_t repaired = 0;
  if (!found.whole() && !options.scene.empty()) {
    if (!options.json && !found.damage.empty()) print(damage_text(options, found));
    repaired = repair(options);
    found = look(options, folder);
  }
  const Origin origin = origin_of([&] {
    return folder ? store::open_store(*folder, memory_of(options))
                  : Store::open(options.store, Store::usual_memory, options.web);
  });
  if (options.json) {
    print(json_report(options, found, origin, repaired));
  } else {
    print(text_report(options, found, origin));
  }
  return found.whole() ? done : answer_no;
}

constexpr const char* verify_help =
    R"(Verifying reads every byte of a store: the hash of each file, the checksum of each tile and page. It
decodes every tile, and compares counts, boxes and the hash of all triangles. Damage is named by tile and place. The
store is solid there; everywhere else you can walk in it.

--repair builds only the damaged shards again, from the scene that the store was made of. The store knows its --up,
--unit, --ignore and --lossless; --allow must be given again, and --memory if the build took more than 1 GiB. The report
also says whether you built the store or somebody else.

Exit status 0 if the store is whole, 3 if it is not, or if its build is not finished; 1 if that cannot be found out,
such as when the network fails.

Examples:
  roam verify dam.roam
  roam verify dam.roam --repair Data/
  roam verify dam.roam --json
)";

}  // namespace

void add_verify(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("verify", "Check whether a store is whole, and repair it");
  verb->footer(verify_help);
  const auto options = std::make_shared<VerifyOptions>();
  VerifyOptions& o = *options;
  add_web_options(*verb,
                  *verb->add_option("STORE", o.store, "The store's folder, or its address")->required()->type_name(""),
                  o.web);
  verb->option_defaults()->group("Options");
  CLI::Option* repair =
      verb->add_option("--repair", o.scene, "Build damaged parts again from this scene, which the store was made of")
          ->type_name("SCENE");
  verb->add_option("--allow", o.allow,
                   "A folder that the store was built with (--allow), for the repair; may be repeated")
      ->type_name("DIR")
      ->expected(1)
      ->take_all()
      ->needs(repair);
  verb->add_option("--memory", o.memory, "Memory for the repair and its reader (default: 1G; at least 256M)")
      ->transform(bytes())
      ->type_name("SIZE")
      ->needs(repair);
  verb->add_option("--threads", o.threads, "Threads for the repair (default: one per core)")
      ->check(thread_count())
      ->type_name("N");
  verb->add_flag("--json", o.json, "Print one JSON object");
  verb->callback([options, &run] { run = [options] { return verify_or_repair(*options); }; });
}

}  // namespace roam::app
