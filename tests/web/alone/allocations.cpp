// Where memory runs out, a request to a web server ends, and the next one is served. Instrumented builds have an
// operator new of their own.
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <new>
#include <string>
#include <vector>

#include "fallible_calls.h"
#include "program.h"
#include "store/web/server.h"
#include "store/web/transfer.h"
#include "web_servers.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

/// The bits of what was got. If no memory was left, asks the same server once more, where none fails, and throws.
template <class Bytes>
std::string got(roam::web::Server& server, const roam::web::Wanted& wanted, const Bytes& bytes) {
  const auto problem = [&] {
    const char* const why = server.get(wanted).problem;
    const Spare spare;
    return std::string(why == nullptr ? "" : why);
  };
  const auto bits = [&] {
    return std::string(Bits() << std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  };
  const std::string first = problem();
  const Spare spare;
  if (first.empty()) return bits();
  failing_allocation = 0;
  EXPECT_EQ(first, roam::web::no_memory);
  EXPECT_EQ(problem(), "");
  EXPECT_TRUE(bits().ends_with(std::string("3456") + '\0') || bits().ends_with(std::string("0123456789") + '\0'));
  throw std::bad_alloc();
}

TEST(WebAllocations, ARequestEndsWhereverOneFailsAndTheNextOneIsServed) {
  const TestFolder folder;
  folder.write("file", "0123456789");
  const support::Misbehaving web(folder.file(""));
  const roam::web::Address address(web.address("good", ""));
  sigset_t before, behind;
  ::pthread_sigmask(SIG_SETMASK, nullptr, &before);
  const auto signals_are_as_before = [&](bool /*failed*/) {
    ::pthread_sigmask(SIG_SETMASK, nullptr, &behind);
    for (const int number : {SIGINT, SIGTERM, SIGPIPE})
      EXPECT_EQ(::sigismember(&behind, number), ::sigismember(&before, number)) << number;
  };
  fail_calls({{.name = "get a range",
               .bits =
                   [&] {
                     roam::web::Server server(address, {});
                     std::array<char, 4> range{};
                     return got(server, {.file = "file", .offset = 3, .out = std::as_writable_bytes(std::span(range))},
                                range);
                   },
               .after = signals_are_as_before,
               .later = true},
              {.name = "get a file",
               .bits =
                   [&] {
                     roam::web::Server server(address, {});
                     std::vector<std::byte> whole;
                     return got(server, {.file = "file", .whole = &whole, .limit = 16}, whole);
                   },
               .after = signals_are_as_before,
               .later = true}});
}

}  // namespace
#endif
