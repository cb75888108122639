#pragma once
/// \file
/// Pictures and films of what a Frame shows.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <osg/Image>
#include <osg/ref_ptr>

#include "graphics/frame.h"
#include "roam/error.h"

namespace roam::graphics {

/// Writes an image by its extension (.png, .jpg, .jpeg): under a temporary name beside `path`, then renamed, so that
/// there is never half a picture. Throws roam::Error with the reason.
void write_image(const osg::Image& image, const std::filesystem::path& path);

/// One picture of the next frame, written by a thread of its own.
///
///     Screenshot shot(frame, "out.png", true);
///     viewer.frame();
///     shot.finish();
class Screenshot {
 public:
  /// Asks for the picture. with_hud: with the head-up display. Throws roam::Error at once for an extension it cannot
  /// write.
  Screenshot(Frame& frame, std::filesystem::path path, bool with_hud);
  /// Waits for a file that is being written.
  ~Screenshot();
  /// What was moved from is done, has nothing to finish and an empty path.
  Screenshot(Screenshot&&) noexcept;
  Screenshot& operator=(Screenshot&&) noexcept;

  /// Whether the file is written, or will not be: then finish() does not wait.
  [[nodiscard]] bool done() const;
  /// Waits until the file is written. Throws roam::Error with the reason when it could not be, and when the picture was
  /// too large to be drawn: then there is no file. In threaded viewers the frame may still be being drawn when
  /// viewer.frame() returns, so this waits for it: 10 s in vain, and then throws, when no frame was drawn at all.
  void finish();
  [[nodiscard]] const std::filesystem::path& path() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

/// A film in H.264 (.mp4, yuv420p, constant frame rate) by the program ffmpeg, fed by a thread of its own. Odd sizes
/// get a black row or column. Under a temporary name until finish().
class Video {
 public:
  /// `frames_per_second` in [1, 240]. Throws roam::Error when ffmpeg is not on the PATH (says how to install it), for
  /// an extension other than .mp4, and for a size out of [16, 8192].
  Video(std::filesystem::path path, int width, int height, int frames_per_second);
  /// Drops what is not finished, and removes the temporary file.
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  /// Appends a picture of the film's size (RGB, 8 bit, as Frame::request_picture gives it). Waits while 8 pictures are
  /// waiting to be encoded. May be called from any one thread. Throws roam::Error for another size, and with the last
  /// words of ffmpeg when that has failed.
  void add(osg::ref_ptr<osg::Image> image);
  /// Appends a picture taken at `seconds` since the film's begin, which must not fall: repeated or left out so that the
  /// film runs as time did.
  void add(osg::ref_ptr<osg::Image> image, double seconds);
  /// Pictures in the film so far.
  [[nodiscard]] std::int64_t frames() const;

  /// Ends the film: waits until all is encoded and gives the file its name. Throws roam::Error with the last words of
  /// ffmpeg when it failed, or when the film has no picture.
  void finish();

 private:
  class Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace roam::graphics
