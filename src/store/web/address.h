#pragma once
/// \file
/// The address of a folder on a web server.

#include <string>
#include <string_view>

namespace roam::web {

class Address {
 public:
  /// Whether a text begins with http:// or https://.
  [[nodiscard]] static bool is_one(std::string_view text);
  /// Takes the address of a folder, perhaps with a query, which is a secret: it is part of no message. Throws
  /// roam::Error for other schemes, names and passwords, and characters that an address cannot hold.
  explicit Address(std::string_view text);

  /// "https://host/dam.roam": without the query.
  [[nodiscard]] const std::string& shown() const { return shown_; }
  /// Without the question mark; empty: none.
  [[nodiscard]] const std::string& query() const { return query_; }
  /// The complete address of a file in the folder.
  [[nodiscard]] std::string of(std::string_view file) const;
  [[nodiscard]] bool is_secure() const { return shown_.starts_with("https:"); }
  /// Whether `other` differs in nothing but the scheme, which is https, and names no port.
  [[nodiscard]] static bool is_secured(std::string_view address, std::string_view other);
  /// From now on https instead of http.
  void secure();

 private:
  std::string shown_, query_;
};

}  // namespace roam::web
