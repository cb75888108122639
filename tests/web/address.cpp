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
  EXPECT_TRUE(Address::is_one("http://host"));
  EXPECT_FALSE(Address::is_one("./http://host"));
  EXPECT_FALSE(Address::is_one("ftp://host"));
}

TEST(Address, RefusesWhatNoServerIsAskedFor) {
  for (const char* text :
       {"http://", "http:///a", "https://?a", "file:///etc/passwd", "http://me@host/a", "dam.roam", "http://host/a b",
        "http://host/a\nb", "http://host/a#b", "http://host/a?b\r\nc: d", "http://host/\xc3\xa4", "http://host/a\\b"}) {
    EXPECT_THROW(static_cast<void>(Address(text)), roam::Error) << text;
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
