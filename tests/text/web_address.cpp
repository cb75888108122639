// Addresses in sentences: what is not shown of them.

#include "text/web_address.h"

#include <gtest/gtest.h>

#include <map>

namespace {

TEST(WebAddress, ASentenceHoldsNeitherQueriesNorPasswords) {
  const std::map<std::string, std::string> sentences{
      {"", ""},
      {"what? nothing", "what? nothing"},
      {"https:", "https:"},
      {"http://host/a?sig=x: no such file", "http://host/a: no such file"},
      {"unexpected argument 'HTTPS://host/a?sig=it's'", "unexpected argument 'HTTPS://host/a'"},
      {"`roam build http:/host/a?sig -o x?`", "`roam build http:/host/a -o x?`"},
      {"/x/http:/host/a?sig/packs is no folder", "/x/http:/host/a is no folder"},
      {"http://a:80/b?c, \"https://d?e\".", "http://a:80/b, \"https://d\"."},
      {"http://me:pass@host:1/a?b.", "http://...@host:1/a."},
      {"http://me:pass@host:1/a?b@c.", "http://...@c."},  // a password may hold all of these: rather too much is hidden
      {"http://me:p/a@host/a?b", "http://...@host/a"},
      {"http://me:p?a@host/a?b", "http://...@host/a"},
      {"http://host/a?mail=me@host", "http://host/a"},
      {"httphttp://a?b", "httphttp://a"},
      {"ftp://me:pass@host/a", "ftp://...@host/a"},
  };
  for (const auto& [sentence, shown] : sentences) EXPECT_EQ(roam::without_secrets(sentence), shown);
}

TEST(WebAddress, ASchemeHasAnyCase) {
  EXPECT_EQ(roam::scheme_size("http://a"), 7U);
  EXPECT_EQ(roam::scheme_size("HTTPS://a"), 8U);
  for (const char* none : {"", "http", "http:/a", "httpx://a", "ftp://a", "https:"}) {
    EXPECT_EQ(roam::scheme_size(none), 0U) << none;
  }
}

TEST(WebAddress, WhatIsMissingIsHelpedByItsKind) {
  EXPECT_EQ(roam::scheme_name("ftp://a/b"), "ftp");
  for (const char* none : {"", "a", "a/b://c", "://a", "s3:/a"}) EXPECT_EQ(roam::scheme_name(none), "") << none;
  EXPECT_EQ(roam::help_for_missing("house.obj"), "Check the spelling.");
  EXPECT_NE(roam::help_for_missing("HTTP://a/b").find("opened as a store"), std::string::npos);
  EXPECT_NE(roam::help_for_missing("s3://a/b").find("copied here"), std::string::npos);
}

TEST(WebAddress, AHostIsNamedWithItsPort) {
  EXPECT_EQ(roam::web_host("https://a.org:81/b?c"), "a.org:81");
  EXPECT_EQ(roam::web_host("HTTP://a?b"), "a");
  EXPECT_EQ(roam::web_host("/a/b"), "");
}

}  // namespace
