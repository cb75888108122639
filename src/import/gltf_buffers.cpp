#include "import/gltf_buffers.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

namespace roam::reader {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Bytes. A .gltf file that holds its numbers itself may be larger: then there are no buffers to look for.
constexpr std::uintmax_t largest = 256u << 20;

/// "a%20room.bin" -> "a room.bin".
std::string decoded(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char byte = 0;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(&uri[i + 1], &uri[i + 1] + 2, byte, 16).ptr == &uri[i + 1] + 2) {
      text += static_cast<char>(byte);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

}  // namespace

std::vector<fs::path> gltf_buffers(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  std::error_code none;
  const std::uintmax_t bytes = fs::file_size(file, none);
  if (extension != ".gltf" || none || bytes > largest) return {};
  std::ifstream in(file, std::ios::binary);
  const Json json = Json::parse(std::istreambuf_iterator<char>(in), {}, nullptr, false);
  if (!json.is_object() || !json.contains("buffers") || !json["buffers"].is_array()) return {};
  std::vector<fs::path> files;
  for (const Json& buffer : json["buffers"]) {
    if (!buffer.is_object() || !buffer.contains("uri") || !buffer["uri"].is_string()) continue;
    const auto uri = buffer["uri"].get<std::string>();
    if (uri.starts_with("data:")) continue;
    fs::path path = fs::absolute(file.parent_path() / decoded(uri), none).lexically_normal();
    if (fs::is_regular_file(path, none)) files.push_back(std::move(path));
  }
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

}  // namespace roam::reader
