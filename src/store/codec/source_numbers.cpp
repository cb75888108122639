#include <zstd.h>

#include <algorithm>
#include <array>

#include "roam/error.h"
#include "store/codec/frame.h"
#include "store/codec/magnitude.h"
#include "store/codec/tile_codec.h"

namespace roam::store {
namespace {

/// The letter of a number that is stored in full: its part is another, or the difference needs more than 32 bits.
constexpr std::uint32_t jump = 255;

enum NumberStream : std::uint8_t { part_stream, letter_count, jump_stream, bit_stream, number_stream_count };

constexpr std::size_t bytes_of_part = 8;

[[noreturn]] void refuse() { throw Error("the source numbers of a tile are damaged: repair the store"); }

}  // namespace

std::vector<std::byte> encode_numbers(std::span<const SourceNumber> numbers) {
  std::array<std::vector<std::byte>, number_stream_count> streams;
  std::vector<std::uint64_t> parts;
  BitWriter bits;
  SourceNumber last;
  for (const SourceNumber& n : numbers) {
    const auto difference = static_cast<std::int64_t>(n.number - last.number);
    if (!parts.empty() && n.part == last.part && difference == static_cast<std::int32_t>(difference)) {
      const std::uint32_t z = zigzag(static_cast<std::uint32_t>(difference));
      const std::uint32_t c = class_of(z);
      streams[letter_count].push_back(std::byte(c));
      bits.put(z - base_of(c), bits_of(c));
    } else {
      std::size_t part = static_cast<std::size_t>(std::find(parts.begin(), parts.end(), n.part) - parts.begin());
      if (part == parts.size()) {
        parts.push_back(n.part);
        for (std::size_t b = 0; b < bytes_of_part; ++b) streams[part_stream].push_back(std::byte(n.part >> (8 * b) & 255U));
      }
      streams[letter_count].push_back(std::byte(jump));
      append_number(streams[jump_stream], part);
      append_number(streams[jump_stream], n.number);
    }
    last = n;
  }
  streams[bit_stream] = bits.finish();
  std::vector<std::byte> coded;
  for (const NumberStream s : {part_stream, jump_stream, bit_stream}) append_number(coded, streams[s].size());
  append_frame(coded, streams);
  return coded;
}

std::vector<SourceNumber> decode_numbers(std::span<const std::byte> coded, std::uint32_t triangles) {
  std::uint64_t part_bytes = 0, jump_bytes = 0, bit_bytes = 0;
  for (std::uint64_t* n : {&part_bytes, &jump_bytes, &bit_bytes}) {
    if (!read_number(coded, 28, *n)) refuse();
  }
  // An upper bound for any tile's numbers, so that hostile bytes cannot make this allocate without limit.
  const std::uint64_t most = most_number_bytes(triangles);
  const std::uint64_t size = part_bytes + triangles + jump_bytes + bit_bytes;
  if (size > most || part_bytes % bytes_of_part != 0 || !is_one_frame(coded)) refuse();
  std::vector<std::byte> raw(size + 2 * sizeof(std::uint64_t));  // bits are read in words
  if (ZSTD_decompress(raw.data(), size, coded.data(), coded.size()) != size) refuse();
  const std::byte *parts = raw.data(), *letters = parts + part_bytes;
  std::span<const std::byte> jumps(letters + triangles, jump_bytes);
  BitReader bits(jumps.data() + jump_bytes, bit_bytes);

  std::vector<SourceNumber> numbers(triangles);
  SourceNumber last;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const auto letter = std::to_integer<std::uint32_t>(letters[i]);
    if (letter == jump) {
      std::uint64_t part = 0;
      if (!read_number(jumps, 28, part) || part >= part_bytes / bytes_of_part || !read_number(jumps, 64, last.number)) {
        refuse();
      }
      last.part = 0;
      for (std::size_t b = 0; b < bytes_of_part; ++b) {
        last.part |= std::to_integer<std::uint64_t>(parts[part * bytes_of_part + b]) << (8 * b);
      }
    } else {
      if (letter >= class_count || i == 0) refuse();
      const std::uint32_t mask = (1U << bits_of(letter)) - 1;
      const std::uint32_t z = base_of(letter) + (static_cast<std::uint32_t>(bits.peek()) & mask);
      bits.skip(bits_of(letter));
      if (!bits.within()) refuse();
      last.number += static_cast<std::uint64_t>(std::int64_t{static_cast<std::int32_t>(unzigzag(z))});
    }
    numbers[i] = last;
  }
  if (!jumps.empty() || !bits.finished()) refuse();
  return numbers;
}

}  // namespace roam::store
