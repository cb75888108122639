#include <new>
#include <optional>
#include <string>

#include "import/reader/formats.h"
#include "import/reader/gltf/gltf_file.h"
#include "import/reader/gltf/gltf_walk.h"
#include "import/reader/named_file.h"
#include "import/reader/upright.h"
#include "roam/error.h"

namespace roam::reader {

void read_gltf(const std::filesystem::path& path, const std::string& extension, SceneFiles& files, MeshSink& sink) {
  sink.set_format_up(UpAxis::y);
  const std::optional<std::string> bytes = whole_file(files, path);
  if (!bytes) throw Error(path.string(), "this file cannot be read; check its rights.");
  if (is_gltf_1(*bytes)) return read_assimp(path, extension, files, sink);
  GltfFile file(*bytes, path, files);
  if (text(member(file.json(), "asset", "version")).starts_with("1.")) return read_assimp(path, extension, files, sink);
  sink.count_file();
  sink.report_more_progress(bytes->size());
  GltfWalk walk(file, path.stem().string(), sink);
  // The sink turns the file upright. The centre of CESIUM_RTC is upright already.
  const glm::dmat4 upright = upright_from(UpAxis::y);
  walk.walk(glm::transpose(upright), upright);
  walk.finish();
}

}  // namespace roam::reader
