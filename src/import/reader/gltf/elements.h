#pragma once
/// \file
/// Elements of a vertex attribute or of indices: glTF's accessors, and what Draco decodes.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "import/reader/gltf/gltf_file.h"
#include "import/reader/json.h"

namespace roam::reader {

/// Whether the integers of an accessor mean 0 to 1, or -1 to 1.
[[nodiscard]] bool is_normalized(const Json& accessor);

class Elements {
 public:
  /// Those of an accessor, e.g. the value of "POSITION". `file` must outlive this object. Throws roam::Error if the
  /// accessor does not lie within its buffers.
  Elements(GltfFile& file, const Json& accessor);
  /// Decoded values, `components` for each element.
  Elements(std::vector<float> values, unsigned components);
  /// Decoded indices.
  explicit Elements(std::vector<std::uint32_t> indices);
  ~Elements() = default;
  Elements(Elements&&) = default;
  Elements& operator=(Elements&&) = default;
  Elements(const Elements&) = delete;
  Elements& operator=(const Elements&) = delete;

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] unsigned components() const { return base_.components; }
  /// Whether the values are stored as floats, not as integers.
  [[nodiscard]] bool are_floats() const;
  /// A component of an element, with quantized and normalized ones as the numbers that they mean; 0 beyond the last
  /// component and beyond the last element.
  [[nodiscard]] double at(std::uint64_t element, unsigned component) const;
  /// The same for indices. A value that is no index gives the largest one.
  [[nodiscard]] std::uint32_t index(std::uint64_t element) const;
  /// The first three components.
  [[nodiscard]] Vec3 vector(std::uint64_t element) const { return {at(element, 0), at(element, 1), at(element, 2)}; }

 private:
  struct Values {
    std::span<const std::byte> bytes{};  ///< empty: all values are zero
    std::uint64_t stride = 0;
    int type = 0;  ///< componentType
    unsigned components = 1;
    bool normalized = false;
    [[nodiscard]] double at(std::uint64_t element, unsigned component) const;
  };
  static std::span<const std::byte> within(GltfFile& file, const Json& view, const Json& offset, std::uint64_t count,
                                           std::uint64_t element_bytes, std::uint64_t& stride);
  void read_sparse(GltfFile& file, const Json& sparse);

  std::uint64_t count_ = 0;
  Values base_, replacing_;
  std::unordered_map<std::uint64_t, std::uint64_t> replaced_;  ///< element -> element of replacing_
  std::vector<float> own_;                                     ///< the bytes of base_, if they were decoded
  std::vector<std::uint32_t> own_indices_;
};

}  // namespace roam::reader
