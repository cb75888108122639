#include <zstd.h>

#include <algorithm>
#include <cstring>

#include "roam/error.h"
#include "store/codec/tile_codec.h"

namespace roam::store {

std::vector<std::byte> encode_numbers(std::span<const SourceNumber> numbers) {
  std::vector<std::byte> coded(ZSTD_compressBound(numbers.size_bytes()));
  const std::size_t size = ZSTD_compress(coded.data(), coded.size(), numbers.data(), numbers.size_bytes(), 3);
  if (ZSTD_isError(size) != 0) throw Error("cannot compress source numbers: " + std::string(ZSTD_getErrorName(size)));
  coded.resize(size);
  return coded;
}

std::vector<SourceNumber> decode_numbers(std::span<const std::byte> coded, std::uint32_t triangles) {
  std::vector<SourceNumber> numbers(triangles);
  const std::size_t bytes = numbers.size() * sizeof(SourceNumber);
  if (ZSTD_decompress(numbers.data(), bytes, coded.data(), coded.size()) != bytes) {
    throw Error("the source numbers of a tile are damaged");
  }
  return numbers;
}

}  // namespace roam::store
