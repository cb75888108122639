// Finds the size of body that can walk everywhere in a scene without falling. Saves it as a profile beside the scene,
// where `roam view` looks for it.
#include <cstdio>

#include "roam/import.h"
#include "roam/train.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: train_a_scene SCENE\n");
    return 2;
  }
  try {
    const roam::Survey survey = roam::Survey::build(roam::import_scene(argv[1]).meshes, {.lossless = true});
    const roam::Training training = roam::train(survey, {.height = 1.8});
    if (training.places == 0) return 3;  // no body fits anywhere
    std::printf("%s a body with a radius of %.3f m: %zu paths were planned\n",
                training.feasible ? "all are served by" : "the best is", training.radius, training.paths.size());

    roam::save_profile(roam::profile_of(training, survey), roam::profile_path(argv[1]));
    return training.feasible ? 0 : 3;
  } catch (const roam::Error& error) {
    std::fprintf(stderr, "train_a_scene: %s\n", error.what());
    return 1;
  }
}
