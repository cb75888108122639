// Which bodies go everywhere in a scene and fall nowhere; kept beside the scene, where `roam view` takes it from.
#include <cstdio>
#include <utility>

#include "roam/import.h"
#include "roam/profile.h"
#include "roam/train.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: train_a_scene SCENE\n");
    return 2;
  }
  try {
    roam::Scene scene = roam::import_scene(argv[1]);
    roam::Profile profile;
    profile.scene = roam::identity_of(scene.meshes);
    const roam::Survey survey = roam::Survey::build(std::move(scene.meshes), {.lossless = true});
    const roam::Training training = roam::train(survey, {.height = 1.8});
    std::printf("%s\n", training.answer.c_str());
    if (training.radius <= 0.0) return 3;  // nobody fits anywhere

    profile.radius = training.radius;
    profile.support_radius = training.support_radius;
    profile.height = 1.8;
    profile.largest = training.largest;
    profile.smallest = training.smallest;
    profile.regions = training.regions;
    roam::save_profile(profile, roam::profile_path(argv[1]));
    return training.feasible ? 0 : 3;
  } catch (const roam::Error& error) {
    std::fprintf(stderr, "train_a_scene: %s\n", error.what());
    return 1;
  }
}
