// Finds the widest way from one position of a scene to another, and sends a person along it.
#include <roam/import.h>
#include <roam/passage.h>
#include <roam/route.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc != 8) {
    std::fprintf(stderr, "usage: find_a_way SCENE X Y Z X Y Z\n");
    return 2;
  }
  const auto position = [argv](int i) {
    return roam::Vec3(std::atof(argv[i]), std::atof(argv[i + 1]), std::atof(argv[i + 2]));
  };
  try {
    const roam::Survey survey = roam::Survey::build(roam::import_scene(argv[1]).meshes);
    const roam::PassageOptions options{.height = 1.8, .widest = 0.6};
    const roam::Passage passage = roam::widest_way(survey, position(2), position(5), options);
    if (!passage.found) {
      std::printf("no way for a radius of %.2f m or more\n", options.narrowest);
      return 3;
    }
    std::printf("%.1f m, for a radius of at most %.3f m", passage.length, passage.radius);
    if (passage.opening) {
      std::printf(" because of a %s %.3f m wide", roam::to_string(passage.opening->kind), passage.opening->width);
    }
    std::printf("\n");

    // Slimmer than the opening by 3 %, because worlds are stored to 2 mm.
    const roam::WalkerSettings person =
        roam::WalkerSettings::person(std::min(0.3, 0.97 * passage.radius), options.height);
    const std::vector<roam::Vec3> path = roam::standing(passage.way, person);
    roam::Walker walker(survey.world(), person, roam::Mode::walk, path.front());
    const roam::RouteResult walked = roam::follow(walker, path);
    std::printf("%s after %.1f m\n", roam::to_string(walked.outcome), walked.length);
    return walked.outcome == roam::Outcome::reached ? 0 : 3;
  } catch (const roam::Error& error) {
    std::fprintf(stderr, "find_a_way: %s\n", error.what());
    return 1;
  }
}
