#pragma once
/// \file
/// JSON of a store, which a stranger may have written, within limits of depth and memory.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "roam/error.h"

namespace roam::store {

using Json = nlohmann::ordered_json;

/// Thrown when a text, or the data kept from it, takes more memory than allowed.
class TooLarge : public Error {
 public:
  TooLarge(const std::string& name, std::uint64_t memory);
};

/// Counts the memory that a text takes.
class JsonReader {
 public:
  /// `name` of the text, for messages. `memory`: limit of the bytes kept.
  JsonReader(std::string name, std::uint64_t memory) : name_(std::move(name)), memory_(memory) {}

  /// Parses a text; `see` decides which values are kept, as nlohmann's parser_callback_t. Throws TooLarge; roam::Error
  /// if the text is not JSON, nested deeper than 8 lists and objects, or has a token of more than 2^20 bytes; and
  /// whatever `see` throws.
  Json read(std::string_view text, const Json::parser_callback_t& see) const;

  /// Adds to the bytes kept from now on. Throws TooLarge beyond the limit.
  void keep(std::uint64_t bytes);
  [[nodiscard]] std::uint64_t kept() const { return kept_; }
  /// Throws roam::Error: "<name> is damaged: <what>; ..."
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  std::string name_;
  std::uint64_t memory_, kept_ = 0;
};

/// All values of a text. Throws TooLarge before they take more than `memory`, and as JsonReader::read.
[[nodiscard]] Json parse_json(std::string_view text, const std::string& name, std::uint64_t memory);

}  // namespace roam::store
