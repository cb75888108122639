#pragma once
/// \file
/// Feature tables of b3dm and i3dm tiles.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "import/reader/json.h"

namespace roam::reader {

class FeatureTable {
 public:
  /// `text`: the JSON. `binary` must outlive this object. Throws roam::Error at `place` if the JSON is damaged.
  FeatureTable(std::string_view text, std::string_view binary, std::string place);

  /// A member that holds for the whole tile: in the JSON, or three floats in the binary. Unset if there is none.
  [[nodiscard]] std::optional<Vec3> global_vector(const char* name) const;
  [[nodiscard]] std::uint64_t global_count(const char* name) const;
  [[nodiscard]] bool global_flag(const char* name) const;

  /// Values of each feature in the binary.
  struct Values {
    std::string_view bytes;
    unsigned components = 0;
    bool are_floats = false;  ///< else they are u16
    /// Feature `i`, which must be below the count that was passed to each().
    [[nodiscard]] double at(std::uint64_t i, unsigned component) const;
  };
  /// Unset if the table has no such member. Throws roam::Error if it reaches beyond the binary.
  [[nodiscard]] std::optional<Values> each(const char* name, std::uint64_t count, unsigned components,
                                           bool are_floats) const;

 private:
  Json json_;
  std::string_view binary_;
  std::string place_;
};

}  // namespace roam::reader
