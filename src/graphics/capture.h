#pragma once
/// \file
/// Pictures and films of a Frame.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <osg/Image>
#include <osg/ref_ptr>

#include "files/whole_file.h"
#include "graphics/frame.h"
#include "roam/error.h"

namespace roam::graphics {

/// Writes an image in the format of its extension (.png, .jpg, .jpeg). The file gets a temporary name beside `path`
/// until it is complete, and replaces only a picture made by roam. Returns the file's path. Throws roam::Error with the
/// reason.
std::filesystem::path write_image(const osg::Image& image, const std::filesystem::path& path,
                                  files::Naming naming = files::Naming::exact);

/// A picture of the next frame, or one that has been drawn. A thread of its own writes the file.
///
///     Screenshot shot(frame, "out.png", true);
///     viewer.frame();
///     shot.finish();
class Screenshot {
 public:
  /// Requests the picture, with the head-up display if `with_hud`. Throws roam::Error at once for an extension that it
  /// cannot write.
  Screenshot(Frame& frame, std::filesystem::path path, bool with_hud, files::Naming naming = files::Naming::exact);
  /// A picture that has been drawn already, for writing.
  Screenshot(osg::ref_ptr<osg::Image> image, std::filesystem::path path, files::Naming naming = files::Naming::exact);
  /// Waits for a file that is being written.
  ~Screenshot();
  /// The moved-from object is done, has nothing to finish and an empty path.
  Screenshot(Screenshot&&) noexcept;
  Screenshot& operator=(Screenshot&&) noexcept;

  /// Whether the file has been written or has failed, so that finish() does not wait.
  [[nodiscard]] bool done() const;
  /// Waits until the file is written. Throws roam::Error with the reason if that failed, or if the picture was too
  /// large to be drawn; then there is no file. In threaded viewers viewer.frame() may return before the frame is drawn,
  /// so this waits for it. Throws if no frame is drawn within `patience`.
  void finish(std::chrono::seconds patience = std::chrono::seconds(10));
  /// The file's path; once it is done, also of one that is numbered.
  [[nodiscard]] const std::filesystem::path& path() const;

 private:
  struct State;
  void begin(std::filesystem::path path, files::Naming naming);

  std::shared_ptr<State> state_;
};

/// A film of constant frame rate, encoded by the program ffmpeg: .mp4 (H.264), .webm (VP9), .gif, .webp; the last two
/// begin anew at their end. A thread of its own feeds ffmpeg. In .mp4 and .webm odd sizes get a black row or column.
/// The file has a temporary name until finish().
class Video {
 public:
  /// `frames_per_second` in [1, 240]. Throws roam::Error if ffmpeg is not on the PATH (the message says how to install
  /// it), for another extension, and for a size outside [16, 8192].
  Video(std::filesystem::path path, int width, int height, int frames_per_second);
  /// Throws what the constructor throws of these. Begins no film.
  static void check(const std::filesystem::path& path, int width, int height, int frames_per_second);
  /// Discards a film that is not finished, and removes its temporary file.
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  /// Appends a picture of the film's size (RGB, 8 bit, as from Frame::request_picture). Blocks while 8 pictures wait to
  /// be encoded. Call it from one thread only. Throws roam::Error for another size, and with the last line of ffmpeg's
  /// output if ffmpeg has failed.
  void add(osg::ref_ptr<osg::Image> image);
  /// Appends a picture taken `seconds` after the start of the film; `seconds` must not decrease. Repeats or drops
  /// pictures so that the film runs in real time. Rounding errors of up to time_rounding count as none.
  void add(osg::ref_ptr<osg::Image> image, double seconds);
  static constexpr double time_rounding = 1e-3;  ///< of the time of a picture
  /// Number of pictures in the film so far.
  [[nodiscard]] std::int64_t frames() const;

  static constexpr std::chrono::milliseconds patience{100'000};
  /// Ends the film: waits until it is encoded, and gives the file its name. Calls `is_urgent` about ten times a second;
  /// from its first `true` on, ffmpeg has `longest` to end. Throws roam::Error with the last line of ffmpeg's output if
  /// ffmpeg has failed, if it neither computes nor writes for `longest`, if it has no time left, or if the film has no
  /// picture.
  void finish(std::chrono::milliseconds longest = patience, const std::function<bool()>& is_urgent = {});

  /// Whether this extension is that of a film.
  [[nodiscard]] static bool is_film(const std::filesystem::path& path);
  /// Pictures a second, unless asked for others: 30; in .gif, whose pictures last hundredths of a second, 20.
  [[nodiscard]] static int usual_rate(const std::filesystem::path& path);

 private:
  class Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace roam::graphics
