// Surveys, probes, training and profiles.
#include "roam/survey.h"

#include <limits>

#include "c/meshes.h"
#include "c/progress.h"
#include "c/structs.h"
#include "c/walker.h"
#include "roam/probe.h"
#include "roam/train.h"

struct roam_survey {
  roam::Survey survey;
};
struct roam_profile {
  roam::Profile profile;
};
struct roam_path {
  std::vector<roam_vec3> points;
};

namespace roam::c {
namespace {

/// Of the meshes that a survey keeps, both worlds, and their construction.
constexpr std::size_t bytes_a_triangle = 120;

roam_survey* new_survey(std::vector<Mesh> meshes, const roam_world_options& options, Progress& progress) {
  BuildOptions how;
  how.threads = options.threads;
  how.lossless = true;
  how.progress = [&](double done) { return progress.goes_on(done); };
  Survey survey = Survey::build(std::move(meshes), how);
  return new roam_survey{std::move(survey)};
}

int32_t limit_of(const std::optional<ProbeLimit>& limit) {
  static_assert(ROAM_LIMIT_APART == static_cast<int>(ProbeLimit::Kind::apart) + 1);
  return limit ? static_cast<int32_t>(limit->kind) + 1 : static_cast<int32_t>(ROAM_LIMIT_NONE);
}

roam_probe_answer facts_of(const ProbeAnswer& answer) {
  roam_probe_answer facts{};
  facts.passable = answer.passable ? 1 : 0;
  facts.wide_enough = answer.wide_enough ? 1 : 0;
  facts.proven = answer.proven ? 1 : 0;
  facts.found = answer.passage.found ? 1 : 0;
  facts.limit = limit_of(answer.limit);
  const bool unlimited = answer.passage.found && !answer.passage.limited;
  facts.widest_radius = unlimited ? std::numeric_limits<double>::infinity() : answer.passage.radius;
  facts.length = answer.passage.length;
  if (answer.limit) {
    facts.limit_point = c_of(answer.limit->point);
    facts.limit_direction = c_of(answer.limit->direction);
    facts.limit_size = answer.limit->size;
    facts.limit_needed = answer.limit->needed;
  }
  return facts;
}

}  // namespace
}  // namespace roam::c

using namespace roam::c;

roam_status roam_survey_build(const roam_mesh* meshes, size_t count, const roam_world_options* options,
                              roam_survey** survey) {
  return guarded([&] {
    (void)needed(survey, "the address for the survey");
    const auto how = given_or_default(options, "roam_world_options");
    Progress progress(how.progress, how.progress_data);
    *survey = new_survey(copied(meshes, count, bytes_a_triangle), how, progress);
  });
}

roam_status roam_survey_open(const char* path, const roam_world_options* options, roam_survey** survey) {
  return guarded(path, [&] {
    (void)needed(survey, "the address for the survey");
    (void)needed(path, "the path");
    const auto how = given_or_default(options, "roam_world_options");
    Progress progress(how.progress, how.progress_data);
    std::vector<roam::Mesh> meshes = imported(path, how, progress);
    about_arguments([&] { *survey = new_survey(std::move(meshes), how, progress); });
  });
}

void roam_survey_free(roam_survey* survey) { delete survey; }

roam_status roam_probe(const roam_survey* survey, const roam_probe_options* options, roam_probe_answer* answer,
                       roam_path** way) {
  return guarded([&] {
    const roam::Survey& scene = needed(survey, "the survey").survey;
    const roam_probe_options what = given(options, "roam_probe_options");
    check_room(answer, "roam_probe_answer");
    Progress progress(what.progress, what.progress_data);
    roam::ProbeQuestion question;
    question.from = cpp_of(what.from);
    question.to = cpp_of(what.to);
    question.mode = mode_of(what.mode);
    if (what.step != 0.0) question.step = what.step < 0.0 ? 0.0 : what.step;
    if (what.spacing != 0.0) question.spacing = what.spacing;
    question.progress = [&](std::uint64_t) { return progress.goes_on(0.0); };
    const roam::ProbedSize size{what.radius, what.height != 0.0 ? what.height : 2.0 * what.radius};
    const roam::ProbeAnswer found = probe(scene, question, size);
    if (way != nullptr) {
      auto path = std::make_unique<roam_path>();
      for (const roam::Vec3& p : probed_path(scene, question, found)) path->points.push_back(c_of(p));
      *way = path.release();
    }
    put(*answer, facts_of(found));
  });
}

const roam_vec3* roam_path_points(const roam_path* path, size_t* count) {
  const bool there = path != nullptr;
  if (count != nullptr) *count = there ? path->points.size() : 0;
  return there ? path->points.data() : nullptr;
}

void roam_path_free(roam_path* path) { delete path; }

roam_status roam_train(const roam_survey* survey, const roam_train_options* options, roam_training* training,
                       roam_profile** profile) {
  return guarded([&] {
    const roam::Survey& scene = needed(survey, "the survey").survey;
    const roam_train_options what = given(options, "roam_train_options");
    check_room(training, "roam_training");
    Progress progress(what.progress, what.progress_data);
    roam::TrainOptions how;
    how.mode = mode_of(what.mode);
    how.paths = what.paths;
    if (what.seed != 0) how.seed = what.seed;
    how.height = what.height;
    if (what.radius_min != 0.0) how.radius_min = what.radius_min;
    if (what.radius_max != 0.0) how.radius_max = what.radius_max;
    if (what.spacing != 0.0) how.spacing = what.spacing;
    how.threads = what.threads;
    how.progress = [&](roam::TrainStage, double done) { return progress.goes_on(done); };
    const roam::Training found = train(scene, how);
    if (!found.complete) progress.check(1.0);
    if (profile != nullptr) *profile = new roam_profile{profile_of(found, scene)};

    roam_training facts{};
    facts.radius = found.radius;
    facts.height = found.height;
    facts.support_radius = found.support_radius;
    facts.step = found.step;
    facts.slope_degrees = found.slope_degrees;
    facts.smallest = found.smallest;
    facts.largest = found.largest.value_or(std::numeric_limits<double>::infinity());
    facts.paths = found.paths.size();
    facts.cracks = found.cracks.size();
    facts.places = found.places;
    facts.feasible = found.feasible ? 1 : 0;
    facts.complete = found.complete ? 1 : 0;
    put(*training, facts);
  });
}

roam_status roam_profile_load(const char* file, roam_profile** profile) {
  return guarded(file, [&] {
    (void)needed(file, "the path");
    (void)needed(profile, "the address for the profile");
    *profile = new roam_profile{roam::load_profile(file)};
  });
}

roam_status roam_profile_beside(const char* scene, roam_profile** profile) {
  std::string file;
  const roam_status status =
      guarded([&] { file = roam::profile_path(std::filesystem::path(&needed(scene, "the path"))).string(); });
  return status == ROAM_OK ? roam_profile_load(file.c_str(), profile) : status;
}

roam_status roam_profile_save(const roam_profile* profile, const char* file) {
  // A file that is not there yet is no error, but a folder is.
  std::string folder;
  const roam_status status =
      guarded([&] { folder = (std::filesystem::path(".") / &needed(file, "the path")).parent_path().string(); });
  if (status != ROAM_OK) return status;
  return guarded(folder.c_str(), [&] { save_profile(needed(profile, "the profile").profile, file); });
}

roam_status roam_profile_apply(const roam_profile* profile, roam_walker_settings* settings) {
  return guarded([&] {
    const roam::Profile& of = needed(profile, "the profile").profile;
    apply_to(needed(settings, "roam_walker_settings"), of);
  });
}

roam_status roam_walker_set_regions(roam_walker* walker, const roam_profile* profile) {
  return guarded(
      [&] { needed(walker, "the walker").walker.set_regions(needed(profile, "the profile").profile.regions); });
}

void roam_profile_free(roam_profile* profile) { delete profile; }
