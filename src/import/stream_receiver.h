#pragma once
/// \file
/// The receiving end of a reader's frames: what all kinds of reading have in common.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "import/stream.h"
#include "roam/import.h"

namespace roam::reader {

/// Takes the frames of one reader and writes what they say into a report; what they bring is for derived classes.
class StreamReceiver {
 public:
  /// `content_bytes`: most bytes of content that this reader may still send.
  StreamReceiver(ImportReport& report, std::size_t ignore_patterns, std::uint64_t content_bytes);
  virtual ~StreamReceiver() = default;
  StreamReceiver(const StreamReceiver&) = delete;
  StreamReceiver& operator=(const StreamReceiver&) = delete;

  /// From now on sentences that name the path as the reader knows it name it as the user does.
  void spell(std::string readers_name, std::string users_name);

  /// Where the next bytes of the stream are to be put.
  [[nodiscard]] std::span<std::byte> room();
  /// Takes the first `count` bytes of the room. Throws StreamDamaged, ContentTooLarge, Failure, or what a taker throws.
  void take(std::size_t count);

  /// Whether the reader has said that it is done; nothing may follow.
  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] std::uint64_t bytes_read() const { return bytes_read_; }
  /// The files that the reader has opened since the last call.
  [[nodiscard]] std::vector<std::string> take_opened() { return std::exchange(opened_, {}); }
  /// For each pattern of ImportOptions::ignore whether an object's name matched it; known once ended.
  [[nodiscard]] const std::vector<bool>& matched() const { return matched_; }
  /// Triangles that arrived so far.
  [[nodiscard]] virtual std::uint64_t triangles() const = 0;

  /// The stream breaks its own rules: the reader is broken.
  struct StreamDamaged {
    std::string how;
  };
  /// More than content_bytes arrived.
  struct ContentTooLarge {};
  /// What the reader itself says is wrong with the file.
  struct Failure {
    std::string sentence;
  };

 protected:
  /// Takes a frame of content. Throws StreamDamaged for kinds that have no place in this reading.
  virtual void take_content(FrameKind kind, std::span<const std::byte> payload) = 0;
  /// The content is complete: throws StreamDamaged unless the totals are those that arrived.
  virtual void finish_content(const Totals& totals) = 0;

  void count_bytes(std::size_t bytes);
  ImportReport& report_;

 private:
  void handle(const FrameHeader& header, std::span<const std::byte> payload);
  void take_hello(PayloadReader& fields);
  void take_left_out(PayloadReader& fields);
  void take_end(PayloadReader& fields);
  [[nodiscard]] std::string spelt(std::string sentence) const;

  std::size_t ignore_patterns_;
  std::uint64_t content_bytes_left_;
  // Bytes that arrived and are not taken yet; frames are taken from where they lie.
  std::unique_ptr<std::byte[]> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  std::uint32_t next_number_ = 0;
  bool ended_ = false;
  std::uint64_t bytes_read_ = 0;
  std::vector<bool> matched_;
  std::vector<std::string> opened_;
  std::string readers_name_, users_name_;
};

}  // namespace roam::reader
