// roam verify: is every byte of a store what was written?
#include <fmt/format.h>

#include "cli/exit_status.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/tell.h"
#include "roam/error.h"
#include "roam/store.h"
#include "roam/store_build.h"
#include "scenes/beside_scene.h"
#include "scenes/user_key.h"
#include "verbs.h"

namespace roam::app {
namespace {

struct VerifyOptions {
  std::filesystem::path store;
  std::vector<std::filesystem::path> scene;  ///< to repair it from; empty: it is not repaired
  int threads = 0;
  bool json = false;
};

/// What is known of who built the store.
struct Origin {
  bool yours = false;
  std::string why_not;  ///< a clause
};

Origin origin_of(const std::filesystem::path& store) {
  const UserKey user = user_key();
  if (!user.key) return {false, "no key of yours can be used: " + user.problem};
  try {
    if (Store::open(store)->is_authentic(*user.key)) return {true, ""};
  } catch (const Error&) {  // what is damaged was told
  }
  return {false, "it was not built with your key"};
}

/// Lines of damage that are told in text; JSON tells all.
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

std::string text_report(const VerifyOptions& options, const StoreVerification& found, const Origin& origin) {
  const std::string store = printable_part(options.store.string());
  if (!found.complete) {
    return fmt::format(
        "{0}: not complete: its build has not ended; `roam build` with its scene, and `-o {0}`, goes on "
        "where it stopped\n",
        store);
  }
  std::string text;
  for (std::size_t i = 0; i < std::min(most_lines, found.damage.size()); ++i) {
    text += fmt::format("{}: {}\n", printable_part(found.damage[i].what), printable_part(found.damage[i].why));
  }
  if (found.damage.size() > most_lines) {
    text += fmt::format("... and {} more (--json tells all)\n", found.damage.size() - most_lines);
  }
  if (found.damage.empty()) {
    return fmt::format("{}: whole; {}B and {} tiles are what was written{}\n", store,
                       short_count(static_cast<double>(found.bytes)), found.tiles,
                       origin.yours ? " by you" : "; by whom is not known: " + printable_part(origin.why_not));
  }
  return text +
         fmt::format("{0}: {1} damaged; tiles that are, are solid; `roam verify {0} --repair SCENE` mends it\n", store,
                     found.damage.size() == 1 ? "1 thing is" : fmt::format("{} things are", found.damage.size()));
}

StoreVerification look(const VerifyOptions& options) {
  Progress progress("verifying " + options.store.string(), "B");
  return verify_store(options.store,
                      [&](std::uint64_t done, std::uint64_t total) { return progress.goes_on(done, total); });
}

std::uint64_t repair(const VerifyOptions& options) {
  StoreBuildOptions build;
  build.scene = options.scene;
  build.output = options.store;
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
  StoreVerification found = look(options);
  std::uint64_t repaired = 0;
  if (!found.whole() && !options.scene.empty()) {
    if (!options.json) print(text_report(options, found, {}));
    repaired = repair(options);
    found = look(options);
  }
  const Origin origin = origin_of(options.store);
  if (options.json) {
    print(json_report(options, found, origin, repaired));
  } else {
    print(text_report(options, found, origin));
  }
  return found.whole() ? done : answer_no;
}

constexpr const char* help =
    "Reads every byte of a store: the hash of every file, the checksum of every tile and page; decodes every tile, "
    "and\n"
    "compares counts, boxes and the hash of all triangles. What is damaged is named by tile and place: there the "
    "store\n"
    "is solid, everywhere else it can be walked. With --repair just the shards with damage are built again, from the\n"
    "scene that the store was made of, read as it was then: the store knows --up, --unit, --ignore and --lossless.\n"
    "A store that is whole is what was written, by you or by somebody else: it says which.\n"
    "Exit status 0 when the store is whole, 3 when not, or when its build has not ended.\n\n"
    "Examples:\n"
    "  roam verify dam.roam\n"
    "  roam verify dam.roam --repair Data/\n"
    "  roam verify dam.roam --json\n";

}  // namespace

void add_verify(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("verify", "Says whether a store is whole, and repairs it");
  verb->footer(help);
  const auto options = std::make_shared<VerifyOptions>();
  VerifyOptions& o = *options;
  verb->add_option("STORE", o.store, "The store's folder")->required()->type_name("");
  verb->add_option("--repair", o.scene, "The scene that the store was made of: build what is damaged again")
      ->type_name("SCENE...");
  verb->add_option("--threads", o.threads, "Threads to build with (default: all cores)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  verb->add_flag("--json", o.json, "Print one JSON object");
  verb->callback([options, &run] { run = [options] { return verify_or_repair(*options); }; });
}

}  // namespace roam::app
