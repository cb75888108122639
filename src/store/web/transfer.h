#pragma once
/// \file
/// One request to a web server for jobs that lie next to each other in a file, and the check of its answer.

#include <memory>
#include <string>
#include <vector>

#include "store/web/curl_library.h"
#include "store/web/server.h"

namespace roam::web {

inline constexpr const char* no_memory = "there is no memory left to read it";

class Transfer {
 public:
  /// `jobs`: of one file, by ascending offset; or one, of a whole file.
  Transfer(std::vector<Job*>&& jobs, std::string address, const Manners& manners);
  ~Transfer();
  Transfer(const Transfer&) = delete;
  Transfer& operator=(const Transfer&) = delete;

  struct Cleanup {
    void operator()(CURL* handle) const { Curl::library().easy_cleanup(handle); }
  };

  std::vector<Job*> jobs;  ///< that have not ended
  std::unique_ptr<CURL, Cleanup> handle;
  std::string address;                     ///< of the request
  int hops = 0;                            ///< redirects followed
  Clock::time_point alive = Clock::now();  ///< the start, or when bytes of the file came last

  /// Another address, to be requested next.
  void redirect(const std::string& to);
  /// The address that a redirect leads to; empty: it is none.
  [[nodiscard]] std::string redirected() const;
  /// The answer for all jobs that have not got all their bytes. Null: none is missing any.
  [[nodiscard]] Answer answer(CURLcode result) const;
  /// Whether the failure may pass.
  [[nodiscard]] bool may_pass(CURLcode result) const;
  /// Seconds until the next try that the server wishes; 0: none.
  [[nodiscard]] double wished_pause() const;
  [[nodiscard]] bool has_all(const Job& job) const;

 private:
  static std::size_t take_header(char* text, std::size_t one, std::size_t size, void* self) noexcept;
  static std::size_t take_body(char* bytes, std::size_t one, std::size_t size, void* self) noexcept;
  static int keep_from_children(void* self, curl_socket_t socket, curlsocktype type) noexcept;
  void prepare();
  void set_login();
  void header(std::string_view line);
  [[nodiscard]] bool headers_end();
  [[nodiscard]] bool body(std::span<const std::byte> bytes);
  template <class Value>
  void set(CURLoption option, Value value) {
    Curl::library().easy_setopt(handle.get(), option, value);
  }
  /// Why a proxy does not connect to the web server, which its status 4xx says; null: it says nothing.
  [[nodiscard]] const char* refusal_of_proxy() const;
  /// Whether the answer ended before the range that it announced.
  [[nodiscard]] bool is_cut() const { return has_range_ && received_ <= range_last_ - range_first_; }

  Manners manners_;
  const Clock::time_point end_;  ///< when the transfer has taken too long
  const bool is_whole_;          ///< not a range; asking the jobs would be too late once one has ended
  bool is_elsewhere_ = false;    ///< redirected to another host
  std::string range_;
  curl_slist* headers_ = nullptr;
  std::uint64_t first_ = 0, size_ = 0;  ///< the range of all jobs
  // The answer.
  long status_ = 0;
  bool has_range_ = false;
  std::uint64_t range_first_ = 0, range_last_ = 0;
  std::uint64_t range_of_ = 0;  ///< size of the whole file; 0: not said
  std::uint64_t length_ = 0;    ///< Content-Length; 0: not said
  std::uint64_t received_ = 0;  ///< bytes of the file
  std::uint64_t ignored_ = 0;   ///< bytes of an answer that is none
  std::uint64_t header_ = 0;    ///< bytes of header lines
  const char* problem_ = nullptr;
  bool too_large_ = false;
};

}  // namespace roam::web
