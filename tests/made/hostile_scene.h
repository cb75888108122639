#pragma once
/// A folder with every known way in which an OpenSceneGraph scene has run code of its author. Each way that succeeds
/// leaves a file whose name begins with "PWNED".

#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "program.h"

/// A triangle of 10 m by 10 m at height z.
inline std::string hostile_triangle(const std::string& z) {
  return "Geode {\nnum_drawables 1\nGeometry {\nPrimitives 1\n{\nDrawArrays TRIANGLES 0 3\n}\nVertexArray Vec3Array "
         "3\n{\n0 0 " +
         z + "\n10 0 " + z + "\n0 10 " + z + "\n}\n}\n}\n";
}

inline std::string hostile_group(const std::vector<std::string>& children) {
  std::string text = "Group {\nnum_children " + std::to_string(children.size()) + "\n";
  for (const std::string& child : children) text += child;
  return text + "}\n";
}

/// A node that refers to another file.
inline std::string proxy_of(const std::string& file) {
  return "ProxyNode {\nCenter 0 0 0\nRadius 10\nFileNameList 1 {\n\"" + file + "\"\n}\nnum_children 0\n}\n";
}

/// A triangle that a file replaces when the eye is near.
inline std::string page_of(const std::string& file) {
  return "PagedLOD {\nCenter 0 0 0\nRadius 30\nRangeList 2 {\n1e+9 1e+10\n0 1e+9\n}\nFileNameList 2 {\n\"\"\n\"" +
         file + "\"\n}\nnum_children 1\n" + hostile_triangle("0") + "}\n";
}

/// Names that a scene may refer to, and the effect of each.
inline std::vector<std::string> hostile_names() {
  return {"evil.lua", "x;touch PWNED-by-tgz;.tgz", "x;touch PWNED-by-zip;.zip", "a.xyz", "a.osg.xyz.curl"};
}

/// Writes the targets of these names, and libraries in the places where OpenSceneGraph has searched for them.
inline void write_bait(const std::string& folder, const std::string& library) {
  namespace fs = std::filesystem;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(fs::path(folder) / name, std::ios::binary) << text;
  };
  fs::create_directories(fs::path(folder) / "osgPlugins-3.6.5");
  write("evil.lua", "os.execute('touch PWNED-by-lua')\n");
  write("x;touch PWNED-by-tgz;.tgz", "");
  write("x;touch PWNED-by-zip;.zip", "");
  write("a.xyz", "");
  for (const char* name : {"osgPlugins-3.6.5/osgdb_xyz.so", "osgPlugins-3.6.5/osgdb_serializers_xyz.so",
                           "osgPlugins-3.6.5/osgdb_deprecated_xyz.so", "osgPlugins-3.6.5/osgdb_curl.so", "libxyz.so"}) {
    fs::copy_file(library, fs::path(folder) / name, fs::copy_options::overwrite_existing);
  }
}

/// The files that a hostile scene has left below a folder.
inline std::vector<std::string> marks_in(const std::string& folder) {
  std::vector<std::string> marks;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("PWNED")) marks.push_back(name);
  }
  return marks;
}

/// A word, quoted for a shell.
inline std::string quoted(const std::string& text) { return "'" + text + "'"; }

/// A system call that `strace -f` saw.
struct TracedCall {
  std::string process;
  std::string text;
};

/// The calls of a trace. A call that another process's interrupted stands in two lines there.
inline std::vector<TracedCall> traced_calls(const std::string& trace) {
  std::vector<TracedCall> calls;
  std::map<std::string, std::string> unfinished;
  std::istringstream lines(trace);
  for (std::string line; std::getline(lines, line);) {
    const std::string process = line.substr(0, line.find(' '));
    std::string text = line.substr(line.find_first_not_of(' ', process.size()));
    if (const auto end = text.find(" <unfinished ...>"); end != std::string::npos) {
      unfinished[process] = text.substr(0, end);
      continue;
    }
    if (text.starts_with("<... ")) text = unfinished[process] + text;
    calls.push_back({process, text});
  }
  return calls;
}

inline bool can_trace() { return run_program("/bin/sh", {"-c", "strace -o /dev/null true"}).status == 0; }
