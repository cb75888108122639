// Where memory runs out, a request to a web server ends, and the next one is served. Instrumented builds have an
// operator new of their own.
#include <gtest/gtest.h>

#include <array>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "fallible_calls.h"
#include "program.h"
#include "store/web/server.h"
#include "store/web/transfer.h"
#include "web_servers.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

std::string got_by(roam::web::Server& server, const roam::web::Wanted& wanted, const char* bytes, std::size_t size) {
  const roam::web::Answer answer = server.get(wanted);
  if (answer.problem != nullptr && std::string_view(answer.problem) == roam::web::no_memory) throw std::bad_alloc();
  if (answer.problem != nullptr) throw roam::Error(answer.problem);
  return Bits() << std::string(bytes, size);
}

TEST(WebAllocations, ARequestEndsWhereverOneFails) {
  const TestFolder folder;
  folder.write("file", "0123456789");
  const support::Misbehaving web(folder.file(""));
  const roam::web::Address address(web.address("good", ""));
  fail_calls(
      {{.name = "get a range",
        .bits =
            [&] {
              roam::web::Server server(address, {});
              std::array<char, 4> range{};
              return got_by(server, {.file = "file", .offset = 3, .out = std::as_writable_bytes(std::span(range))},
                            range.data(), range.size());
            },
        .later = true},
       {.name = "get a file",
        .bits =
            [&] {
              roam::web::Server server(address, {});
              std::vector<std::byte> whole;
              whole.reserve(16);
              roam::web::Wanted wanted{.file = "file", .whole = &whole, .limit = 16};
              const std::string text = got_by(server, wanted, "", 0);
              return std::string(Bits() << text << std::string(reinterpret_cast<char*>(whole.data()), whole.size()));
            },
        .later = true}});
}

}  // namespace
#endif
