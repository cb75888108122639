// roam check: checks the certificate of a walk against every triangle of its scene.
#include "check/check.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/exit_status.h"
#include "cli/help.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/standard_streams.h"
#include "cli/tell.h"
#include "cli/values.h"
#include "roam/error.h"
#include "roam/store.h"
#include "scenes/frame.h"
#include "scenes/scene_options.h"
#include "text/byte_order_mark.h"
#include "verbs.h"
#include "words/lines.h"
#include "words/measures.h"

namespace roam::app {
namespace {

struct CheckOptions {
  std::filesystem::path certificate;
  SceneOptions scene;
  std::optional<double> radius, height;  ///< the body may not be smaller
  bool json = false;
};

/// Maximum bytes of a certificate: more than 5 million segments take.
constexpr std::uint64_t limit = 1ull << 30;

double height_of(const checking::Size& size) { return 2.0 * (size.radius + size.half_height); }

/// The facts that an accepted certificate proves.
struct Claim {
  double length = 0.0, least_gap = 0.0;  ///< m

  explicit Claim(const checking::Certificate& certificate) {
    least_gap = certificate.segments.front().clearance - certificate.segments.front().size.radius;
    for (const checking::Segment& s : certificate.segments) {
      length += glm::distance(s.from, s.to);
      least_gap = std::min(least_gap, s.clearance - s.size.radius);
    }
  }
};

/// The result, with the certificate as far as it could be read.
struct Result {
  std::optional<checking::Certificate> certificate;
  std::optional<checking::Refused> refused;

  /// "segment 17, from (...) to (...): ".
  [[nodiscard]] std::string place() const {
    if (refused->segment == 0) return "";
    if (!certificate || refused->segment > certificate->segments.size()) {
      return fmt::format("segment {}: ", refused->segment);
    }
    const checking::Segment& s = certificate->segments[refused->segment - 1];
    return fmt::format("segment {}, from {} to {}: ", refused->segment, words::exactly_at(s.from),
                       words::exactly_at(s.to));
  }
};

/// Refuses a body that is smaller than the options say.
void demand_size(const CheckOptions& options, const checking::Certificate& certificate) {
  std::uint64_t number = 0;
  for (const checking::Segment& s : certificate.segments) {
    ++number;
    const double radius = options.radius.value_or(0.0), height = options.height.value_or(0.0);
    if (s.size.radius < radius) {
      throw checking::Refused(fmt::format("the body's radius is {} m, below --radius {}", s.size.radius, radius),
                              number);
    }
    // A capsule's height is stored as two numbers.
    if (height_of(s.size) < height - 1e-9) {
      throw checking::Refused(fmt::format("the body is {:.9g} m high, below --height {}", height_of(s.size), height),
                              number);
    }
  }
}

/// The remedy for a text that is not as it was written.
const char* remedy(std::string_view text) {
  if (text.find('\r') != std::string_view::npos) return "its lines end with CR LF: let them end with LF alone";
  if (const std::size_t end = text.find('\n'); end != text.npos && text.substr(0, end) != checking::first_line)
    return "check it by the roam that wrote it";
  if (text.ends_with("\n\n")) return "an empty line was added at its end: remove it";
  return "it is damaged or cut short: copy it again";
}

checking::Certificate certificate_in(const std::filesystem::path& file) {
  const std::string bytes = read_input(file, limit);
  if (is_utf16(bytes)) throw Error(file.string(), "this is UTF-16 text; save it as UTF-8");
  const std::string_view text = without_byte_order_mark(bytes);
  if (text.empty()) throw Error(file.string(), "this file is empty; write it by `roam walk --certify`");
  if (!text.starts_with("roam certificate ")) {
    throw Error(file.string(), "this is no certificate of `roam walk --certify`; name it before SCENE");
  }
  try {
    return checking::read_certificate(text);
  } catch (const std::invalid_argument& damaged) {
    throw Error(file.string(), fmt::format("{}; {}", damaged.what(), remedy(text)));
  }
}

/// Checks every triangle while the scene is read.
void check_scene(const SceneOptions& scene, checking::Checker& checker) {
  ImportReport report;
  {
    Progress progress("checking against " + scene.names(), "B");
    ImportOptions reading = scene.import_options();
    reading.progress = [&](const ImportProgress& p) { return progress.goes_on(p.bytes_read, p.bytes_total); };
    report = stream_scene(scene.scenes, reading, [&](const Mesh& piece, bool) {
      for (std::size_t i = 0; i < piece.triangles.size(); ++i) {
        stop_if_interrupted();
        checker.add(piece.triangle(i));
      }
    });
  }
  for (const std::string& note : report.notes) tell("note: " + note);
}

/// The sizes of the body on its way, without those that only the head names.
std::vector<checking::Size> sizes_of(const checking::Certificate& certificate) {
  std::vector<checking::Size> sizes;
  for (const checking::Segment& s : certificate.segments) {
    if (std::find(sizes.begin(), sizes.end(), s.size) == sizes.end()) sizes.push_back(s.size);
  }
  return sizes;
}

Json json_report(const CheckOptions& options, const Result& result) {
  Json json = {{"certificate", options.certificate.string()},
               {"scene", options.scene.names()},
               {"frame", to_json(frame_of(options.scene))},
               {"accepted", !result.refused},
               {"why", result.refused ? Json(result.refused->what()) : Json(nullptr)},
               {"segment", nullptr},
               {"segments", nullptr}};
  if (result.refused && result.refused->segment > 0) json["segment"] = result.refused->segment;
  if (!result.certificate) return json;
  const checking::Certificate& certificate = *result.certificate;
  const Claim claim(certificate);
  Json sizes = Json::array();
  for (const checking::Size& size : sizes_of(certificate)) {
    sizes.push_back({{"radius", size.radius}, {"height", height_of(size)}});
  }
  json["segments"] = certificate.segments.size();
  json["triangles"] = certificate.scene.triangles;
  json["sizes"] = sizes;
  json["from"] = to_json(certificate.segments.front().from);
  json["to"] = to_json(certificate.segments.back().to);
  json["length_m"] = claim.length;
  json["least_gap_m"] = claim.least_gap;
  return json;
}

std::string text_report(const CheckOptions& options, const Result& result) {
  const std::string name = printable_part(options.certificate.string());
  if (result.refused) return words::Lines("REFUSED: " + name + ": " + result.place() + result.refused->what()).text();
  const checking::Certificate& certificate = *result.certificate;
  const Claim claim(certificate);
  words::Lines lines(fmt::format("ACCEPTED: {}: its {} away from all {} triangles", name,
                                 certificate.segments.size() == 1
                                     ? std::string("1 segment keeps")
                                     : words::grouped(certificate.segments.size()) + " segments keep",
                                 words::grouped(certificate.scene.triangles)));
  lines.add("way", fmt::format("{:.2f} m without a break, from {} to {}", claim.length,
                               words::exactly_at(certificate.segments.front().from),
                               words::exactly_at(certificate.segments.back().to)));
  std::string sizes;
  for (const checking::Size& size : sizes_of(certificate)) {
    sizes += (sizes.empty() ? "" : "; ") + words::size_of(size.radius, height_of(size));
  }
  lines.add("body", sizes);
  constexpr double shortest_printed = 0.5e-4;  // m; a shorter length is printed as 0.0 mm
  lines.add("nearest", claim.least_gap < shortest_printed
                           ? std::string("it may touch something, by 0.001 mm at most")
                           : fmt::format("at least {} from everything", words::metres(claim.least_gap)));
  return lines.text();
}

ExitStatus check_certificate(CheckOptions options) {
  options.scene.check_files_there("it keeps triangles to within 2 mm only; name its scene");
  take_kept_frame(options.scene);
  Result result;
  try {
    result.certificate = certificate_in(options.certificate);
    demand_size(options, *result.certificate);
    checking::Checker checker(*result.certificate);
    check_scene(options.scene, checker);
    checker.finish();
  } catch (const checking::Refused& refused) {
    result.refused = refused;
  }
  print_report(options.json, json_report(options, result),
               text_report(options, result) + kept_frame_line(options.scene));
  return result.refused ? answer_no : done;
}

constexpr const char* check_help =
    R"(A certificate lists the straight segments of a walk: `roam walk --certify FILE` writes it. `roam check`
proves each segment again, against every triangle of the scene. It shares no code with the program that walked: only
the scene is read in the same way. The proof is short enough to be read (src/check), and docs/format.md describes the
file, so that you can write another one.

An accepted certificate proves that the body went from its first place to its last without a break, and never nearer to
a triangle than its radius minus 0.001 mm. Compare body, first and last place with those that you expect: whoever
changes them, and the checksum, has the certificate of another walk. A refusal names the first wrong segment.

The scene must have the same triangles and the same frame (--up, --unit, --ignore). For a walk in a store, name the
scene that the store was built from.

Exit status 0 if the certificate is accepted, 3 if it is refused; 1 if the file is damaged, which says nothing about
the walk.

Examples:
  roam check tour.certificate mine.dae
  roam check tour.certificate mine.dae --radius 0.3 --height 1.1 --json
)";

}  // namespace

void add_check(CLI::App& program, Run& run) {
  CLI::App* verb =
      program.add_subcommand("check", "Check the certificate of a walk against every triangle of its scene");
  verb->footer(check_help);
  const auto options = std::make_shared<CheckOptions>();
  CheckOptions& o = *options;
  verb->add_option("FILE", o.certificate, "The certificate (-: standard input)")->required()->type_name("");
  verb->add_option("SCENE", o.scene.scenes, "The scene's files or folders, as they were walked in; no store")
      ->required()
      ->type_name("");
  verb->option_defaults()->group("Options");
  verb->add_option("--radius", o.radius, "Refuse a body of a smaller radius, in metres")
      ->check(positive())
      ->type_name("R");
  verb->add_option("--height", o.height, "Refuse a lower body, in metres; a person is 1.1 m high when crouched")
      ->check(positive())
      ->type_name("H");
  verb->add_flag("--json", o.json, "Print one JSON object");
  o.scene.add_files_to(*verb);
  verb->callback([options, &run] { run = [options] { return check_certificate(*options); }; });
}

}  // namespace roam::app
