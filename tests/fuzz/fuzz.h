#pragma once
/// \file
/// Common parts of the fuzz targets. Each target tries to break one promise about one kind of input.
///
///     test_fuzz --target=obj --seeds=FOLDER [LIBFUZZER OPTIONS] FOLDER...
///
/// `--seeds` writes the target's seeds into the folder, and its dictionary beside it, as FOLDER.words (-dict).

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace fuzz {

using Bytes = std::span<const std::uint8_t>;

struct Target {
  std::string_view name;
  /// Ends the process by fail() if the promise is broken.
  void (*run)(Bytes input);
  /// Inputs made by our own writers. The first is accepted by the code under test.
  std::vector<std::string> (*seeds)();
  /// The dictionary: words of the format.
  std::vector<std::string_view> words{};
};

/// All targets. A file of targets adds its own by objects of type Known.
std::vector<Target>& targets();
struct Known {
  explicit Known(Target target) { targets().push_back(std::move(target)); }
};

/// Reports a broken promise and ends the process.
[[noreturn]] void fail(const std::string& what);
inline void demand(bool holds, const char* what) {
  if (!holds) fail(what);
}

/// Runs `use`. Returns the message of its roam::Error, or nothing; fails if that is empty or has control characters,
/// and for every other exception.
std::string complaint_of(void (*use)(const void*), const void* context);
template <class Use>
std::string complaint(const Use& use) {
  return complaint_of([](const void* context) { (*static_cast<const Use*>(context))(); }, &use);
}

/// The folder of this process for files. It is in memory if the system has such a folder, and removed at the end.
const std::string& folder();
/// Writes a file in folder(). Returns its path.
std::string write(const std::string& name, std::string_view content);

inline std::string_view text_of(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
inline std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Reads values from an input. Behind its end all are zero.
class Values {
 public:
  explicit Values(Bytes rest) : rest_(rest) {}

  template <class T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    const std::size_t size = rest_.size() < sizeof(T) ? rest_.size() : sizeof(T);
    if (size > 0) std::memcpy(&value, rest_.data(), size);
    rest_ = rest_.subspan(size);
    return value;
  }
  Bytes take(std::size_t count) {
    const Bytes taken = rest_.first(count < rest_.size() ? count : rest_.size());
    rest_ = rest_.subspan(taken.size());
    return taken;
  }
  [[nodiscard]] bool empty() const { return rest_.empty(); }
  [[nodiscard]] Bytes rest() const { return rest_; }

 private:
  Bytes rest_;
};

}  // namespace fuzz
