#pragma once
// roam view without a screen, as a shell sees it.

#include <sys/stat.h>

#include <chrono>
#include <string>
#include <vector>

#include "view_scenes.h"

struct View {
  TestFolder folder;
  std::string scene;
  ProgramResult result;
  double seconds = 0.0;

  explicit View(const std::string& text = room_obj()) : scene(folder.write("scene.obj", text)) {
    use_no_settings(folder);
    unsetenv("ROAM_READER");
  }
  View& run(const std::vector<std::string>& more, const ProgramOptions& options = {}) {
    std::vector<std::string> arguments{"view", scene};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto start = std::chrono::steady_clock::now();
    result = run_program(ROAM_PROGRAM, arguments, options);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return *this;
  }
  /// The same, without a screen, small, with the report.
  View& shot(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"--headless", "--size",       "320x200",
                                       "--json",     "--screenshot", folder.file("shot.png")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(result.out, nullptr, false); }
  [[nodiscard]] Shot picture() const { return Shot(folder.file("shot.png")); }

  /// A reader that does something else; `$0.real` is the true one.
  void set_reader(const std::string& script) const {
    const std::string file = folder.write("reader", "#!/bin/sh\nreal='" ROAM_READER_PROGRAM "'\n" + script);
    ::chmod(file.c_str(), 0755);
    setenv("ROAM_READER", file.c_str(), 1);
  }
};
