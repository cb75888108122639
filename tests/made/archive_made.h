#pragma once
/// \file
/// Zip archives, made byte by byte.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace roam::test {

/// An entry of an archive in the making.
struct MadeEntry {
  std::string name, content;
  std::uint32_t method = 0;            ///< 0: stored, 8: deflated; others are only stated
  std::uint32_t flags = 0;             ///< 1: encrypted
  std::optional<std::string> data{};   ///< in place of the content packed
  std::optional<std::size_t> place{};  ///< of a local entry that is there already
};

inline std::uint32_t crc32_of(const std::string& bytes) {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    table[i] = i;
    for (int bit = 0; bit < 8; ++bit) table[i] = table[i] >> 1 ^ ((table[i] & 1) != 0 ? 0xedb88320u : 0u);
  }
  std::uint32_t crc = ~0u;
  for (const char byte : bytes) crc = crc >> 8 ^ table[(crc ^ static_cast<unsigned char>(byte)) & 0xff];
  return ~crc;
}

/// The bytes of a number, the lowest first.
inline std::string number_bytes(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i & 0xff);
  return text;
}

/// Blocks of deflate without compression.
inline std::string deflated(const std::string& bytes) {
  constexpr std::size_t most = 65535;
  std::string blocks;
  for (std::size_t at = 0; at == 0 || at < bytes.size(); at += most) {
    const std::string block = bytes.substr(at, most);
    blocks += at + most >= bytes.size() ? '\1' : '\0';
    blocks += number_bytes(block.size(), 2) + number_bytes(~block.size(), 2) + block;
  }
  return blocks;
}

inline std::string packed_data(const MadeEntry& entry) {
  if (entry.data) return *entry.data;
  return entry.method == 8 ? deflated(entry.content) : entry.content;
}

/// The fields that a local header and the directory share.
inline std::string header_of(const MadeEntry& entry) {
  return number_bytes(20, 2) + number_bytes(entry.flags, 2) + number_bytes(entry.method, 2) + number_bytes(0, 4) +
         number_bytes(crc32_of(entry.content), 4) + number_bytes(packed_data(entry).size(), 4) +
         number_bytes(entry.content.size(), 4) + number_bytes(entry.name.size(), 2) + number_bytes(0, 2);
}

/// A local header, the name and the data.
inline std::string local_entry(const MadeEntry& entry) {
  return "PK\3\4" + header_of(entry) + entry.name + packed_data(entry);
}

inline std::string made_archive(const std::vector<MadeEntry>& entries) {
  std::string bytes, directory;
  for (const MadeEntry& entry : entries) {
    directory += "PK\1\2" + number_bytes(20, 2) + header_of(entry) + std::string(10, '\0') +
                 number_bytes(entry.place.value_or(bytes.size()), 4) + entry.name;
    if (!entry.place) bytes += local_entry(entry);
  }
  const std::string count = number_bytes(entries.size(), 2);
  return bytes + directory + "PK\5\6" + number_bytes(0, 4) + count + count + number_bytes(directory.size(), 4) +
         number_bytes(bytes.size(), 4) + number_bytes(0, 2);
}

}  // namespace roam::test
