#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "import/reader/file_names.h"
#include "import/reader/formats.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// Collects buffers[i].uri while the text is parsed. Keeps nothing else, so size and depth of the text do not matter.
class BufferNames : public nlohmann::json_sax<nlohmann::json> {
 public:
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool string(string_t& text) override {
    if (depth_ == depth_of_uri && in_buffers_ && is_uri_ && !text.starts_with("data:")) names_.push_back(text);
    return true;
  }
  bool start_object(std::size_t) override { return ++depth_ > 0; }
  bool end_object() override { return --depth_ >= 0; }
  bool start_array(std::size_t) override { return ++depth_ > 0; }
  bool end_array() override { return --depth_ >= 0; }
  bool key(string_t& name) override {
    if (depth_ == 1) in_buffers_ = name == "buffers";
    if (depth_ == depth_of_uri) is_uri_ = name == "uri";
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

 private:
  /// Depth of the key in { "buffers": [ { "uri": ...
  static constexpr long depth_of_uri = 3;

  long depth_ = 0;
  bool in_buffers_ = false;
  bool is_uri_ = false;
  std::vector<std::string> names_;
};

}  // namespace

void list_gltf_buffers(const fs::path& path, SceneFiles& files, MeshSink& sink) {
  std::ifstream in(files.open(path), std::ios::binary);
  BufferNames buffers;
  // Damage further on in the text is reported when the file is read.
  nlohmann::json::sax_parse(in, &buffers);
  std::set<fs::path> found;
  for (const std::string& name : buffers.names()) {
    if (fs::path file = files.find(path.parent_path() / unescaped(name)); !file.empty()) found.insert(std::move(file));
  }
  for (const fs::path& file : found) sink.report_file(file.string());
}

}  // namespace roam::reader
