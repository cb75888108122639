#include "store/web/transfer.h"

#include <fcntl.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <new>
#include <string_view>

#include "roam/version.h"
#include "text/web_address.h"

namespace roam::web {
namespace {

/// s
constexpr long longest_connecting = 10;

/// Bytes a second: a slower answer is none.
constexpr long least_speed = 1000;

/// Bytes of a page that are read at most. After the whole page of an error the connection can be used again. After that
/// of a redirect libcurl names its target.
constexpr std::uint64_t most_of_error = 64 << 10, most_of_redirect = 4 << 20;

/// Bytes of all header lines, those before the file and behind it: libcurl keeps them.
constexpr std::uint64_t most_of_header = 64 << 10;

/// In `patience`: the longest transfer (33 minutes for 20 s). So the largest request may come at least_speed.
constexpr double longest_transfer = 100.0;

constexpr const char* too_long = "the web server's answer takes far too long";
constexpr const char* long_header = "the web server sends more header lines than an answer has";
constexpr const char* wrong_range = "the web server sends another range than requested";
constexpr const char* too_much = "the web server sends more bytes than it says";
constexpr const char* larger = "it is larger than any file of its kind";
constexpr const char* broken = "the connection to the web server broke";

constexpr const char* no_tunnel =
    "the proxy refuses to connect to the web server; check https_proxy and no_proxy, or ask whoever runs the proxy";

/// Statuses of failures that may pass.
constexpr long passing[] = {408, 429, 500, 502, 503, 504};

bool passes(long status) { return std::find(std::begin(passing), std::end(passing), status) != std::end(passing); }

bool is_redirect(long status) {
  return status == 301 || status == 302 || status == 303 || status == 307 || status == 308;
}

const char* meaning(long status, bool is_signed) {
  switch (status) {
    case 400:
      return is_signed ? "the web server does not understand the request, or its signature (status 400)"
                       : "the web server does not understand the request (status 400)";
    case 401:
      return "the web server wants a name and a password (status 401); keep them in ~/.netrc";
    case 403:
      return is_signed
                 ? "the web server refuses access (status 403); the signature of the address may have expired: get "
                   "a new one"
                 : "the web server refuses access (status 403)";
    case 404:
    case 410:
      return "the web server has no such file (status 404 or 410)";
    case 407:
      return "the proxy wants a name and a password (status 407)";
    case 408:
    case 504:
      return "the web server's time is up (status 408 or 504)";
    case 416:
      return too_short;
    case 429:
      return "the web server gets too many requests (status 429)";
    case 500:
    case 502:
    case 503:
      return "the web server fails or is overloaded (status 500, 502 or 503)";
    default:
      return "the web server gives an answer that no file has; ask whoever runs it";
  }
}

/// A failure of libcurl. One that may pass is tried again.
struct Failure {
  CURLcode code;
  const char* meaning;
  bool may_pass;
};
constexpr Failure failures[] = {
    {CURLE_COULDNT_RESOLVE_PROXY, "the proxy's name is not known; check http_proxy and https_proxy", false},
    {CURLE_COULDNT_RESOLVE_HOST, "the web server's name is not known, or there is no network", true},
    {CURLE_COULDNT_CONNECT, "there is no connection to the web server", true},
    {CURLE_OPERATION_TIMEDOUT, "the web server does not answer, or too slowly", true},
    {CURLE_PARTIAL_FILE, broken, true},
    {CURLE_GOT_NOTHING, broken, true},
    {CURLE_RECV_ERROR, broken, true},
    {CURLE_SEND_ERROR, broken, true},
    {CURLE_HTTP2, broken, true},
    {CURLE_HTTP2_STREAM, broken, true},
    {CURLE_PEER_FAILED_VERIFICATION,
     "the web server's certificate is not one of this server, or of nobody whom this system trusts", false},
    {CURLE_SSL_CONNECT_ERROR, "there is no encrypted connection to the web server", true},
    {CURLE_SSL_CACERT_BADFILE, "this system's certificates cannot be read; check CURL_CA_BUNDLE and SSL_CERT_FILE",
     false},
    {CURLE_OUT_OF_MEMORY, no_memory, false},
};

Failure failure_of(CURLcode code) {
  for (const Failure& failure : failures) {
    if (failure.code == code) return failure;
  }
  return {code, "the web server's answer is no HTTP", false};
}

bool same_name(std::string_view a, std::string_view lower) {
  return a.size() == lower.size() && std::equal(a.begin(), a.end(), lower.begin(), [](char x, char y) {
           return (x >= 'A' && x <= 'Z' ? static_cast<char>(x - 'A' + 'a') : x) == y;
         });
}

bool is_loopback(std::string_view host) {
  const std::string_view name = host.starts_with('[') ? host.substr(0, host.find(']')) : host.substr(0, host.find(':'));
  const bool is_number = name.find_first_not_of("0123456789.") == std::string_view::npos;
  return name == "localhost" || name == "[::1" || (is_number && name.starts_with("127."));
}

/// A number at the start of a text, which then loses it. False if there is none.
bool number(std::string_view& text, std::uint64_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

}  // namespace

bool may_pass(std::string_view problem) {
  return std::any_of(std::begin(passing), std::end(passing),
                     [&](long status) { return problem == meaning(status, false); }) ||
         std::any_of(std::begin(failures), std::end(failures),
                     [&](const Failure& f) { return f.may_pass && problem == f.meaning; });
}

Transfer::Transfer(std::vector<Job*>&& of, std::string where, const Manners& manners)
    : jobs(std::move(of)),
      handle(Curl::library().easy_init()),
      address(std::move(where)),
      manners_(manners),
      end_(alive + std::chrono::duration_cast<Clock::duration>(
                       std::chrono::duration<double>(longest_transfer * manners.patience))),
      is_whole_(jobs.front()->wanted.whole != nullptr) {
  if (handle == nullptr) throw std::bad_alloc();
  first_ = jobs.front()->wanted.offset;
  for (const Job* job : jobs) size_ = std::max(size_, job->end() - first_);
  if (!is_whole_) range_ = std::to_string(first_) + "-" + std::to_string(first_ + size_ - 1);
  prepare();
}

Transfer::~Transfer() {
  handle.reset();
  Curl::library().slist_free_all(headers_);
}

void Transfer::prepare() {
  set(CURLOPT_URL, address.c_str());
  set(CURLOPT_PROTOCOLS_STR, "http,https");
  set(CURLOPT_FOLLOWLOCATION, 0L);
  set(CURLOPT_USERAGENT, "roam/" ROAM_VERSION_STRING);
  set_login();
#if LIBCURL_VERSION_NUM >= 0x075700
  set(CURLOPT_QUICK_EXIT, 1L);  // no end waits for the look-up of a name
#endif
  set(CURLOPT_NOSIGNAL, 1L);
  set(CURLOPT_PIPEWAIT, 1L);
  set(CURLOPT_SUPPRESS_CONNECT_HEADERS, 1L);
  set(CURLOPT_CONNECTTIMEOUT, std::clamp(static_cast<long>(manners_.patience / 2), 1L, longest_connecting));
  set(CURLOPT_LOW_SPEED_LIMIT, least_speed);
  set(CURLOPT_LOW_SPEED_TIME, std::max(1L, static_cast<long>(manners_.patience / 2)));
  set(CURLOPT_SOCKOPTFUNCTION, &keep_from_children);
  set(CURLOPT_HEADERFUNCTION, &take_header);
  set(CURLOPT_HEADERDATA, this);
  set(CURLOPT_WRITEFUNCTION, &take_body);
  set(CURLOPT_WRITEDATA, this);
  if (!range_.empty()) set(CURLOPT_RANGE, range_.c_str());
  for (const char* name : {"SSL_CERT_FILE", "CURL_CA_BUNDLE"}) {
    if (const char* const file = std::getenv(name); file != nullptr && *file != '\0') set(CURLOPT_CAINFO, file);
  }
  if (jobs.front()->wanted.anew) {
    headers_ = Curl::library().slist_append(nullptr, "Cache-Control: no-cache");
    set(CURLOPT_HTTPHEADER, headers_);
  }
}

/// Passwords are for the first host alone, and for no line where others read along.
void Transfer::set_login() {
  const bool may = !is_elsewhere_ && (address.starts_with("https:") || is_loopback(web_host(address)));
  set(CURLOPT_NETRC, long{may ? CURL_NETRC_OPTIONAL : CURL_NETRC_IGNORED});
}

void Transfer::redirect(const std::string& to) {
  is_elsewhere_ = is_elsewhere_ || web_host(to) != web_host(address);
  address = to;
  ++hops;
  header_ = 0;
  set_login();
  set(CURLOPT_URL, address.c_str());
}

int Transfer::keep_from_children(void* /*self*/, curl_socket_t socket, curlsocktype /*type*/) noexcept {
  ::fcntl(socket, F_SETFD, FD_CLOEXEC);
  return CURL_SOCKOPT_OK;
}

std::size_t Transfer::take_header(char* text, std::size_t one, std::size_t size, void* self) noexcept {
  Transfer& t = *static_cast<Transfer*>(self);
  std::string_view line(text, one * size);
  t.header_ += line.size();
  if (t.header_ > most_of_header) t.problem_ = long_header;
  if (t.problem_) return 0;
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  if (line.empty()) return t.headers_end() ? one * size : 0;
  t.header(line);
  return one * size;
}

void Transfer::header(std::string_view line) {
  if (line.starts_with("HTTP/")) {  // of this answer, or of one before it, such as 100
    status_ = 0;
    has_range_ = false;
    range_of_ = length_ = received_ = ignored_ = 0;
    std::string_view rest = line.substr(std::min(line.find(' '), line.size()));
    while (rest.starts_with(' ')) rest.remove_prefix(1);
    std::uint64_t status = 0;
    if (number(rest, status)) status_ = static_cast<long>(std::min<std::uint64_t>(status, 999));
    return;
  }
  const std::size_t colon = std::min(line.find(':'), line.size());
  const std::string_view name = line.substr(0, colon);
  std::string_view value = line.substr(std::min(colon + 1, line.size()));
  while (value.starts_with(' ')) value.remove_prefix(1);
  if (same_name(name, "content-length")) {
    if (!number(value, length_)) length_ = 0;
  } else if (same_name(name, "content-range") && value.starts_with("bytes ")) {
    value.remove_prefix(6);
    has_range_ = number(value, range_first_) && value.starts_with('-');
    if (has_range_) value.remove_prefix(1);
    has_range_ = has_range_ && number(value, range_last_) && value.starts_with('/');
    if (has_range_) value.remove_prefix(1);
    if (!has_range_ || !number(value, range_of_)) range_of_ = 0;
  }
}

bool Transfer::headers_end() {
  if (status_ < 200 || status_ >= 300) return true;
  if (is_whole_) {
    if (status_ != 200) problem_ = meaning(0, false);
    too_large_ = length_ > jobs.front()->wanted.limit;
    if (too_large_) problem_ = larger;
    if (!problem_) {
      try {
        jobs.front()->wanted.whole->clear();
        // Memory that is not written to is none: growth would take the old and the new at once.
        jobs.front()->wanted.whole->reserve(length_ > 0 ? length_ : jobs.front()->wanted.limit);
      } catch (const std::exception&) {
        problem_ = no_memory;
      }
    }
  } else if (status_ == 200) {
    problem_ = no_ranges;
  } else if (status_ != 206 || !has_range_ || range_first_ != first_ || range_last_ < first_ ||
             range_last_ - first_ >= size_) {
    problem_ = range_of_ > 0 && range_of_ < first_ + size_ ? too_short : wrong_range;
  }
  return problem_ == nullptr;
}

std::size_t Transfer::take_body(char* bytes, std::size_t one, std::size_t size, void* self) noexcept {
  Transfer& t = *static_cast<Transfer*>(self);
  return t.body({reinterpret_cast<const std::byte*>(bytes), one * size}) ? one * size : 0;
}

bool Transfer::body(std::span<const std::byte> bytes) {
  if (Clock::now() > end_) problem_ = too_long;
  if (problem_) return false;
  if (status_ != 200 && status_ != 206) {
    ignored_ += bytes.size();
    return ignored_ <= (is_redirect(status_) ? most_of_redirect : most_of_error);
  }
  const std::uint64_t begin = first_ + received_, end = begin + bytes.size();
  received_ += bytes.size();
  alive = Clock::now();
  if (is_whole_) {
    const Wanted& wanted = jobs.front()->wanted;
    too_large_ = received_ > wanted.limit;
    if (too_large_) problem_ = larger;
    if (problem_) return false;
    try {
      wanted.whole->insert(wanted.whole->end(), bytes.begin(), bytes.end());
    } catch (const std::exception&) {
      problem_ = no_memory;
    }
    return problem_ == nullptr;
  }
  if (end > range_last_ + 1) {
    problem_ = too_much;
    return false;
  }
  for (const Job* job : jobs) {
    const std::uint64_t from = std::max(begin, job->wanted.offset), to = std::min(end, job->end());
    if (from >= to) continue;
    std::memcpy(job->wanted.out.data() + (from - job->wanted.offset), bytes.data() + (from - begin), to - from);
  }
  return true;
}

bool Transfer::has_all(const Job& job) const { return !is_whole_ && status_ == 206 && first_ + received_ >= job.end(); }

std::string Transfer::redirected() const {
  char* to = nullptr;
  if (!is_redirect(status_)) return {};
  Curl::library().easy_getinfo(handle.get(), CURLINFO_REDIRECT_URL, &to);
  return to == nullptr ? std::string() : std::string(to);
}

const char* Transfer::refusal_of_proxy() const {
  long status = 0;
  if (status_ == 0) Curl::library().easy_getinfo(handle.get(), CURLINFO_HTTP_CONNECTCODE, &status);
  if (status < 400 || status >= 500 || passes(status)) return nullptr;
  return status == 407 ? meaning(status, false) : no_tunnel;
}

Answer Transfer::answer(CURLcode result) const {
  if (problem_) return {problem_, false, too_large_};
  if (const char* const refusal = refusal_of_proxy()) return {refusal};
  if (result != CURLE_OK && (status_ < 300 || result != CURLE_WRITE_ERROR)) return {failure_of(result).meaning};
  if (is_redirect(status_)) {
    return {manners_.redirects ? "the web server redirects too often, or to an address without encryption"
                               : "the web server redirects to another address; --redirects follows it"};
  }
  if (status_ < 200 || status_ >= 300) {
    return {meaning(status_, address.find('?') != std::string::npos), status_ == 404 || status_ == 410};
  }
  if (is_whole_ || received_ == size_) return {};
  return {is_cut() ? broken : too_short};
}

bool Transfer::may_pass(CURLcode result) const {
  if (problem_ || refusal_of_proxy()) return false;
  return is_cut() || passes(status_) || failure_of(result).may_pass;
}

double Transfer::wished_pause() const {
  curl_off_t seconds = 0;
  if (status_ != 429 && status_ != 503) return 0.0;
  Curl::library().easy_getinfo(handle.get(), CURLINFO_RETRY_AFTER, &seconds);
  return static_cast<double>(std::clamp<curl_off_t>(seconds, 0, 3600));
}

}  // namespace roam::web
