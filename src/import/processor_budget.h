#pragma once
/// \file
/// How much processor time a reader may take.

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

namespace roam::reader {

/// Compares what a reader's process computes with what it reads of the scene's files, as the kernel counts both.
class ProcessorBudget {
 public:
  static constexpr double least_seconds = 10.0;
  static constexpr double seconds_per_byte = 3e-6;
  /// About as many as are indexed in least_seconds.
  static constexpr std::uint64_t least_triangles = 20'000'000;
  static constexpr std::uint64_t triangles_per_byte = 4;

  /// Of all that a child computes and reads.
  explicit ProcessorBudget(int process) : process_(process) {}
  /// Of what a child computes and reads from now on.
  [[nodiscard]] static ProcessorBudget from_now_on(int process);

  /// A file of the scene that the reader says it opened. Each counts once, by its bytes, as far as the disk has them.
  void add_file(const std::filesystem::path& file);

  /// Seconds that the process may have used by now.
  [[nodiscard]] double allowed() const;
  /// Seconds that it has used; 0 where the system does not say.
  [[nodiscard]] double used() const;
  /// Triangles that the reader may have sent by now: who takes them computes too.
  [[nodiscard]] std::uint64_t triangles() const;
  /// Bytes of files that `allowed` is for.
  [[nodiscard]] std::uint64_t bytes() const;
  /// Bytes of the files that were opened, whether they have been read or not.
  [[nodiscard]] std::uint64_t file_bytes() const { return file_bytes_; }

 private:
  int process_;
  double used_before_ = 0.0;
  std::uint64_t read_before_ = 0;
  std::uint64_t file_bytes_ = 0;
  std::set<std::pair<std::uint64_t, std::uint64_t>> files_;  ///< device and number
};

}  // namespace roam::reader
