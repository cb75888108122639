#pragma once
/// \file
/// A limit on the processor time of a reader.

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <set>
#include <utility>

namespace roam::reader {

class SceneBudget;

/// Processor seconds of the calling thread.
[[nodiscard]] double processor_seconds();

/// Compares the processor time of a reader with the bytes of the scene's files that it reads, as the kernel counts
/// both.
class ProcessorBudget {
 public:
  static constexpr double least_seconds = 10.0;
  static constexpr double seconds_per_byte = 3e-6;
  /// About as many triangles as can be indexed in least_seconds.
  static constexpr std::uint64_t least_triangles = 20'000'000;
  static constexpr std::uint64_t triangles_per_byte = 4;

  /// Counts from the start of the child.
  explicit ProcessorBudget(int process) : process_(process) {}
  /// Counts from now on.
  [[nodiscard]] static ProcessorBudget from_now_on(int process);

  /// From now on adds the files to those of the scene.
  void share(SceneBudget* scene) { scene_ = scene; }
  /// Adds a file that the reader reports as opened. Each file counts once, by its bytes on the disk.
  void add_file(const std::filesystem::path& file);

  /// Seconds that the process may have used so far.
  [[nodiscard]] double allowed() const;
  /// Seconds that it has used; 0 if unknown.
  [[nodiscard]] double used() const;
  /// Triangles that the reader may have sent so far. They are limited because the receiver's work takes time too.
  [[nodiscard]] std::uint64_t triangles() const;
  /// Bytes of files for which `allowed` is computed.
  [[nodiscard]] std::uint64_t bytes() const;
  /// Bytes of the opened files, whether read or not.
  [[nodiscard]] std::uint64_t file_bytes() const { return file_bytes_; }

 private:
  int process_;
  SceneBudget* scene_ = nullptr;
  double used_before_ = 0.0;
  std::uint64_t read_before_ = 0;
  std::uint64_t file_bytes_ = 0;
  std::set<std::pair<std::uint64_t, std::uint64_t>> files_;  ///< device and inode
};

/// A limit on the processor time of all readers of a scene whose parts are read one by one. The files of the scene
/// count once, however many parts mention them. Thread-safe.
class SceneBudget {
 public:
  /// A reader starts in less than half of it, on a busy machine too.
  static constexpr double seconds_per_file = 0.25;

  /// Adds a file of so many bytes on the disk. Each device and inode counts once.
  void add_file(const std::pair<std::uint64_t, std::uint64_t>& file, std::uint64_t bytes);
  /// Adds an entry of an archive, which begins at that byte, to the number of files. Each counts once.
  void add_entry(const std::filesystem::path& archive, std::uint64_t begin);
  /// Adds the time of a reader. Returns whether the sum is within the limit.
  [[nodiscard]] bool add(double seconds);
  /// Seconds that all readers together may use so far.
  [[nodiscard]] double allowed() const;

 private:
  [[nodiscard]] double allowed_now() const;

  mutable std::mutex mutex_;
  std::set<std::pair<std::uint64_t, std::uint64_t>> files_;
  std::set<std::pair<std::filesystem::path, std::uint64_t>> entries_;
  std::uint64_t file_bytes_ = 0;
  double seconds_ = 0.0;
};

}  // namespace roam::reader
