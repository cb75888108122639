// Other hosts on the way to a store: those that redirect, pretend to be another, or pass requests on.

#include <cstdlib>
#include <fstream>
#include <utility>

#include "environment_variable.h"
#include "web_made.h"

namespace {

using namespace made;

TEST(WebStore, RedirectsToOtherHostsAreFollowedOnDemandOnly) {
  const Served served("web_redirects");
  const support::Misbehaving server(served.root());
  EXPECT_NE(refusal(server.address("all-elsewhere")).find("--redirects"), std::string::npos);
  const auto store = opened(server.address("all-elsewhere") + "?secret", following(2.0));
  static_cast<void>(server.requests());
  EXPECT_EQ(all_bytes(*store), all_bytes(*Store::open(served.store())));
  // The secret is for the first host alone.
  for (const std::string& request : server.requests()) {
    EXPECT_EQ(request.find("/all-good/") != std::string::npos, request.find("secret") == std::string::npos) << request;
  }
  // By a page so long that its end is not waited for where it is no redirect.
  EXPECT_EQ(opened(server.address("all-elsewhere100"), following(2.0))->info().hash, store->info().hash);
  EXPECT_NE(refusal(server.address("all-loop"), following(0.3)).find("too often"), std::string::npos);
  EXPECT_NE(refusal(server.address("all-file"), following(0.3)).find("redirects"), std::string::npos);
}

TEST(WebStore, CertificatesAreChecked) {
  const Served served("web_secure");
  const std::string certificate = (served.folder.path() / "certificate.pem").string();
  const std::string make = fmt::format(
      "openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 -subj /CN=127.0.0.1 "
      "-addext subjectAltName=IP:127.0.0.1 -keyout {0}.key -out {0}.crt 2> /dev/null && cat {0}.key {0}.crt > {0}",
      certificate);
  if (std::system(make.c_str()) != 0) GTEST_SKIP() << "the command openssl is not here";
  const support::Misbehaving server(served.root(), certificate);
  const std::string message = refusal(server.address("good"), patient(10.0));
  EXPECT_NE(message.find("certificate"), std::string::npos) << message;
  const EnvironmentVariable trusted("CURL_CA_BUNDLE", (certificate + ".crt").c_str());
  EXPECT_EQ(all_bytes(*opened(server.address("good"))), all_bytes(*Store::open(served.store())));
}

TEST(WebStore, ProxiesAndNetrcHoldAsForCurl) {
  const Served served("web_proxy");
  const support::Misbehaving server(served.root());
  const std::string proxy = fmt::format("http://127.0.0.1:{}", server.port());
  {
    const EnvironmentVariable through("http_proxy", proxy.c_str());
    EXPECT_EQ(opened("http://name.invalid/good/x.roam")->info().hash, Store::open(served.store())->info().hash);
    const EnvironmentVariable around("no_proxy", "name.invalid");
    EXPECT_NE(refusal("http://name.invalid/good/x.roam").find("name is not known"), std::string::npos);
  }
  {
    const EnvironmentVariable through("https_proxy", proxy.c_str());
    for (const auto& [status, reason] :
         {std::pair(407, "the proxy wants a name"), std::pair(403, "the proxy refuses")}) {
      static_cast<void>(server.requests());
      const std::string message = refusal(fmt::format("https://{}.invalid/x.roam", status), patient(2.0));
      EXPECT_NE(message.find(reason), std::string::npos) << message;
      EXPECT_EQ(server.requests().size(), 1U) << "it is tried again";
    }
    for (const int status : {408, 429, 503}) {
      static_cast<void>(server.requests());
      const std::string message = refusal(fmt::format("https://{}.invalid/x.roam", status), patient(2.0));
      EXPECT_EQ(message.find("the proxy refuses"), std::string::npos) << message;
      EXPECT_GT(server.requests().size(), 1U) << status << " may pass";
    }
  }
  std::ofstream(served.folder.path() / ".netrc") << "machine 127.0.0.1 login me password word\n";
  const EnvironmentVariable home("HOME", served.folder.path().c_str());
  static_cast<void>(server.requests());
  static_cast<void>(opened(server.address("good")));
  for (const std::string& request : server.requests()) EXPECT_TRUE(request.ends_with("Basic bWU6d29yZA==")) << request;
  // The password of another host is not for who redirects there, nor for a line without encryption.
  std::ofstream(served.folder.path() / ".netrc") << "default login me password word\n";
  static_cast<void>(opened(server.address("all-elsewhere"), following(2.0)));
  for (const std::string& request : server.requests()) {
    EXPECT_EQ(request.find("/all-good/") == std::string::npos, request.ends_with("Basic bWU6d29yZA==")) << request;
  }
  const EnvironmentVariable through("http_proxy", proxy.c_str());
  static_cast<void>(opened("http://name.invalid/good/x.roam"));
  for (const std::string& request : server.requests()) EXPECT_FALSE(request.ends_with("d29yZA==")) << request;
}

}  // namespace
