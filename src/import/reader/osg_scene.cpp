#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "import/reader/display/pages.h"
#include "import/reader/formats.h"
#include "import/reader/osg_files.h"
#include "import/reader/scene_graph.h"
#include "roam/error.h"

namespace roam::reader {

void read_osg(const std::filesystem::path& path, MeshSink& sink) {
  prepare_osg(sink, sink.parts() != nullptr);
  const std::filesystem::path file = std::filesystem::absolute(path);
  const osg::ref_ptr<osg::Node> root = read_osg_file(file, true);
  if (root == nullptr) {
    const std::string complaint = last_osg_complaint();
    throw Error(
        fmt::format("{}: OpenSceneGraph cannot read this file{}; it is damaged, or not of the format that its "
                    "name says.",
                    path.string(), complaint.empty() ? "" : " (" + complaint + ")"));
  }
  if (sink.parts() != nullptr && refers_to_pages(*root, file)) {
    Pages pages(sink);
    if (pages.add(*root, file)) return pages.send();
  }
  SceneGraphWalk walk(sink);
  walk.walk(*root, file);
}

}  // namespace roam::reader
