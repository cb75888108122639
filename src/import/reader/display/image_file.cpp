#include "import/reader/display/image_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <osgDB/FileUtils>
#include <osgDB/Options>
#include <osgDB/Registry>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// No texture is larger; an encoded one of this size would not be drawn by any card.
constexpr std::uintmax_t image_bytes_limit = 512u << 20;

/// How encoded images begin, and the plugin that reads them.
struct Signature {
  std::string_view start;
  const char* plugin;
};
constexpr std::array<Signature, 8> signatures{{{"\xff\xd8\xff", "jpeg"},
                                               {"\x89PNG", "png"},
                                               {std::string_view("II*\0", 4), "tiff"},
                                               {std::string_view("MM\0*", 4), "tiff"},
                                               {"DDS ", "dds"},
                                               {"GIF8", "gif"},
                                               {"BM", "bmp"},
                                               {"\x01\xda", "rgb"}}};
/// Formats that do not say what they are, and text; by the extension of the file.
constexpr std::array<std::string_view, 12> by_name{"tga",  "rgb", "rgba", "sgi", "bw",  "int",
                                                   "inta", "pnm", "ppm",  "pgm", "pbm", "hdr"};

std::string extension_of(const std::string& name) {
  std::string extension = fs::path(name).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

std::string plugin_for(const std::string& bytes, const std::string& name) {
  for (const Signature& signature : signatures) {
    if (std::string_view(bytes).starts_with(signature.start)) return signature.plugin;
  }
  const std::string extension = extension_of(name);
  return std::find(by_name.begin(), by_name.end(), extension) == by_name.end() ? "" : extension;
}

/// Percent signs and two digits, as in addresses.
std::string unescaped(const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto digit = [&](std::size_t k) { return std::isxdigit(static_cast<unsigned char>(name[k])) != 0; };
    if (name[i] == '%' && i + 2 < name.size() && digit(i + 1) && digit(i + 2)) {
      text += static_cast<char>(std::stoi(name.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      text += name[i];
    }
  }
  return text;
}

fs::path existing(const fs::path& folder, const fs::path& name) {
  const std::string found =
      osgDB::findFileInPath(name.string(), osgDB::FilePathList{folder.string()}, osgDB::CASE_INSENSITIVE);
  std::error_code none;
  return !found.empty() && fs::is_regular_file(found, none) ? fs::path(found) : fs::path();
}

}  // namespace

fs::path find_image_file(const fs::path& folder, const std::string& written) {
  std::string name = written;
  std::replace(name.begin(), name.end(), '\\', '/');
  if (name.starts_with("file://")) name.erase(0, 7);
  // What remains of an address is on a network.
  if (name.empty() || name.find("://") != std::string::npos) return {};
  std::error_code none;
  std::vector<std::string> spellings{name};
  if (const std::string plain = unescaped(name); plain != name) spellings.push_back(plain);
  for (const std::string& spelling : spellings) {
    if (fs::path(spelling).is_absolute()) {
      if (fs::is_regular_file(spelling, none)) return spelling;
    } else if (fs::path file = existing(folder, spelling); !file.empty()) {
      return file;
    }
    const fs::path last = fs::path(spelling).filename();
    for (const char* place : {"", "textures", "texture", "images", "maps", "materials/textures", "../textures",
                              "../materials/textures", "../images"}) {
      if (fs::path file = existing(folder / place, last); !file.empty()) return file;
    }
  }
  return {};
}

std::string image_bytes(const fs::path& file) {
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return {};
  const auto size = fs::file_size(file, none);
  if (none || size > image_bytes_limit) return {};
  std::string bytes(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return bytes;
}

osg::ref_ptr<osg::Image> decode_image(const std::string& bytes, const std::string& name, bool turn_dds) {
  const std::string plugin = plugin_for(bytes, name);
  if (plugin.empty()) return nullptr;
  osgDB::ReaderWriter* reader = osgDB::Registry::instance()->getReaderWriterForExtension(plugin);
  if (reader == nullptr) return nullptr;
  std::istringstream stream(bytes, std::ios::binary);
  const osg::ref_ptr<osgDB::Options> options = new osgDB::Options(turn_dds ? "dds_flip" : "");
  osgDB::ReaderWriter::ReadResult result = reader->readImage(stream, options.get());
  osg::ref_ptr<osg::Image> image = result.getImage();
  const bool flat = image != nullptr && image->data() != nullptr && image->s() > 0 && image->t() > 0 && image->r() == 1;
  if (!flat) return nullptr;
  image->setFileName(name);
  return image;
}

bool reduce_image(osg::ref_ptr<osg::Image>& image) {
  const int channels = static_cast<int>(osg::Image::computeNumComponents(image->getPixelFormat()));
  const bool bytes = image->getDataType() == GL_UNSIGNED_BYTE && !image->isCompressed() && !image->isMipmap() &&
                     image->r() == 1 && image->getPixelSizeInBits() == 8u * static_cast<unsigned>(channels);
  bool reduced = false;
  while (bytes && std::max(image->s(), image->t()) > image_size_limit) {
    const osg::ref_ptr<osg::Image> half = new osg::Image;
    half->allocateImage(std::max(image->s() / 2, 1), std::max(image->t() / 2, 1), 1, image->getPixelFormat(),
                        GL_UNSIGNED_BYTE, 1);
    half->setInternalTextureFormat(image->getInternalTextureFormat());
    half->setFileName(image->getFileName());
    for (int t = 0; t < half->t(); ++t) {
      const unsigned char* rows[2] = {image->data(0, 2 * t), image->data(0, std::min(2 * t + 1, image->t() - 1))};
      unsigned char* to = half->data(0, t);
      for (int s = 0; s < half->s(); ++s) {
        const int columns[2] = {2 * s * channels, std::min(2 * s + 1, image->s() - 1) * channels};
        for (int c = 0; c < channels; ++c) {
          const int sum =
              rows[0][columns[0] + c] + rows[0][columns[1] + c] + rows[1][columns[0] + c] + rows[1][columns[1] + c];
          *to++ = static_cast<unsigned char>((sum + 2) / 4);
        }
      }
    }
    image = half;
    reduced = true;
  }
  return reduced;
}

}  // namespace roam::reader
