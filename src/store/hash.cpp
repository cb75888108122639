#include <openssl/evp.h>
#include <xxhash.h>

#include <array>

#include "roam/error.h"
#include "store/files.h"
#include "store/sha256.h"

namespace roam::store {

struct Sha256::Context {
  EVP_MD_CTX* it = EVP_MD_CTX_new();
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { EVP_MD_CTX_free(it); }
};

Sha256::Sha256() : context_(std::make_unique<Context>()) {
  if (context_->it == nullptr || EVP_DigestInit_ex(context_->it, EVP_sha256(), nullptr) != 1) {
    throw Error("cannot compute SHA-256: the cryptographic library refuses to");
  }
}
Sha256::~Sha256() = default;

void Sha256::add(std::span<const std::byte> bytes) {
  if (EVP_DigestUpdate(context_->it, bytes.data(), bytes.size()) != 1) throw Error("cannot compute SHA-256");
}

std::string Sha256::digits() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (EVP_DigestFinal_ex(context_->it, digest.data(), &size) != 1) throw Error("cannot compute SHA-256");
  static constexpr char hexadecimal[] = "0123456789abcdef";
  std::string text;
  for (unsigned i = 0; i < size; ++i) {
    text += hexadecimal[digest[i] >> 4];
    text += hexadecimal[digest[i] & 15U];
  }
  return text;
}

std::string sha256(std::span<const std::byte> bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.digits();
}

std::uint64_t xxh3(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

}  // namespace roam::store
