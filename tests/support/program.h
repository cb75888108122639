#pragma once
/// Runs the program under test like a user's shell. The files of a test are in a folder of its own.

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

extern char** environ;

/// The result of a run. `status` is 128 + the signal's number if a signal ended the program, as in a shell.
struct ProgramResult {
  int status = -1;
  std::string out;
  std::string err;
  /// Largest resident memory, kB. Never less than this process's own, because the program starts as its copy.
  long peak = 0;
};

/// Programs obey an interrupt even if the tests run in the background of a shell that ignores it.
inline const bool interrupts_count =
    std::signal(SIGINT, SIG_DFL) != SIG_ERR && std::signal(SIGTERM, SIG_DFL) != SIG_ERR;

struct ProgramOptions {
  std::string input{};         ///< its standard input
  double interrupt_after = 0;  ///< seconds until it gets SIGINT; 0: never
  bool close_output = false;   ///< its standard output has no reader
};

inline ProgramResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                                 const ProgramOptions& options = {}) {
  // An inherited end of a pipe would keep the other end from seeing it closed.
  std::array<int, 2> in{}, out{}, err{};
  for (auto* pipe_ends : {&in, &out, &err}) {
    if (::pipe2(pipe_ends->data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe failed");
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t child = 0;
  const int spawned = posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  for (const int end : {in[0], out[1], err[1]}) ::close(end);
  if (spawned != 0) throw std::runtime_error("cannot run " + program);
  if (options.close_output) ::close(out[0]);
  std::signal(SIGPIPE, SIG_IGN);  // a program that stops reading early is no failure of the test

  ProgramResult result;
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  std::size_t fed = 0;
  bool in_open = true, out_open = !options.close_output, err_open = true, interrupted = options.interrupt_after <= 0;
  std::array<char, 65536> buffer{};
  ::fcntl(in[1], F_SETFL, O_NONBLOCK);
  while (out_open || err_open) {
    if (in_open && fed == options.input.size()) {
      ::close(in[1]);
      in_open = false;
    }
    if (!interrupted && elapsed() >= options.interrupt_after) {
      ::kill(child, SIGINT);
      interrupted = true;
    }
    std::array<pollfd, 3> ends{
        {{in_open ? in[1] : -1, POLLOUT, 0}, {out_open ? out[0] : -1, POLLIN, 0}, {err_open ? err[0] : -1, POLLIN, 0}}};
    ::poll(ends.data(), ends.size(), 20);
    if (in_open && ends[0].revents != 0) {
      const ssize_t put = ::write(in[1], options.input.data() + fed, options.input.size() - fed);
      fed = put > 0 ? fed + static_cast<std::size_t>(put) : (errno == EAGAIN ? fed : options.input.size());
    }
    const auto drain = [&](int fd, short events, bool& open, std::string& text) {
      if (!open || events == 0) return;
      const ssize_t got = ::read(fd, buffer.data(), buffer.size());
      if (got > 0) text.append(buffer.data(), static_cast<std::size_t>(got));
      if (got == 0) open = false;
    };
    drain(out[0], ends[1].revents, out_open, result.out);
    drain(err[0], ends[2].revents, err_open, result.err);
  }
  if (in_open) ::close(in[1]);
  if (!options.close_output) ::close(out[0]);
  ::close(err[0]);
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  result.peak = usage.ru_maxrss;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

#ifdef ROAM_PROGRAM
inline ProgramResult run_roam(const std::vector<std::string>& arguments, const ProgramOptions& options = {}) {
  return run_program(ROAM_PROGRAM, arguments, options);
}
#endif

/// Runs a program that cannot write a byte into any file.
inline ProgramResult run_without_files(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> all{"-c", "ulimit -f 0; exec \"$0\" \"$@\"", program};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return run_program("/bin/sh", all);
}

/// A folder that is empty when a test begins, and removed when it ends.
class TestFolder {
 public:
  TestFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "roam-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder for the test");
    path_ = name;
  }
  ~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
    return file(name);
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream in(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  std::filesystem::path path_;
};

/// Keys of stores are made in a folder of the tests, not of the user who runs them; this also holds for child programs.
inline const TestFolder user_data;
inline const bool has_user_data = ::setenv("XDG_DATA_HOME", user_data.file("").c_str(), 1) == 0;
