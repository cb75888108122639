#pragma once
/// \file
/// Builder of one part: surfaces and pages as the plain values of display_part.h.

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "import/display_part.h"
#include "import/reader/display/surface.h"
#include "import/reader/display/textures.h"
#include "roam/math.h"

namespace roam::reader {

class PartGraph {
 public:
  /// `origin` is subtracted from every coordinate.
  PartGraph(Textures& textures, const Vec3& origin);

  /// Adds the chunks of a surface with one look to a group. `normals`: whether all its vertices have normals.
  /// `objects`: the names of the objects of its runs.
  void add(const Surface& surface, const Look& look, bool normals, std::uint32_t group,
           std::span<const std::string> objects);
  /// Adds a group, which must become a level of one node of pages. Returns its number.
  [[nodiscard]] std::uint32_t add_group() { return part_.groups++; }
  /// Adds a node of pages, with its centre in the frame of the scene, and bounds `box`. Returns its number. Add it
  /// before the contents of its levels.
  std::size_t add_pages(DisplayPages&& pages, const Box& box);
  [[nodiscard]] DisplayPages& pages(std::size_t number) { return part_.pages[number]; }

  /// The part so far.
  [[nodiscard]] const DisplayPart& part() const { return part_; }
  /// Approximate bytes of geometry and images.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  /// A texture of the part, and whether it is translucent somewhere.
  struct Loaded {
    std::uint32_t number = DisplayLook::no_texture;
    bool translucent = false;
  };
  enum class Content : std::uint8_t { colours, gloss };
  Loaded load(TextureId texture, Content content);
  std::uint32_t number_of(const Look& look);
  [[nodiscard]] std::vector<DisplayRun> runs_of(const Surface& surface, std::span<const std::uint32_t> chunk,
                                                std::span<const std::string> objects);

  Textures& textures_;
  DisplayPart part_;
  std::size_t bytes_ = 0;
  std::map<std::pair<TextureId, Content>, Loaded> loaded_;
  std::map<Look, std::uint32_t> looks_;
  std::unordered_map<std::string, std::uint32_t> objects_;  ///< number in the part, by name
};

}  // namespace roam::reader
