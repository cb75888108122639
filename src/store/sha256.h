#pragma once
/// \file
/// SHA-256 of data that comes piece by piece.

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // of OpenSSL

namespace roam::store {

class Sha256 {
 public:
  Sha256();
  void add(std::span<const std::byte> bytes);
  /// 64 hexadecimal digits of all bytes added. May be called once.
  [[nodiscard]] std::string digits();

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

/// HMAC-SHA256, 64 hexadecimal digits.
[[nodiscard]] std::string hmac_sha256(std::span<const std::byte> key, std::span<const std::byte> text);
/// Whether two texts are equal. The time does not depend on where they differ.
[[nodiscard]] bool same_digits(std::string_view a, std::string_view b);

}  // namespace roam::store
