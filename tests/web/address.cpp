// Addresses: what they show, and what they request.

#include "store/web/address.h"

#include <gtest/gtest.h>

#include "roam/error.h"

namespace {

using roam::web::Address;

TEST(Address, KeepsItsQueryToItself) {
  const Address address("https://host:81/a/dam.roam/?key=value&b=%20");
  EXPECT_EQ(address.shown(), "https://host:81/a/dam.roam");
  EXPECT_EQ(address.of("CURRENT"), "https://host:81/a/dam.roam/CURRENT?key=value&b=%20");
  EXPECT_EQ(Address("http://host").of("CURRENT"), "http://host/CURRENT");
  EXPECT_EQ(Address("http://host/a/CURRENT").of("CURRENT"), "http://host/a/CURRENT");
  EXPECT_EQ(Address("http://host/CURRENT/").of("CURRENT"), "http://host/CURRENT");
  EXPECT_TRUE(Address::is_one("http://host"));
  EXPECT_TRUE(Address::is_one("HtTpS://host"));
  EXPECT_EQ(Address("HTTPS://Host/A?b").of("CURRENT"), "https://Host/A/CURRENT?b");
  EXPECT_EQ(Address("http://host/a?mail=me@host").query(), "mail=me@host");
  EXPECT_FALSE(Address::is_one("./http://host"));
  EXPECT_FALSE(Address::is_one("ftp://host"));
  for (const char* port : {"99999", "-1", "abc", "", "0"}) {
    EXPECT_THROW(Address("http://host:" + std::string(port) + "/a"), roam::Error) << port;
  }
  for (const char* right : {"http://host:8080/a", "http://[::1]/a", "http://[::1]:81/a"}) {
    EXPECT_EQ(Address(right).shown(), right);
  }
}

TEST(Address, RefusesWhatNoServerIsAskedFor) {
  for (const char* text : {"http://", "http:///a", "https://?a", "file:///etc/passwd", "http://me@host/a", "dam.roam",
                           "http://host/a b", "http://host/a\nb", "http://host/a#b", "http://host/a?b#c",
                           "http://host/a@b", "http://host/a?b\r\nc: d", "http://host/\xc3\xa4", "http://host/a\\b"}) {
    EXPECT_THROW(static_cast<void>(Address(text)), roam::Error) << text;
  }
}

TEST(Address, APasswordIsRefusedAndNotShown) {
  for (const char* text : {"http://me:SECRET@host/a", "HTTP://me:SECRET@host/a", "http://me:SEC/RET@host/a",
                           "http://me:SEC?RET@host/a", "http://me:SEC/RE?T@host/a?b", "http://SECRET@host/a?SEC@b"}) {
    try {
      static_cast<void>(Address(text));
      ADD_FAILURE() << text;
    } catch (const roam::Error& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find("SEC"), std::string::npos) << message;
      EXPECT_EQ(message.find("RE"), std::string::npos) << message;
      EXPECT_NE(message.find("://...@host/a: "), std::string::npos) << message;
      EXPECT_NE(message.find(".netrc"), std::string::npos) << message;
    }
  }
}

TEST(Address, OnlyTheSamePlaceIsASecuredOne) {
  EXPECT_TRUE(Address::is_secured("http://host/a?b", "https://host/a?b"));
  for (const char* other : {"https://host.com/a?b", "https://host/b?b", "http://host/a?b", "https://host:444/a?b"}) {
    EXPECT_FALSE(Address::is_secured("http://host/a?b", other)) << other;
  }
  EXPECT_FALSE(Address::is_secured("https://host/a", "https://host/a"));
  Address address("http://host/a");
  address.secure();
  address.secure();
  EXPECT_EQ(address.of("CURRENT"), "https://host/a/CURRENT");
}

}  // namespace
