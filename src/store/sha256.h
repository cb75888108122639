#pragma once
/// \file
/// SHA-256 of what comes piece by piece.

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace roam::store {

class Sha256 {
 public:
  Sha256();
  ~Sha256();
  void add(std::span<const std::byte> bytes);
  /// 64 hexadecimal digits of all that was added. Once.
  [[nodiscard]] std::string digits();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace roam::store
