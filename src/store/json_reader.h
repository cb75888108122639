#pragma once
/// \file
/// Reader of JSON of a known shape, straight into structs, within limits of depth and memory. An untrusted text costs
/// no more than the data kept from it. No tree is built in between.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <variant>

#include "roam/error.h"
#include "roam/math.h"

namespace roam::store {

using Json = nlohmann::ordered_json;

/// Thrown when a text, or the data kept from it, takes more memory than allowed.
class TooLarge : public Error {
 public:
  TooLarge(const std::string& name, std::uint64_t memory);
};

/// Position in a text: the path of members, with '*' for an element of a list, e.g. "shards/*/bytes".
struct JsonPlace {
  static constexpr std::size_t most_depth = 8;

  std::string path;
  std::array<std::uint64_t, most_depth> index{};  ///< index in each enclosing list
  std::size_t lists = 0;

  /// Its index in the innermost list; for outward = 1, that list's index in the next one.
  [[nodiscard]] std::uint64_t number(std::size_t outward = 0) const {
    return outward < lists ? index[lists - 1 - outward] : 0;
  }
};

/// A value that is neither a list nor an object; null is std::monostate. A string may be moved from.
using JsonValue = std::variant<std::monostate, bool, std::uint64_t, std::int64_t, double, std::string*>;

/// Receives the contents of a text in order.
class JsonReader {
 public:
  /// `name` of the text, for messages. `memory`: limit of the bytes kept.
  JsonReader(std::string name, std::uint64_t memory) : name_(std::move(name)), memory_(memory) {}
  virtual ~JsonReader() = default;
  JsonReader(const JsonReader&) = delete;
  JsonReader& operator=(const JsonReader&) = delete;

  /// Throws TooLarge; roam::Error if the text is not JSON or nested deeper than JsonPlace allows; and whatever the
  /// functions below throw.
  void read(std::string_view text);

  // Callbacks; each may throw.
  virtual void value(const JsonPlace& at, JsonValue value) = 0;
  virtual void list_begins(const JsonPlace& at) = 0;
  virtual void object_begins(const JsonPlace& at) = 0;
  virtual void object_ends(const JsonPlace& at) = 0;

  /// Adds to the bytes kept from now on. Throws TooLarge beyond the limit.
  void keep(std::uint64_t bytes);
  [[nodiscard]] std::uint64_t kept() const { return kept_; }
  /// Throws roam::Error: "<name> is damaged: <what>; ..."
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  std::string name_;
  std::uint64_t memory_, kept_ = 0;
};

/// All values of a text. Throws TooLarge if they would take more than `memory`, and roam::Error if it is not JSON.
/// For builders: the destructor of a tree allocates, and ends the program where that fails.
[[nodiscard]] Json parse_json(std::string_view text, const std::string& name, std::uint64_t memory);

/// Stores the members of one kind of object and notes which have come. The caller passes through a list of all members,
/// each with its name and destination: once for each value, and once at the end of the object, to find missing ones.
class JsonMembers {
 public:
  /// For a value; if `value` is null, for the beginning of a list.
  JsonMembers(JsonReader& reader, std::uint64_t& seen, const char* what, std::string_view member, const JsonPlace& at,
              JsonValue* value)
      : reader_(reader), seen_(seen), what_(what), member_(member), at_(&at), value_(value) {}
  /// For the end of the object.
  JsonMembers(JsonReader& reader, std::uint64_t& seen, const char* what)
      : reader_(reader), seen_(seen), what_(what), ends_(true) {}

  /// A text of at most `most` bytes.
  void text(const char* name, std::string& out, std::size_t most = std::numeric_limits<std::size_t>::max());
  /// A text of `count` hexadecimal digits.
  void digits(const char* name, std::size_t count, std::string& out);
  void hash(const char* name, std::uint64_t& out);  ///< 16 digits
  void whole(const char* name, std::uint64_t& out);
  void whole(const char* name, std::uint32_t& out);
  void number(const char* name, double& out);
  void truth(const char* name, bool& out);
  void box(const char* name, Box& out);
  void list(const char* name);
  [[noreturn]] void bad(const char* name) const;

 private:
  /// Whether the value belongs to this member, which expects `parts` values; `part` is the index of this one.
  bool is(const char* name, std::string_view tail = {}, std::uint64_t part = 0, int parts = 1);
  template <class T>
  [[nodiscard]] T& as(const char* name) const;

  JsonReader& reader_;
  std::uint64_t& seen_;  ///< one bit for each value of each member
  const char* what_;
  std::string_view member_;
  const JsonPlace* at_ = nullptr;
  JsonValue* value_ = nullptr;
  bool ends_ = false;
  int bit_ = 0;
};

}  // namespace roam::store
