#include "store/web/server.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "process/thread_without_signals.h"
#include "roam/error.h"
#include "store/web/transfer.h"

namespace roam::web {
namespace {

/// Requests under way at once. More would only wait in the server.
constexpr std::size_t most_transfers = 8;

/// Bytes: a range between two wanted ones costs less than a request of its own. Bytes of one request.
constexpr std::uint64_t largest_hole = 32 << 10, largest_request = 1 << 20;

/// A request waits this long for neighbours while others are under way.
constexpr std::chrono::milliseconds for_neighbours{1};

/// s: the pause before the second try, and the longest.
constexpr double first_pause = 0.1, longest_pause = 5.0;

constexpr int most_hops = 5;

constexpr const char* stopped = "it is no longer wanted";
constexpr const char* not_started = "libcurl cannot start the request";

std::chrono::nanoseconds seconds(double s) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(s));
}

}  // namespace

Server::Server(Address address, const Manners& manners)
    : address_(std::move(address)), manners_(manners), multi_(Curl::library().multi_init()) {
  if (multi_ == nullptr) throw std::bad_alloc();
  Curl::library().multi_setopt(multi_, CURLMOPT_MAX_HOST_CONNECTIONS, static_cast<long>(most_transfers));
  try {
    // Libraries of libcurl cause SIGPIPE.
    thread_ = process::thread_without_signals([this] { run(); });
  } catch (const std::system_error&) {
    Curl::library().multi_cleanup(multi_);
    throw Error("cannot start a thread that reads from the web server; end other programs");
  } catch (...) {
    Curl::library().multi_cleanup(multi_);
    throw;
  }
}

Server::~Server() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
    Curl::library().multi_wakeup(multi_);  // under the lock: the thread ends with it
  }
  thread_.join();
}

Answer Server::get(const Wanted& wanted, const std::stop_token& stop) {
  Job job{wanted, stop};
  job.next += wanted.whole ? Clock::duration(0) : for_neighbours;
  const std::stop_callback wake(stop, [this] { Curl::library().multi_wakeup(multi_); });
  std::unique_lock lock(mutex_);
  coming_.push_back(&job);
  Curl::library().multi_wakeup(multi_);
  job.changed.wait(lock, [&] { return job.done; });
  return job.answer;
}

void Server::run() noexcept {
  const Curl& curl = Curl::library();
  for (;;) {
    try {
      {
        const std::lock_guard lock(mutex_);
        if (end_) break;
        std::size_t all = waiting_.size() + coming_.size();
        for (const auto& transfer : active_) all += transfer->jobs.size();
        waiting_.reserve(all);  // settle() needs no memory then
        waiting_.insert(waiting_.end(), coming_.begin(), coming_.end());
        coming_.clear();
      }
      drop_stopped();
      start_all();
      int running = 0;
      curl.multi_perform(multi_, &running);
      end_complete();
      collect();
      drop_ended();
    } catch (const std::exception&) {
      std::vector<Job*> coming;
      {
        const std::lock_guard lock(mutex_);
        coming.swap(coming_);
      }
      for (const std::vector<Job*>* lost : {&waiting_, &coming}) {
        for (Job* job : *lost) end(*job, {no_memory});
      }
      waiting_.clear();
    }
    curl.multi_poll(multi_, nullptr, 0, pause(), nullptr);
  }
  active_.clear();
  curl.multi_cleanup(multi_);  // here, where signals are blocked
}

/// Milliseconds until there is something to do, unless the network or a caller has something before.
int Server::pause() const {
  Clock::time_point next = Clock::now() + std::chrono::seconds(1);
  if (active_.size() < most_transfers) {
    for (const Job* job : waiting_) next = std::min(next, job->next);
  }
  const auto wait = std::chrono::ceil<std::chrono::milliseconds>(next - Clock::now()).count();
  return static_cast<int>(std::max<std::int64_t>(wait, 0));
}

void Server::end(Job& job, const Answer& answer) {
  const std::lock_guard lock(mutex_);
  job.answer = answer;
  job.done = true;
  job.changed.notify_one();  // under the lock: the job goes as soon as its thread has it
}

void Server::drop_stopped() {
  const auto is_stopped = [](const Job* job) { return job->stop.stop_requested(); };
  std::erase_if(waiting_, [&](Job* job) {
    if (!is_stopped(job)) return false;
    end(*job, {stopped});
    return true;
  });
  active_.remove_if([&](const std::unique_ptr<Transfer>& transfer) {
    if (std::none_of(transfer->jobs.begin(), transfer->jobs.end(), is_stopped)) return false;
    Curl::library().multi_remove_handle(multi_, transfer->handle.get());
    for (Job* job : transfer->jobs) {
      if (is_stopped(job)) {
        end(*job, {stopped});
      } else {
        waiting_.push_back(job);
      }
    }
    return true;
  });
}

/// Transfers of which nothing more is wanted.
void Server::drop_ended() {
  active_.remove_if([&](const std::unique_ptr<Transfer>& transfer) {
    if (!transfer->jobs.empty()) return false;
    Curl::library().multi_remove_handle(multi_, transfer->handle.get());
    return true;
  });
}

void Server::start_all() {
  while (active_.size() < most_transfers) {
    const auto now = Clock::now();
    Job* first = nullptr;
    for (Job* job : waiting_) {
      const bool due = job->next <= now || (active_.empty() && job->tries == 0);
      if (due && (!first || job->begin < first->begin)) first = job;
    }
    if (!first) return;
    std::vector<Job*> jobs{first};
    std::uint64_t begin = first->wanted.offset, last = first->end();
    // Neighbours on both sides, as long as there are any.
    for (bool grown = !first->wanted.whole; grown;) {
      grown = false;
      for (Job* job : waiting_) {
        if (job->wanted.whole || job->wanted.file != first->wanted.file ||
            std::find(jobs.begin(), jobs.end(), job) != jobs.end()) {
          continue;
        }
        const std::uint64_t from = std::min(begin, job->wanted.offset), to = std::max(last, job->end());
        const bool near = job->wanted.offset <= last + largest_hole && begin <= job->end() + largest_hole;
        if (!near || to - from > largest_request || job->next > now + for_neighbours) continue;
        jobs.push_back(job);
        begin = from;
        last = to;
        grown = true;
      }
    }
    std::sort(jobs.begin(), jobs.end(), [](const Job* a, const Job* b) { return a->wanted.offset < b->wanted.offset; });
    start(std::move(jobs));
  }
}

void Server::start(std::vector<Job*>&& jobs) {
  const std::string address = address_.of(jobs.front()->wanted.file);
  const std::vector<Job*> started = jobs;
  active_.push_back(std::make_unique<Transfer>(std::move(jobs), address, manners_));
  std::erase_if(waiting_, [&](Job* job) { return std::find(started.begin(), started.end(), job) != started.end(); });
  if (Curl::library().multi_add_handle(multi_, active_.back()->handle.get()) != CURLM_OK) {
    for (Job* job : started) end(*job, {not_started});
    active_.pop_back();
  }
}

/// Over a slow line the last tile of a request comes long after the first.
void Server::end_complete() {
  for (const auto& transfer : active_) {
    std::erase_if(transfer->jobs, [&](Job* job) {
      if (!transfer->has_all(*job)) return false;
      end(*job, {});
      return true;
    });
  }
}

void Server::collect() {
  int left = 0;
  while (const CURLMsg* const message = Curl::library().multi_info_read(multi_, &left)) {
    if (message->msg != CURLMSG_DONE) continue;
    const CURLcode result = message->data.result;
    CURL* const handle = message->easy_handle;
    const auto at = std::find_if(active_.begin(), active_.end(),
                                 [&](const auto& transfer) { return transfer->handle.get() == handle; });
    Curl::library().multi_remove_handle(multi_, handle);
    if (at == active_.end()) continue;
    bool is_over = true;
    const char* problem = nullptr;
    try {
      is_over = settle(**at, result);
      if (!is_over && Curl::library().multi_add_handle(multi_, handle) != CURLM_OK) problem = not_started;
    } catch (const std::exception&) {
      problem = no_memory;  // for its redirect: no job has ended
    }
    if (problem) {
      for (Job* job : (*at)->jobs) end(*job, {problem});
    }
    if (is_over || problem) active_.erase(at);
  }
}

bool Server::settle(Transfer& transfer, int code) {
  const auto result = static_cast<CURLcode>(code);
  if (const std::string to = transfer.redirected(); !to.empty() && transfer.hops < most_hops) {
    const bool only_secured = Address::is_secured(transfer.address, to);
    const bool follows = manners_.redirects && Address::is_one(to) &&
                         (to.starts_with("https:") || !transfer.address.starts_with("https:"));
    if (only_secured && transfer.hops == 0) address_.secure();
    if (only_secured || follows) {
      transfer.redirect(to);
      return false;
    }
  }
  const Answer answer = transfer.answer(result);
  const auto now = Clock::now();
  for (Job* job : transfer.jobs) {
    if (!answer.problem) {
      end(*job, {});
      continue;
    }
    const double share = std::uniform_real_distribution<>(0.5, 1.0)(random_);
    const double own = std::min(longest_pause, first_pause * static_cast<double>(1U << std::min(job->tries, 10)));
    job->wished = std::max(job->wished, now + seconds(transfer.wished_pause()));
    job->next = std::max(now + seconds(share * own), job->wished);
    if (job->tries++ == 0) job->failing = transfer.alive;
    if (!transfer.may_pass(result) || job->next > job->failing + seconds(manners_.patience)) {
      end(*job, answer);
    } else {
      waiting_.push_back(job);
    }
  }
  return true;
}

}  // namespace roam::web
