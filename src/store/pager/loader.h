#pragma once
/// \file
/// The threads that read, check and decode the items that the planner chooses.

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "store/pager/names.h"
#include "store/pager/planner.h"

namespace roam::paging {

class Loaders {
 public:
  /// Bytes that one thread needs.
  static constexpr std::size_t cost = store::tile_bytes + (1 << 20);

  /// Throws roam::Error if a thread cannot be started.
  Loaders(std::shared_ptr<const Store> store, std::byte* arena, Planner& planner, Handover& handover, Names& names,
          int count);
  /// Waits until reads in progress have ended; those that wait for the network end at once.
  ~Loaders();

 private:
  struct Tools;
  /// Texts of exceptions. They live as long as the loaders. Their number is limited, because a reader may make a
  /// different text each time.
  class Reasons {
   public:
    [[nodiscard]] const char* keep(const char* text) noexcept;

   private:
    static constexpr std::size_t most = 64;
    std::mutex mutex_;
    std::set<std::string, std::less<>> texts_;
  };

  void run(int number);
  /// Finds names, on a thread of its own: a large part takes long, and tiles must not wait for it.
  void run_names();
  void end();
  /// Turns every exception into a failure, like a failed read of the disk.
  [[nodiscard]] Outcome load(const Work& work, Tools& tools) noexcept;
  [[nodiscard]] const char* read(const Work& work, std::span<std::byte> out, Outcome& outcome) const;
  [[nodiscard]] const char* load_tile(const Work& work, Tools& tools, Outcome& outcome) const;
  [[nodiscard]] const char* load_page(const Work& work, Outcome& outcome) const;
  [[nodiscard]] std::optional<std::string> object_name(TriangleId triangle);
  [[nodiscard]] std::optional<std::string> reason(TriangleId triangle);
  void mark(int number, Clock::time_point since);

  std::shared_ptr<const Store> store_;
  std::byte* arena_;
  Handover& handover_;
  Names& names_;
  Reasons reasons_;
  std::mutex planning_;
  Planner& planner_;  ///< under `planning_`
  std::mutex sleeping_;
  std::condition_variable wake_;
  bool stop_ = false;  ///< under `sleeping_`
  std::stop_source ending_;
  std::vector<std::unique_ptr<Tools>> tools_;
  std::vector<std::thread> threads_;  ///< the last one finds names
};

}  // namespace roam::paging
