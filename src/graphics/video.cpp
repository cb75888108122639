#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <ctime>
#include <deque>
#include <functional>
#include <mutex>
#include <osg/Image>
#include <string>
#include <thread>
#include <utility>

#include "files/extension.h"
#include "files/mark.h"
#include "files/whole_file.h"
#include "graphics/capture.h"
#include "process/child.h"
#include "process/find_program.h"

namespace roam::graphics {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_waiting = 8;
/// Bytes. A disk with no more free space than this counts as full.
constexpr std::uintmax_t full_disk = 1 << 20;
constexpr int least_side = 16, largest_side = 8192;

/// Number of the film's descriptor in ffmpeg. Its path may lead to another file by then.
constexpr int film_descriptor = 3;

using Words = std::vector<std::string>;

/// Output options of a kind of film.
struct Kind {
  const char* extension;
  Words encoder;
  bool is_video;  ///< for players, which want even sizes and a stated colour space
};

const std::array<Kind, 4>& kinds() {
  static const std::array<Kind, 4> all{{
      {".mp4", {"-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-movflags", "+faststart", "-f", "mp4"}, true},
      {".webm",
       {"-c:v", "libvpx-vp9", "-crf", "28", "-b:v", "0", "-deadline", "good", "-cpu-used", "4", "-row-mt", "1", "-f",
        "webm"},
       true},
      {".gif", {"-loop", "0", "-f", "gif"}, false},
      // Whole pictures: libwebp_anim leaves parts that have changed a little, which shows as blocks in the sky.
      {".webp", {"-c:v", "libwebp", "-quality", "80", "-loop", "0", "-f", "webp"}, false},
  }};
  return all;
}

const Kind* kind_of(const fs::path& path) {
  const std::string extension = files::lower_extension(path);
  const auto found =
      std::find_if(kinds().begin(), kinds().end(), [&](const Kind& k) { return k.extension == extension; });
  return found == kinds().end() ? nullptr : &*found;
}

/// Images begin with their lowest row. Sizes must be even for yuv420p. Players assume BT.709 for large films without a
/// stated colour space, so that is used and stated. A GIF gets a palette for each picture: one for all would need all
/// pictures in memory.
std::string filters(const Kind& kind) {
  if (kind.is_video) return "vflip,pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv";
  if (kind.extension != std::string(".gif")) return "vflip";
  return "vflip,split[a][b];[a]palettegen=stats_mode=single:reserve_transparent=0[p];"
         "[b][p]paletteuse=new=1:dither=bayer:bayer_scale=4";
}

Words arguments(const Kind& kind, int width, int height, int rate) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  // Without -xerror ffmpeg succeeds although the disk has no room for a film's index.
  Words all{"-hide_banner", "-loglevel",     "error", "-nostdin",    "-xerror",    "-y",         "-f",
            "rawvideo",     "-pixel_format", "rgb24", "-video_size", size,         "-framerate", std::to_string(rate),
            "-i",           "pipe:0",        "-an",   "-vf",         filters(kind)};
  if (kind.is_video) {
    const Words colours{"-pix_fmt",         "yuv420p", "-colorspace", "bt709",
                        "-color_primaries", "bt709",   "-color_trc",  "bt709"};
    all.insert(all.end(), colours.begin(), colours.end());
  }
  all.insert(all.end(), kind.encoder.begin(), kind.encoder.end());
  // A part of .mp4 and .webm; ffmpeg leaves it out of the others.
  all.insert(all.end(), {"-metadata", "comment=" + std::string(files::mark)});
  // The index of a film is written last, at its beginning, which a pipe cannot do.
  all.push_back("file:/dev/fd/" + std::to_string(film_descriptor));
  return all;
}

/// A pair of sockets instead of a pipe: writing to one whose reader has died is an error, not a signal.
struct Line {
  int ours = -1, theirs = -1;
  Line() {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) throw Error("cannot open a line to ffmpeg");
    ours = ends[0];
    theirs = ends[1];
  }
  ~Line() {
    close_ours();
    close_theirs();
  }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  void close_ours() {
    if (ours >= 0) close(ours);
    ours = -1;
  }
  void close_theirs() {
    if (theirs >= 0) close(theirs);
    theirs = -1;
  }
};

fs::path find_ffmpeg() {
  fs::path program = process::find_program("ffmpeg");
  if (program.empty()) {
    throw Error(
        "films are made by the program ffmpeg, which is not on the PATH. Install it (Debian: apt-get install "
        "ffmpeg)");
  }
  return program;
}

}  // namespace

/// The process of ffmpeg, and the thread that feeds it.
class Video::Encoder {
 public:
  Encoder(fs::path path, const Kind& kind, int width, int height, int rate)
      : path_(std::move(path)),
        file_(path_, files::Naming::exact, files::marked("film")),
        width_(width),
        height_(height),
        rate_(rate),
        process_(find_ffmpeg(), arguments(kind, width, height, rate),
                 {.descriptors = {{line_.theirs, STDIN_FILENO}, {file_.descriptor(), film_descriptor}},
                  .orphan = process::Orphan::lives_on}) {
    line_.close_theirs();
    feeder_ = std::thread([this] { feed(); });
  }

  ~Encoder() {
    if (feeder_.joinable()) {
      {
        const std::lock_guard lock(mutex_);
        waiting_.clear();
        ended_ = true;
        changed_.notify_all();
      }
      process_.end();  // this also wakes a thread that is writing
      feeder_.join();
    }
  }

  void add(osg::ref_ptr<osg::Image> image, std::int64_t times) {
    if (times <= 0) return;
    if (image->s() != width_ || image->t() != height_) {
      throw Error::at(path_.string(), "a picture of " + std::to_string(image->s()) + " x " +
                                          std::to_string(image->t()) + " does not fit the film " + path_.string() +
                                          " of " + std::to_string(width_) + " x " + std::to_string(height_) +
                                          ": end the film when the window is resized");
    }
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return waiting_.size() < most_waiting || broken_; });
    if (broken_) {
      lock.unlock();
      fail();
    }
    waiting_.emplace_back(std::move(image), times);
    frames_ += times;
    changed_.notify_all();
  }

  [[nodiscard]] std::int64_t frames() const {
    const std::lock_guard lock(mutex_);
    return frames_;
  }
  [[nodiscard]] int rate() const { return rate_; }

  void finish(std::chrono::milliseconds longest, const std::function<bool()>& is_urgent) {
    if (!feeder_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
      changed_.notify_all();
    }
    if (!wait(longest, is_urgent)) fail("it did not end");
    feeder_.join();
    if (!process_.ending().is_success() || broken_) fail();
    if (frames_ == 0) throw Error::at(path_.string(), "the film " + path_.string() + " has no picture");
    files::add_mark(file_);
    file_.commit();
  }

 private:
  /// ffmpeg's processor time, and when it last wrote to the film, in nanoseconds: one of them changes while it works.
  [[nodiscard]] std::array<std::int64_t, 2> work() const {
    const auto nanoseconds = [](const timespec& t) { return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec; };
    clockid_t clock{};
    timespec computed{};
    if (::clock_getcpuclockid(process_.id(), &clock) == 0) ::clock_gettime(clock, &computed);
    struct stat film {};
    ::fstat(file_.descriptor(), &film);
    return {nanoseconds(computed), nanoseconds(film.st_mtim)};
  }

  /// Waits so long at most. Returns whether all pictures are with ffmpeg, and it has ended.
  bool has_ended_within(std::chrono::milliseconds limit) {
    if (std::unique_lock lock(mutex_); !changed_.wait_for(lock, limit, [&] { return fed_; })) return false;
    line_.close_ours();
    return process_.wait(limit);
  }

  /// Returns whether ffmpeg has ended. The index of a long film, at its beginning, moves all of it: that takes minutes.
  bool wait(std::chrono::milliseconds longest, const std::function<bool()>& is_urgent) {
    constexpr std::chrono::milliseconds look{100};
    // The time of its last work; once it is urgent, that at which it became so.
    auto from = std::chrono::steady_clock::now();
    bool urgent = false;
    for (auto before = work(); !has_ended_within(look);) {
      const auto now = std::chrono::steady_clock::now();
      const auto after = work();
      const bool works = std::exchange(before, after) != after;
      const bool becomes_urgent = !urgent && is_urgent && is_urgent();
      if (becomes_urgent || (works && !urgent)) from = now;
      urgent = urgent || becomes_urgent;
      if (now - from > longest) return false;
    }
    return true;
  }

  void feed() {
    feed_all();
    const std::lock_guard lock(mutex_);
    fed_ = true;
    changed_.notify_all();
  }

  void feed_all() {
    for (;;) {
      std::pair<osg::ref_ptr<osg::Image>, std::int64_t> next;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return !waiting_.empty() || ended_; });
        if (waiting_.empty()) return;
        next = std::move(waiting_.front());
        waiting_.pop_front();
        changed_.notify_all();
      }
      for (std::int64_t i = 0; i < next.second; ++i) {
        if (send_all(next.first->data(), next.first->getTotalSizeInBytes())) continue;
        const std::lock_guard lock(mutex_);
        broken_ = true;
        changed_.notify_all();
        return;
      }
    }
  }

  bool send_all(const unsigned char* bytes, std::size_t left) const {
    while (left > 0) {
      const ssize_t n = send(line_.ours, bytes, left, MSG_NOSIGNAL);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      bytes += n;
      left -= static_cast<std::size_t>(n);
    }
    return true;
  }

  /// `why`: if ffmpeg says nothing.
  [[noreturn]] void fail(const char* why = "") {
    process_.wait(std::chrono::seconds(1));
    std::string words = process_.last_words();
    if (words.empty()) words = why;
    // One that exceeds `ulimit -f` has no words.
    if (const int number = process_.ending().signal; words.empty() && number != 0) {
      const char* const name = ::sigdescr_np(number);
      words = "it was ended: " + (name != nullptr ? std::string(name) : "signal " + std::to_string(number));
    }
    struct statvfs disk {};
    const bool full =
        ::fstatvfs(file_.descriptor(), &disk) == 0 && std::uintmax_t{disk.f_bavail} * disk.f_frsize < full_disk;
    throw Error::at(path_.string(), "ffmpeg could not make the film " + path_.string() +
                                        (words.empty() ? "" : ": " + words) +
                                        (full ? "; the disk is full: make room there or choose another place" : ""));
  }

  const fs::path path_;
  files::WholeFile file_;
  const int width_, height_, rate_;
  Line line_;
  process::Child process_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::pair<osg::ref_ptr<osg::Image>, std::int64_t>> waiting_;
  std::int64_t frames_ = 0;
  bool ended_ = false, fed_ = false, broken_ = false;
  std::thread feeder_;
};

void Video::check(const fs::path& path, int width, int height, int frames_per_second) {
  if (!is_film(path)) {
    throw Error::at(path.string(),
                    "cannot write the film " + path.string() + ": its name must end in .mp4, .webm, .gif or .webp");
  }
  if (width < least_side || height < least_side || width > largest_side || height > largest_side) {
    throw Error("a film of " + std::to_string(width) + " x " + std::to_string(height) +
                " pixels cannot be made: each side must be in [16, 8192]");
  }
  if (frames_per_second < 1 || frames_per_second > 240) {
    throw Error("a film of " + std::to_string(frames_per_second) +
                " pictures a second cannot be made: it must be in [1, 240]");
  }
  static_cast<void>(find_ffmpeg());
}

Video::Video(fs::path path, int width, int height, int frames_per_second) {
  check(path, width, height, frames_per_second);
  const Kind& kind = *kind_of(path);
  encoder_ = std::make_unique<Encoder>(std::move(path), kind, width, height, frames_per_second);
}

Video::~Video() = default;

void Video::add(osg::ref_ptr<osg::Image> image) { encoder_->add(std::move(image), 1); }

void Video::add(osg::ref_ptr<osg::Image> image, double seconds) {
  // Picture k is shown from time k / rate. This picture fills all that have begun.
  const auto begun = static_cast<std::int64_t>(std::floor(seconds * encoder_->rate() + time_rounding)) + 1;
  encoder_->add(std::move(image), begun - encoder_->frames());
}

std::int64_t Video::frames() const { return encoder_->frames(); }

void Video::finish(std::chrono::milliseconds longest, const std::function<bool()>& is_urgent) {
  encoder_->finish(longest, is_urgent);
}

bool Video::is_film(const fs::path& path) { return kind_of(path) != nullptr; }

int Video::usual_rate(const fs::path& path) { return files::lower_extension(path) == ".gif" ? 20 : 30; }

}  // namespace roam::graphics
