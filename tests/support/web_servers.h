#pragma once
/// \file
/// Web servers for tests, on free ports of this machine: nginx, and one that misbehaves.

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

extern char** environ;

namespace support {

/// A connection to a port of this machine; -1: nobody listens.
inline int connected(int port) {
  const int made = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(static_cast<std::uint16_t>(port));
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(made, reinterpret_cast<const sockaddr*>(&place), sizeof place) == 0) return made;
  ::close(made);
  return -1;
}

inline int free_port() {
  const int made = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof place;
  ::bind(made, reinterpret_cast<const sockaddr*>(&place), size);
  ::getsockname(made, reinterpret_cast<sockaddr*>(&place), &size);
  ::close(made);
  return ntohs(place.sin_port);
}

/// A GET without any library. Returns head and body.
inline std::string got(int port, const std::string& path) {
  const int to = connected(port);
  const std::string request = "GET " + path + " HTTP/1.0\r\n\r\n";
  if (to < 0 || ::write(to, request.data(), request.size()) < 0) return {};
  std::string all;
  std::array<char, 4096> piece;
  for (ssize_t n = 0; (n = ::read(to, piece.data(), piece.size())) > 0;) {
    all.append(piece.data(), static_cast<std::size_t>(n));
  }
  ::close(to);
  return all;
}

/// A child that ends with this object.
class Child {
 public:
  explicit Child(std::vector<std::string> words) {
    std::array<int, 2> in{}, out{};
    if (::pipe2(in.data(), O_CLOEXEC) != 0 || ::pipe2(out.data(), O_CLOEXEC) != 0) return;
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, in[0], 0);
    ::posix_spawn_file_actions_adddup2(&actions, out[1], 1);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    if (::posix_spawnp(&number_, arguments[0], &actions, nullptr, arguments.data(), environ) != 0) number_ = -1;
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(in[0]);
    ::close(out[1]);
    in_ = in[1];
    out_ = out[0];
  }
  ~Child() {
    ::close(in_);
    ::close(out_);
    if (number_ <= 0) return;
    ::kill(number_, SIGTERM);
    ::waitpid(number_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  [[nodiscard]] std::string line() const {
    std::string text;
    for (char c = 0; ::read(out_, &c, 1) == 1 && c != '\n';) text += c;
    return text;
  }

 private:
  pid_t number_ = -1;
  int in_ = -1, out_ = -1;
};

/// tests/programs/misbehaving_web_server.py
class Misbehaving {
 public:
  /// With a certificate (and its key, in one file) by https.
  explicit Misbehaving(const std::filesystem::path& root, const std::string& certificate = {})
      : secure_(!certificate.empty()), child_(words(root, certificate)), port_(std::atoi(child_.line().c_str())) {
    EXPECT_GT(port_, 0) << "the misbehaving web server needs /usr/bin/python3";
  }
  [[nodiscard]] std::string address(const std::string& mode, const std::string& store = "x.roam") const {
    return fmt::format("{}://127.0.0.1:{}/{}/{}", secure_ ? "https" : "http", port_, mode, store);
  }
  [[nodiscard]] int port() const { return port_; }
  /// Lets go what waits; see there.
  void release(const std::string& what) const { static_cast<void>(got(port_, "/release/" + what)); }
  /// The largest number of requests at once since the last call.
  [[nodiscard]] int most_at_once() const {
    const std::string all = got(port_, "/most");
    return std::atoi(all.c_str() + std::min(all.find("\r\n\r\n") + 4, all.size()));
  }
  /// The requests since the last call: path, range, query, authorization.
  [[nodiscard]] std::vector<std::string> requests() const {
    const std::string all = got(port_, "/log");
    std::istringstream text(all.substr(std::min(all.find("\r\n\r\n") + 4, all.size())));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }

 private:
  static std::vector<std::string> words(const std::filesystem::path& root, const std::string& certificate) {
    std::vector<std::string> all{"/usr/bin/python3", "-B", std::string(TEST_PROGRAMS) + "/misbehaving_web_server.py",
                                 root.string()};
    if (!certificate.empty()) all.push_back(certificate);
    return all;
  }

  bool secure_;
  Child child_;
  int port_;
};

/// nginx, with one worker that this user runs, and all its files in a folder of its own.
class Nginx {
 public:
  static bool is_there() { return std::filesystem::exists("/usr/sbin/nginx"); }
  Nginx(const std::filesystem::path& work, const std::filesystem::path& root)
      : port_(free_port()), child_(started(work, root, port_)) {
    for (int i = 0; i < 500; ++i) {
      if (const int to = connected(port_); to >= 0) {
        ::close(to);
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    ADD_FAILURE() << "nginx does not start: " << work;
  }
  [[nodiscard]] std::string address(const std::string& store = "x.roam") const {
    return fmt::format("http://127.0.0.1:{}/{}", port_, store);
  }

 private:
  static std::vector<std::string> started(const std::filesystem::path& work, const std::filesystem::path& root,
                                          int port) {
    std::filesystem::create_directories(work);
    std::ofstream(work / "nginx.conf") << fmt::format(
        "daemon off; master_process off; pid {0}/pid; error_log {0}/errors;\n"
        "events {{}}\n"
        "http {{ access_log {0}/requests; client_body_temp_path {0}/b; proxy_temp_path {0}/p;\n"
        "  fastcgi_temp_path {0}/f; uwsgi_temp_path {0}/u; scgi_temp_path {0}/s;\n"
        "  server {{ listen 127.0.0.1:{1}; root {2}; }} }}\n",
        std::filesystem::absolute(work).string(), port, std::filesystem::absolute(root).string());
    const std::string folder = std::filesystem::absolute(work).string();
    return {"/usr/sbin/nginx", "-p", folder, "-c", folder + "/nginx.conf", "-e", folder + "/errors"};
  }

  int port_;
  Child child_;
};

}  // namespace support
