#include "children.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace roam::app {
namespace {

/// Whether it is a child of this process, and has not ended.
bool is_running_child(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  // "123 (name) S 99 ...": the name may hold anything, but the last ")" ends it.
  const std::size_t name_end = text.rfind(") ");
  if (name_end == std::string::npos || name_end + 4 >= text.size()) return false;
  const char state = text[name_end + 2];
  pid_t parent = 0;
  std::from_chars(text.data() + name_end + 4, text.data() + text.size(), parent);
  return parent == ::getpid() && state != 'Z';
}

std::vector<pid_t> running_children() {
  std::vector<pid_t> children;
  std::error_code none;
  for (std::filesystem::directory_iterator entry("/proc", none), end; !none && entry != end; entry.increment(none)) {
    const std::string name = entry->path().filename().string();
    pid_t process = 0;
    const auto [rest, problem] = std::from_chars(name.data(), name.data() + name.size(), process);
    if (problem == std::errc() && rest == name.data() + name.size() && is_running_child(process)) {
      children.push_back(process);
    }
  }
  return children;
}

}  // namespace

void end_children(std::chrono::milliseconds grace) {
  std::vector<pid_t> children = running_children();
  for (const pid_t child : children) ::kill(child, SIGTERM);
  const auto until = std::chrono::steady_clock::now() + grace;
  while (std::any_of(children.begin(), children.end(), is_running_child) && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  for (const pid_t child : children) {
    if (is_running_child(child)) ::kill(child, SIGKILL);
  }
}

}  // namespace roam::app
