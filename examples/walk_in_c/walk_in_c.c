/* A person walks over a floor towards a wall 5 m away. Before that, three rays measure how far the wall is. */
#include <roam/roam.h>
#include <stdio.h>

static int failed(void) {
  fprintf(stderr, "walk_in_c: %s\n", roam_error());
  return 1;
}

int main(void) {
  static const double vertices[] = {-9, -9, 0, 9, -9, 0, 9, 9, 0, -9, 9, 0, 5, -9, 0, 5, 9, 0, 5, 9, 3, 5, -9, 3};
  static const uint32_t floor_triangles[] = {0, 1, 2, 0, 2, 3};
  static const uint32_t wall_triangles[] = {4, 5, 6, 4, 6, 7};
  const roam_mesh meshes[] = {
      {.size = sizeof(roam_mesh), .name = "floor", .vertices = vertices, .vertex_count = 8,
       .triangles = floor_triangles, .triangle_count = 2},
      {.size = sizeof(roam_mesh), .name = "wall", .vertices = vertices, .vertex_count = 8,
       .triangles = wall_triangles, .triangle_count = 2},
  };
  roam_space* world = NULL;
  if (roam_world_build(meshes, 2, NULL, &world) != ROAM_OK) return failed();

  /* A batch takes arrays of any layout, such as those of your own structs. */
  struct ray {
    double from[3];
    double time;
  } rays[3] = {{{0, -1, 1}, 0}, {{0, 0, 1}, 0}, {{0, 1, 1}, 0}};
  const double motion[3] = {10, 0, 0};
  const roam_batch batch = {
      .size = sizeof batch, .count = 3, .from = {rays[0].from, sizeof rays[0]}, .motion = {motion, 0},
      .time = {&rays[0].time, sizeof rays[0]}};
  if (roam_sweep_batch(world, &batch) != ROAM_OK) return failed();
  for (int i = 0; i < 3; ++i) printf("the wall is %.2f m away\n", 10 * rays[i].time);

  roam_walker_settings person = {.size = sizeof person};
  roam_walker* walker = NULL;
  const roam_vec3 start = {0, 0, 1};
  if (roam_walker_person(&person, 0.3, 1.8) != ROAM_OK) return failed();
  if (roam_walker_create(world, &person, ROAM_WALK, start, &walker) != ROAM_OK) return failed();
  roam_space_free(world); /* the walker keeps what it needs */

  const roam_walker_input ahead = {.size = sizeof ahead, .velocity = {1.4, 0, 0}};
  roam_step step = {.size = sizeof step};
  for (int i = 0; i < 600 && !step.blocked; ++i) {
    if (roam_walker_step(walker, &ahead, 1.0 / 60, &step) != ROAM_OK) return failed();
  }
  printf("stopped at x = %.2f m\n", step.to.x);
  roam_walker_free(walker);
  return step.blocked ? 0 : 1;
}
