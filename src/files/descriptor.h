#pragma once
/// \file
/// Open files of the operating system.

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace roam::files {

/// Calls a system call again when a signal interrupts it.
template <class Call>
auto again(const Call& call) {
  for (;;) {
    const auto result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

/// Calls `call(bytes done)`, which reads or writes some of the rest, until `bytes` are done. Returns the bytes done:
/// less at the end of a file, then errno is 0, or after an error.
template <class Call>
std::size_t fully(std::size_t bytes, const Call& call) {
  std::size_t done = 0;
  while (done < bytes) {
    const auto some = again([&] { return call(done); });
    if (some == 0) errno = 0;
    if (some <= 0) break;
    done += static_cast<std::size_t>(some);
  }
  return done;
}

/// Fills `out` from `offset` on. Returns as fully().
inline std::size_t read_fully(int file, std::uint64_t offset, std::span<std::byte> out) {
  return fully(out.size(), [&](std::size_t done) {
    return ::pread(file, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
  });
}
/// As above, from the place of the descriptor on.
inline std::size_t read_fully(int file, std::span<std::byte> out) {
  return fully(out.size(), [&](std::size_t done) { return ::read(file, out.data() + done, out.size() - done); });
}
inline std::size_t write_fully(int file, std::uint64_t offset, std::span<const std::byte> bytes) {
  return fully(bytes.size(), [&](std::size_t done) {
    return ::pwrite(file, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
  });
}
inline std::size_t write_fully(int file, std::span<const std::byte> bytes) {
  return fully(bytes.size(), [&](std::size_t done) { return ::write(file, bytes.data() + done, bytes.size() - done); });
}

/// A descriptor that closes with this object, which leaves errno as it is.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() {
    if (number_ < 0) return;
    const int error = errno;
    ::close(number_);
    errno = error;
  }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] bool is_open() const { return number_ >= 0; }
  [[nodiscard]] int release() { return std::exchange(number_, -1); }
  void close() { const Descriptor closed(release()); }

 private:
  int number_;
};

}  // namespace roam::files
