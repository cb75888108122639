#pragma once
/// \file
/// Judges how ways ended, by geometry that no mover uses.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "paper_ways.h"
#include "roam/mesh.h"

namespace roam::bench {

/// `cut`: patience ran out first; the rest of the way is unknown.
enum class Ending : std::uint8_t { reached, stuck, fell, through, cut };

/// "completed", "stuck", "fell", "through a wall" or "not finished".
[[nodiscard]] const char* to_string(Ending ending);

/// How a way ended.
struct Judgement {
  Ending ending = Ending::stuck;
  std::size_t in_walls = 0;  ///< steps deeper in a wall than depth_allowed, for the body's radius on each
  double deepest = 0.0;      ///< metres
};

/// Judges ways by a scene that arrives mesh by mesh, in bounded memory. Only triangles near some step are kept; when
/// there are many, they are judged and freed. A body whose centre crosses a triangle went through a wall.
class PaperJudge {
 public:
  static constexpr std::size_t most_kept = 1u << 20;  ///< triangles, at some 400 bytes each while they are judged

  explicit PaperJudge(std::size_t most = most_kept) : most_(most) {}

  /// Adds a way; call it before add(). `walked` is not needed afterwards.
  void watch(const Way& way, const Walked& walked);
  /// Adds each mesh of the scene, in any order.
  void add(const Mesh& mesh);
  /// In the order of watch(), after the whole scene.
  [[nodiscard]] std::vector<Judgement> judgements();

 private:
  struct Step {
    Vec3 from, to;
    Body body;
    double clearance = 0.0;  ///< of the axis on the step, at most the radius
    bool crossed = false;
  };
  /// Steps that follow each other, and the box of the body on them.
  struct Block {
    std::size_t begin = 0, end = 0;
    Box box;
  };
  struct Watched {
    std::size_t begin = 0, end = 0;  ///< of steps_
    Ending ending;                   ///< unless it went through a wall
  };
  void settle();

  std::size_t most_;
  std::vector<Step> steps_;
  std::vector<Block> blocks_;
  std::vector<Watched> watched_;
  Mesh kept_{.name = "near", .vertices = {}, .triangles = {}};
};

}  // namespace roam::bench
