#include "store/authentic.h"

#include <algorithm>
#include <span>
#include <vector>

#include "roam/error.h"
#include "store/files.h"

namespace roam::store {
namespace {

/// Limit in bytes of a file of codes: about 1000 codes. No store has more builders.
constexpr std::uint64_t codes_limit = 64 * 1024;
constexpr std::size_t code_digits = 64;
/// A code and a line feed.
constexpr std::size_t code_line = code_digits + 1;
/// Start of the last line of a file with a code.
constexpr std::string_view code_start = "hmac ";

/// `purpose` and `name` state what the code is for, so that it is valid for nothing else.
std::string code(const StoreKey& key, std::string_view purpose, const std::string& name, std::string_view text = {}) {
  std::string all(purpose);
  all.append("\n").append(name).append("\n").append(text);
  return hmac_sha256(key.bytes, std::as_bytes(std::span(all)));
}

std::string code_of_manifest(const StoreKey& key, const std::string& manifest) {
  return code(key, "roam manifest 1", manifest);
}

/// The codes in a file, one per line.
std::vector<std::string> codes_in(const std::vector<std::byte>& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::vector<std::string> codes;
  for (std::size_t at = 0; at + code_line <= text.size(); at += code_line) {
    const std::string_view digits = text.substr(at, code_digits);
    if (!is_digits(digits, code_digits) || text[at + code_digits] != '\n') break;
    codes.emplace_back(digits);
  }
  return codes;
}

}  // namespace

std::string codes_file(const std::string& manifest) { return "codes/" + manifest + ".hmac"; }

bool has_code(StoreBytes& bytes, const std::string& manifest, const StoreKey& key) {
  try {
    const std::string right = code_of_manifest(key, manifest);
    const auto codes = codes_in(bytes.whole(codes_file(manifest), codes_limit));
    return std::any_of(codes.begin(), codes.end(), [&](const std::string& code) { return same_digits(code, right); });
  } catch (const Error&) {
    return false;
  }
}

void add_code(const Folder& store, const std::string& manifest, const StoreKey& key) {
  if (has_code(*files_of(store), manifest, key)) return;
  make_folder_in(store, "codes");
  const std::string file = codes_file(manifest);
  std::string text;
  // A file that is damaged or too large is written anew.
  if (size_of(store, file).value_or(codes_limit) < codes_limit - code_line) {
    for (const std::string& other : codes_in(read_file(store, file, codes_limit))) text += other + "\n";
  }
  write_file(store, file, text + code_of_manifest(key, manifest) + "\n");
}

void write_coded(const Folder& store, const std::string& name, std::string text, const std::optional<StoreKey>& key) {
  if (key) {
    const std::string digits = code(*key, "roam file 1", name, text);
    text.append(code_start).append(digits).append("\n");
  }
  write_file(store, name, text);
}

std::optional<std::string> read_coded(const Folder& store, const std::string& name, std::uint64_t limit,
                                      const std::optional<StoreKey>& key) {
  if (!size_of(store, name)) return std::nullopt;
  const std::vector<std::byte> bytes = read_file(store, name, limit);
  std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  constexpr std::size_t line = code_start.size() + code_line;
  const std::size_t end = text.size() - std::min(text.size(), line);
  const bool has_line = std::string_view(text).substr(end).starts_with(code_start);
  const std::string found = has_line ? text.substr(end + code_start.size(), code_digits) : std::string();
  if (has_line) text.resize(end);
  if (key && !same_digits(found, code(*key, "roam file 1", name, text))) return std::nullopt;
  return text;
}

}  // namespace roam::store
