#pragma once
/// \file
/// Files of scenes as roam-reader reads them, and its stream as the program takes it, in this process.

#include <cstdint>
#include <functional>
#include <string>

#include "fuzz.h"

namespace fuzz {

enum class Wanted { meshes, pieces, display };

/// The result of a reading.
struct Outcome {
  std::string error;  ///< of roam::Error; empty: a scene
  std::uint64_t triangles = 0;
  std::uint64_t corners = 0;  ///< hash of all corners in order; of meshes and pieces
};

/// A file in memory for the frames of a reader.
class Stream {
 public:
  Stream();
  [[nodiscard]] int descriptor() const { return descriptor_; }
  void clear() const;
  [[nodiscard]] std::string bytes() const;

 private:
  int descriptor_;
};

/// Reads the file and sends all frames to the stream, as the main function of roam-reader does. `confine` must call its
/// argument, which opens what cannot be opened behind walls.
void read_to(
    const Stream& stream, const std::string& file, Wanted wanted,
    const std::function<void(const std::function<void()>& prepare)>& confine = [](const auto& prepare) { prepare(); });

/// Takes a reader's stream as the program does, and checks all that it gives. Fails if the stream violates the
/// protocol, unless it is `hostile`.
Outcome taken(std::string_view stream, Wanted wanted, bool hostile = false);

/// The counters of coverage of this process; none in programs without coverage.
std::span<std::uint8_t> counters();

}  // namespace fuzz
