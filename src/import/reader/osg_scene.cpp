#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "import/reader/display/pages.h"
#include "import/reader/formats.h"
#include "import/reader/osg_files.h"
#include "import/reader/scene_graph.h"
#include "roam/error.h"

namespace roam::reader {

void read_osg(const std::filesystem::path& path, SceneFiles& files, MeshSink& sink) {
  prepare_osg(sink, files, sink.parts() != nullptr);
  const osg::ref_ptr<osg::Node> root = read_osg_file(path, true);
  if (root == nullptr) {
    const std::string complaint = last_osg_complaint();
    throw Error(
        path.string(),
        fmt::format("OpenSceneGraph cannot read this file{}; it is damaged, or not of the format that its name says.",
                    complaint.empty() ? "" : " (" + complaint + ")"));
  }
  if (sink.parts() != nullptr && refers_to_pages(*root, path, files)) {
    Pages pages(sink);
    if (pages.add(*root, path)) return pages.send();
  }
  SceneGraphWalk walk(sink);
  walk.walk(*root, path);
}

}  // namespace roam::reader
