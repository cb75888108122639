#include "import/reader/display/textures.h"

#include <fmt/format.h>

#include <utility>

#include "import/reader/display/image_file.h"
#include "import/reader/display/texels.h"
#include "roam/error.h"
#include "roam/import.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

std::string key_of(std::string_view kind, const std::string& name, Wrapping wrapping) {
  return fmt::format("{} {} {} {}", kind, static_cast<int>(wrapping.across), static_cast<int>(wrapping.up), name);
}

}  // namespace

TextureId Textures::add(const std::string& key, Source&& source) {
  const auto [at, is_new] = known_.try_emplace(key, static_cast<TextureId>(sources_.size()));
  if (is_new) {
    source.first = at->second;
    sources_.push_back(std::move(source));
  }
  return at->second;
}

TextureId Textures::add_file(const fs::path& folder, const std::string& name, Wrapping wrapping) {
  Source source{name, {}, nullptr, wrapping};
  source.find = [this, folder, name] { return find_image_file(files_, folder, name); };
  return add(key_of("name", (folder / name).string(), wrapping), std::move(source));
}

TextureId Textures::first_of(TextureId id) {
  Source& source = sources_.at(id);
  if (const auto find = std::exchange(source.find, {})) {
    const fs::path file = find();
    if (file.empty()) return source.first;
    source.decode = [this, file] { return decode_image(image_bytes(files_, file), file.string(), true); };
    source.first = known_.try_emplace(key_of("file", file.string(), source.wrapping), id).first->second;
  }
  return source.first;
}

TextureId Textures::add_encoded(const std::string& key, std::function<std::string()> read, Wrapping wrapping) {
  const auto decode = [key, read = std::move(read)] { return decode_image(read(), key, true); };
  return add(key_of("inside", key, wrapping), {key, decode, nullptr, wrapping});
}

TextureId Textures::add_image(osg::Image& image, Wrapping wrapping) {
  const std::string key = key_of("image", fmt::format("{}", fmt::ptr(&image)), wrapping);
  return add(key, {image.getFileName(), {}, &image, wrapping});
}

void Textures::leave_out_generated() {
  if (std::exchange(left_out_generated_, true)) return;
  frames_.send(FrameKind::note, PayloadWriter().add_text(
                                    "Images with generated coordinates (TexGen), such as reflections, are not shown."));
}

osg::ref_ptr<osg::Image> Textures::load(TextureId id) {
  Source& source = sources_.at(first_of(id));
  osg::ref_ptr<osg::Image> image = source.image;
  try {
    if (source.decode) image = source.decode();
  } catch (const Error&) {
    // The file does not have the bytes of its image: an absent image, not an absent surface.
  }
  if (image == nullptr || !has_texels(*image)) {
    report_missing(source.name);
    return nullptr;
  }
  if (!std::exchange(source.counted, true)) ++read_;
  const bool reduced = reduce_image(image);
  if (!has_texels(*image)) {
    report_missing(source.name);
    return nullptr;
  }
  if (reduced && !std::exchange(reduced_, true)) {
    frames_.send(FrameKind::note, PayloadWriter().add_text(fmt::format(
                                      "Images of more than {} texels a side are shown smaller.", image_size_limit)));
  }
  return image;
}

void Textures::forget_images() {
  for (Source& source : sources_) source.image = nullptr;
  found_.clear();
  spelt_.clear();
  // Another image may later have the same address.
  std::erase_if(known_, [](const auto& entry) { return entry.first.starts_with("image"); });
}

osg::ref_ptr<osg::Image> Textures::find(const fs::path& folder, const std::string& name) {
  const auto [spelt, is_new_name] = spelt_.try_emplace((folder / name).string());
  if (is_new_name) spelt->second = find_image_file(files_, folder, name);
  const fs::path& file = spelt->second;
  const auto [at, is_new] = found_.try_emplace(file.string());
  if (is_new && !file.empty()) at->second = decode_image(image_bytes(files_, file), file.string(), false);
  if (at->second == nullptr) report_missing(name);
  return at->second;
}

void Textures::report_missing(const std::string& name) {
  if (!missing_.insert(name).second || missing_.size() > ImportReport::name_limit) return;
  frames_.send(FrameKind::missing_texture, PayloadWriter().add_text(name));
}

}  // namespace roam::reader
