#pragma once
/// \file
/// Pictures of any size, drawn in tiles that meet without a seam, in bounded graphics memory.

#include <cstdint>
#include <functional>
#include <osg/Image>
#include <osg/ref_ptr>
#include <vector>

#include "graphics/frame.h"

namespace roam::graphics {

/// Limits of what is drawn at once. A drawn pixel takes some 50 bytes of graphics memory.
struct TileLimits {
  std::int64_t pixels = 9'500'000;
  int side = 4096;       ///< pixels, of a picture that is drawn at once
  int tile_side = 3072;  ///< pixels, of a tile with its margins, which take two thirds of it at most
};

/// A tile of a picture: the part that is drawn, and the pixels of it that are kept. Effects depend on the margin
/// between the two.
struct Tile {
  PicturePart drawn;
  int x = 0, y = 0, width = 0, height = 0;  ///< kept, in the whole picture
};

/// Whether a picture of this size is a single tile.
[[nodiscard]] bool is_drawn_at_once(int width, int height, const TileLimits& limits = {});

/// The tiles of a picture. Kept pixels cover it once.
[[nodiscard]] std::vector<Tile> tiles_of(int width, int height, const TileLimits& limits = {});

/// The view of `frame` in `width` x `height` pixels, fully drawn (Quality::full), without the head-up display: RGB, 3
/// bytes a pixel. `draw` draws one frame, and returns when that is done. Throws roam::Error if the driver cannot draw a
/// tile, or if there is no memory; what else `draw` throws, ends it. Afterwards the frame draws its window again.
[[nodiscard]] osg::ref_ptr<osg::Image> draw_large_picture(Frame& frame, int width, int height,
                                                          const std::function<void()>& draw,
                                                          const TileLimits& limits = {});

}  // namespace roam::graphics
