#include "import/reader/display/image_file.h"

#include <strings.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <osgDB/Options>
#include <osgDB/Registry>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "files/escaped.h"
#include "import/reader/file_names.h"
#include "import/reader/format_table.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// Upper bound of an image file. No graphics card could draw an image of this encoded size.
constexpr std::uintmax_t image_bytes_limit = 512u << 20;

/// Texels. No graphics card has a larger side, and OpenSceneGraph counts bytes in 32 bits.
constexpr int side_limit = 65535;

/// Whether the texels that the header claims are there. A plugin may have computed their size with an overflow.
bool has_all_texels(const osg::Image& image) {
  if (image.data() == nullptr || image.s() <= 0 || image.t() <= 0 || image.r() != 1) return false;
  if (std::max(image.s(), image.t()) > side_limit) return false;
  const auto texels = static_cast<std::uint64_t>(image.s()) * static_cast<std::uint64_t>(image.t());
  return texels * image.getPixelSizeInBits() / 8 <= image.getTotalSizeInBytes();
}

/// The plugin by the first bytes of the image, else by the extension of its file. Empty if no image format is
/// recognised.
std::string plugin_for(const std::string& bytes, const std::string& name) {
  const std::string extension = extension_of(name);
  std::string_view by_name;
  for (const ImageFormat& image : image_formats) {
    if (!image.start.empty() && std::string_view(bytes).starts_with(image.start)) return std::string(image.plugin);
    if (image.start.empty() && image.extension == extension) by_name = image.plugin;
  }
  return std::string(by_name);
}

/// The entry of a folder with this name, ignoring case; empty if there is none.
fs::path entry_named(const fs::path& folder, const std::string& name) {
  std::error_code none;
  if (fs::exists(fs::symlink_status(folder / name, none))) return folder / name;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    if (strcasecmp(entry.path().filename().c_str(), name.c_str()) == 0) return entry.path();
  }
  return {};
}

/// The scene's file at `name` relative to a folder, ignoring case.
fs::path existing(const SceneFiles& files, const fs::path& folder, const fs::path& name) {
  fs::path place = (folder / name).lexically_normal();
  if (fs::path file = files.find(place); !file.empty()) return file;
  if (!files.resolve(place)) return {};
  // Only the part below the folder is compared without case; folders above it are not the scene's.
  const fs::path inside = place.lexically_relative(folder);
  if (inside.empty() || *inside.begin() == "..") return {};
  place = folder;
  for (const fs::path& part : inside) {
    if (!files.resolve(place)) return {};
    place = entry_named(place, part.string());
    if (place.empty()) return {};
  }
  return files.find(place);
}

/// Folders in which exporters leave images, relative to that of the scene's file.
constexpr std::array<const char*, 9> usual_places{
    "",         "textures", "texture", "images", "maps", "materials/textures", "../textures", "../materials/textures",
    "../images"};

/// Whether a regular file is at `path`, which lies below the parent of `folder`. Does not follow links, because they
/// may lead to a network.
bool is_there_without_links(const fs::path& path, const fs::path& folder) {
  std::error_code none;
  fs::path at = folder.parent_path();
  for (const fs::path& part : path.lexically_relative(at)) {
    if (part == "..") return false;
    at /= part;
    const fs::file_status status = fs::symlink_status(at, none);
    if (at == path) return fs::is_regular_file(status);
    if (!fs::is_directory(status)) return false;
  }
  return false;
}

/// Reports a name without a file in the scene if it refers to a file outside. Searches only the usual places around the
/// scene's folder, because the name itself may lead anywhere.
void report_outside(SceneFiles& files, const fs::path& folder, const fs::path& name) {
  if (!files.resolve(folder / name)) return files.leave_out(folder / name);
  for (const char* place : usual_places) {
    const fs::path file = (folder / place / name.filename()).lexically_normal();
    if (!files.resolve(file) && is_there_without_links(file, folder)) return files.leave_out(file);
  }
}

}  // namespace

fs::path find_image_file(SceneFiles& files, const fs::path& folder, const std::string& written) {
  std::string name = written;
  std::replace(name.begin(), name.end(), '\\', '/');
  if (name.starts_with("file://")) name.erase(0, 7);
  // A name that is still an address refers to a network.
  if (name.empty() || name.find("://") != std::string::npos) return {};
  std::vector<std::string> spellings{name};
  if (const std::string plain = files::unescaped(name); plain != name) spellings.push_back(plain);
  for (const std::string& spelling : spellings) {
    if (fs::path file = existing(files, folder, spelling); !file.empty()) return file;
    const fs::path last = fs::path(spelling).filename();
    for (const fs::path place : usual_places) {
      if (fs::path file = existing(files, folder, place / last); !file.empty()) return file;
    }
  }
  report_outside(files, folder, spellings.back());
  return {};
}

std::string image_bytes(SceneFiles& files, const fs::path& file) {
  const fs::path opened = files.open(file);
  if (const auto entry = files.entry(opened)) {
    return entry->bytes > image_bytes_limit ? std::string() : files.read_entry(opened, entry->bytes).value_or("");
  }
  std::error_code none;
  const auto size = opened.empty() ? 0 : fs::file_size(opened, none);
  if (none || size > image_bytes_limit) return {};
  std::string bytes(size, '\0');
  std::ifstream stream(opened, std::ios::binary);
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
  if (image == nullptr || !has_all_texels(*image)) return nullptr;
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
