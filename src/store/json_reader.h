#pragma once
/// \file
/// Reads JSON of a known shape straight into structs, within limits of depth and memory: a text from a stranger costs
/// no more than what is kept of it. Nothing in between is built, and nothing that ends a read allocates.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <variant>

#include "roam/error.h"
#include "roam/math.h"

namespace roam::store {

/// A text, or what is kept of it, takes more memory than it may.
class TooLarge : public Error {
 public:
  TooLarge(const std::string& name, std::uint64_t memory);
};

/// Where something stands in a text: the members that lead to it, '*' for an element of a list, e.g. "shards/*/bytes".
struct JsonPlace {
  static constexpr std::size_t most_depth = 8;

  std::string path;
  std::array<std::uint64_t, most_depth> index{};  ///< in each list that it is in
  std::size_t lists = 0;

  /// Its number in the list that it is in, or, for 1, in the list that this is in.
  [[nodiscard]] std::uint64_t number(std::size_t outward = 0) const {
    return outward < lists ? index[lists - 1 - outward] : 0;
  }
};

/// What is neither a list nor an object; null is std::monostate. A text may be moved away.
using JsonValue = std::variant<std::monostate, bool, std::uint64_t, std::int64_t, double, std::string*>;

/// Takes what a text holds, in its order.
class JsonReader {
 public:
  /// Of `name`, which is for people. `memory`: bytes that what is kept may take.
  JsonReader(std::string name, std::uint64_t memory) : name_(std::move(name)), memory_(memory) {}
  virtual ~JsonReader() = default;
  JsonReader(const JsonReader&) = delete;
  JsonReader& operator=(const JsonReader&) = delete;

  /// Throws TooLarge, roam::Error for what is no JSON or is nested deeper than JsonPlace allows, and what the functions
  /// below throw.
  void read(std::string_view text);

  // Any of these may throw.
  virtual void value(const JsonPlace& at, JsonValue value) = 0;
  virtual void list_begins(const JsonPlace& at) = 0;
  virtual void object_begins(const JsonPlace& at) = 0;
  virtual void object_ends(const JsonPlace& at) = 0;

  /// Counts what is kept from now on. Throws where that is too much.
  void keep(std::uint64_t bytes);
  [[nodiscard]] std::uint64_t kept() const { return kept_; }
  /// Throws: "<name> is damaged: <what>; ..."
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  std::string name_;
  std::uint64_t memory_, kept_ = 0;
};

/// Throws TooLarge, or roam::Error, for a text of which a whole nlohmann::ordered_json would take more than `memory`.
void check_json(std::string_view text, const std::string& name, std::uint64_t memory);

/// Puts the members of one kind of object where they belong, and notes which have come. A list of the members, each by
/// its name and where it goes, is gone through twice: for each value, and, at the end of the object, for what is
/// missing.
class JsonMembers {
 public:
  /// For a value; or, where `value` is null, for a list that begins.
  JsonMembers(JsonReader& reader, std::uint64_t& seen, const char* what, std::string_view member, const JsonPlace& at,
              JsonValue* value)
      : reader_(reader), seen_(seen), what_(what), member_(member), at_(&at), value_(value) {}
  /// For the end of the object.
  JsonMembers(JsonReader& reader, std::uint64_t& seen, const char* what)
      : reader_(reader), seen_(seen), what_(what), ends_(true) {}

  /// Of so many bytes at most.
  void text(const char* name, std::string& out, std::size_t most = std::numeric_limits<std::size_t>::max());
  /// Of so many hexadecimal digits.
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
  /// Whether the value is of this member, of which `parts` values are expected; `part` is its number.
  bool is(const char* name, std::string_view tail = {}, std::uint64_t part = 0, int parts = 1);
  template <class T>
  [[nodiscard]] T& as(const char* name) const;

  JsonReader& reader_;
  std::uint64_t& seen_;  ///< a bit for each value of each member
  const char* what_;
  std::string_view member_;
  const JsonPlace* at_ = nullptr;
  JsonValue* value_ = nullptr;
  bool ends_ = false;
  int bit_ = 0;
};

}  // namespace roam::store
