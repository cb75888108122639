#pragma once
/// \file
/// Files of a folder on a web server, whole or by ranges. One thread has all connections; requests that wait for their
/// turn and lie next to each other in a file become one.

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <random>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "store/web/address.h"

namespace roam::web {

using Clock = std::chrono::steady_clock;

struct Manners {
  bool redirects = false;  ///< follow them to other hosts and folders
  double patience = 20.0;  ///< s: how long a request is tried again, since its first try last brought anything
};

/// The end of a request.
struct Answer {
  /// Null: success. Else the reason, a text of static lifetime.
  const char* problem = nullptr;
  bool missing = false;    ///< the server has no such file
  bool too_large = false;  ///< the file is larger than the limit
};

/// The problem of a range beyond the file's end.
inline constexpr const char* too_short = "the file is shorter than the manifest says; publish the store again";

/// The problem of a server that cannot serve a store.
inline constexpr const char* no_ranges =
    "the web server ignores ranges and sends the whole file; use one that serves ranges, as nginx does";

/// Whether the problem of an Answer may pass, as a broken connection does.
[[nodiscard]] bool may_pass(std::string_view problem);

/// A file to get, or a range of one.
struct Wanted {
  std::string file;                         ///< e.g. "packs/<64 digits>.pack"
  std::uint64_t offset = 0;                 ///< of the range
  std::span<std::byte> out{};               ///< takes the range
  std::vector<std::byte>* whole = nullptr;  ///< takes the whole file; no range then
  std::uint64_t limit = 0;                  ///< bytes of the whole file at most
  bool anew = false;                        ///< from the server itself, not from a cache on the way
};

/// A Wanted on its way, and the thread that waits for it.
struct Job {
  const Wanted& wanted;
  const std::stop_token& stop;
  Clock::time_point begin = Clock::now(), next = begin;  ///< of the next try
  Clock::time_point wished{};                            ///< by the server: no try before
  Clock::time_point failing{};                           ///< the begin of patience, once a try has failed
  int tries = 0;
  Answer answer{};
  bool done = false;
  std::condition_variable changed{};

  [[nodiscard]] std::uint64_t end() const { return wanted.offset + wanted.out.size(); }
};

class Transfer;

class Server {
 public:
  /// Starts the thread. Throws roam::Error if libcurl is not there.
  Server(Address address, const Manners& manners);
  /// No get() may be in progress.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Waits until it is there, cannot be had, or `stop` is requested. Failures that may pass are tried again with
  /// growing pauses. Any thread may call it.
  [[nodiscard]] Answer get(const Wanted& wanted, const std::stop_token& stop = {});

 private:
  void run() noexcept;
  void start_all();
  void start(std::vector<Job*>&& jobs);
  void end_complete();
  void collect();
  /// The end of a transfer; false: it goes on at another address.
  [[nodiscard]] bool settle(Transfer& transfer, int result);
  void drop_stopped();
  void drop_ended();
  void end(Job& job, const Answer& answer);
  [[nodiscard]] int pause() const;

  Address address_;
  Manners manners_;
  void* multi_;  ///< of libcurl
  std::mutex mutex_;
  std::vector<Job*> coming_;  ///< under the mutex
  bool end_ = false;          ///< under the mutex
  // Of the thread.
  std::vector<Job*> waiting_;
  std::list<std::unique_ptr<Transfer>> active_;
  std::minstd_rand random_{std::random_device()()};
  std::thread thread_;
};

}  // namespace roam::web
