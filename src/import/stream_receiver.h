#pragma once
/// \file
/// The receiving end of a reader's frames: the part that all kinds of reading share.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "import/parts.h"
#include "import/stream.h"

namespace roam::reader {

/// Takes the frames of one reader and records them in a report. Derived classes take the content.
class StreamReceiver {
 public:
  /// `content_bytes`: most bytes of content that this reader may still send.
  StreamReceiver(ImportReport& report, std::size_t ignore_patterns, std::uint64_t content_bytes);
  virtual ~StreamReceiver() = default;
  StreamReceiver(const StreamReceiver&) = delete;
  StreamReceiver& operator=(const StreamReceiver&) = delete;

  /// From now on passes on which files the reader looks up. `sink` must outlive the reading.
  void pass_look_ups(const LookUpSink& sink) { look_ups_ = &sink; }
  /// From now on replaces the reader's name of the path by the user's name in sentences.
  void spell(std::string readers_name, std::string users_name);

  /// The buffer for the next bytes of the stream.
  [[nodiscard]] std::span<std::byte> room();
  /// Takes the first `count` bytes of room(). Throws StreamDamaged, ContentTooLarge, exceptions of derived
  /// classes, or roam::Error: the reader's own about what is wrong with the file.
  void take(std::size_t count);

  /// Whether the reader has sent its last frame. Nothing may follow.
  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] std::uint64_t bytes_read() const { return bytes_read_; }
  /// The files that the reader has opened since the last call.
  [[nodiscard]] std::vector<std::string> take_opened() { return std::exchange(opened_, {}); }
  /// For each pattern of ImportOptions::ignore, whether an object's name matched it. Valid once ended().
  [[nodiscard]] const std::vector<bool>& matched() const { return matched_; }
  /// Triangles received so far.
  [[nodiscard]] virtual std::uint64_t triangles() const = 0;
  /// Vertices received so far, if there are any without triangles.
  [[nodiscard]] virtual std::uint64_t vertices() const { return 0; }
  /// Triangles that the reader left out of objects so far.
  [[nodiscard]] std::uint64_t left_out_triangles() const { return left_out_triangles_; }
  /// Processor seconds of this thread for frames that are no content.
  [[nodiscard]] double own_seconds() const { return own_seconds_; }

  /// The stream violates the protocol, so the reader is broken.
  struct StreamDamaged {
    std::string how;
  };
  /// More than content_bytes arrived.
  struct ContentTooLarge {};

 protected:
  /// Takes a frame of content. Throws StreamDamaged for kinds that do not belong to this reading.
  virtual void take_content(FrameKind kind, std::span<const std::byte> payload) = 0;
  /// Called when the content is complete. Throws StreamDamaged unless the totals equal the contents received.
  virtual void finish_content(const Totals& totals) = 0;

  void count_bytes(std::size_t bytes);
  /// Adds a text to the names, if there is room.
  static void take_name(PayloadReader& fields, std::vector<std::string>& names);
  /// The next text, cut to object_name_limit between two characters.
  static std::string take_object_name(PayloadReader& fields);
  ImportReport& report_;

 private:
  /// Objects that were left out, and the place of each name in their list.
  struct LeftOutObjects {
    std::vector<LeftOutObject>& list;
    std::unordered_map<std::string, std::size_t> places{};
    void add(LeftOutObject&& object);
  };

  void handle(const FrameHeader& header, std::span<const std::byte> payload);
  void take_description(const FrameHeader& header, std::span<const std::byte> payload);
  void take_hello(PayloadReader& fields);
  void take_looked_up(PayloadReader& fields);
  void take_left_out(PayloadReader& fields);
  void take_end(PayloadReader& fields);
  [[nodiscard]] std::string spelt(std::string sentence) const;

  std::size_t ignore_patterns_;
  std::uint64_t content_bytes_left_;
  // Bytes that have arrived and are not taken yet. Frames are taken without a copy.
  std::unique_ptr<std::byte[]> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  std::uint32_t next_number_ = 0;
  bool ended_ = false;
  std::uint64_t bytes_read_ = 0;
  std::vector<bool> matched_;
  std::vector<std::string> opened_;
  LeftOutObjects bad_objects_, ignored_objects_;
  std::uint64_t left_out_triangles_ = 0;
  double own_seconds_ = 0.0;
  const LookUpSink* look_ups_ = nullptr;
  std::string readers_name_, users_name_;
};

}  // namespace roam::reader
