#include "graphics/large_picture.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <string>

#include "graphics/composite.h"
#include "roam/error.h"

namespace roam::graphics {
namespace {

int rounded_up(int pixels) { return (pixels + effects_period - 1) / effects_period * effects_period; }

/// Lengths of about equal size, at most `most` and multiples of the period but for the last.
std::vector<int> divided(int length, int most) {
  const int count = (length + most - 1) / most;
  const int step = rounded_up((length + count - 1) / count);
  std::vector<int> pieces;
  for (int at = 0; at < length; at += step) pieces.push_back(std::min(step, length - at));
  return pieces;
}

/// A picture that may arrive after nobody waits any longer.
struct Drawn {
  osg::ref_ptr<osg::Image> image;
  std::string problem;
};

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

void copy(const osg::Image& from, const Tile& tile, osg::Image& to) {
  const auto left = static_cast<unsigned>(tile.x - tile.drawn.x), lower = static_cast<unsigned>(tile.y - tile.drawn.y);
  const std::size_t bytes = std::size_t{3} * static_cast<std::size_t>(tile.width);
  for (unsigned row = 0; row < static_cast<unsigned>(tile.height); ++row) {
    std::memcpy(to.data(static_cast<unsigned>(tile.x), static_cast<unsigned>(tile.y) + row),
                from.data(left, lower + row), bytes);
  }
}

osg::ref_ptr<osg::Image> draw_tiles(Frame& frame, int width, int height, const std::function<void()>& draw,
                                    const TileLimits& limits) {
  osg::ref_ptr<osg::Image> whole = new osg::Image;
  whole->allocateImage(width, height, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
  struct Window {
    Frame& frame;
    ~Window() { frame.set_part({}); }
  } window{frame};
  for (const Tile& tile : tiles_of(width, height, limits)) {
    frame.set_part(tile.drawn);
    const auto drawn = std::make_shared<Drawn>();
    frame.request_picture(
        false, [drawn](osg::ref_ptr<osg::Image> image) { drawn->image = std::move(image); },
        [drawn](const std::string& reason) { drawn->problem = reason; }, Finish::full);
    draw();
    if (!drawn->image) {
      throw Error("a picture of " + size_text(width, height) + " cannot be drawn" +
                  (drawn->problem.empty() ? "" : ": " + drawn->problem));
    }
    copy(*drawn->image, tile, *whole);
  }
  return whole;
}

}  // namespace

bool is_drawn_at_once(int width, int height, const TileLimits& limits) {
  return std::int64_t{width} * height <= limits.pixels && std::max(width, height) <= limits.side;
}

std::vector<Tile> tiles_of(int width, int height, const TileLimits& limits) {
  if (is_drawn_at_once(width, height, limits)) {
    return {{{width, height, 0, 0, width, height}, 0, 0, width, height}};
  }
  const int margin = rounded_up(effects_reach(height));
  const int most = std::max(limits.tile_side - 2 * margin, margin) / effects_period * effects_period;
  std::vector<Tile> tiles;
  int y = 0;
  for (const int rows : divided(height, most)) {
    int x = 0;
    for (const int columns : divided(width, most)) {
      const int left = std::max(x - margin, 0), right = std::min(x + columns + margin, width);
      const int lower = std::max(y - margin, 0), upper = std::min(y + rows + margin, height);
      tiles.push_back({{width, height, left, lower, right - left, upper - lower}, x, y, columns, rows});
      x += columns;
    }
    y += rows;
  }
  return tiles;
}

osg::ref_ptr<osg::Image> draw_large_picture(Frame& frame, int width, int height, const std::function<void()>& draw,
                                            const TileLimits& limits) {
  try {
    return draw_tiles(frame, width, height, draw, limits);
  } catch (const std::bad_alloc&) {
    throw Error("there is no memory for a picture of " + size_text(width, height));
  }
}

}  // namespace roam::graphics
