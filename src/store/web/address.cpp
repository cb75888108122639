#include "store/web/address.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "roam/error.h"
#include "text/web_address.h"

namespace roam::web {
namespace {

constexpr std::string_view plain = "http://", secured = "https://";

/// "host/path" of an address.
std::string_view without_scheme(std::string_view text) {
  return text.substr(text.starts_with(secured) ? secured.size() : plain.size());
}

bool is_port(std::string_view text) {
  unsigned number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number >= 1 && number <= 65535;
}

}  // namespace

bool Address::is_one(std::string_view text) { return scheme_size(text) > 0; }

Address::Address(std::string_view text) {
  const std::size_t question = std::min(text.find('?'), text.size()), scheme = scheme_size(text);
  shown_ = scheme == 0 ? "" : scheme == plain.size() ? plain : secured;
  shown_ += text.substr(scheme, question - std::min(scheme, question));
  query_ = text.substr(std::min(question + 1, text.size()));
  const auto refuse = [&](const char* why) { throw Error(shown_, why); };
  const std::string_view rest = is_one(shown_) ? without_scheme(shown_) : std::string_view();
  const std::string_view host = rest.substr(0, std::min(rest.find('/'), rest.size()));
  if (login_size(text.substr(scheme)) > 0) {
    shown_ = without_secrets(text);
    refuse("an address with a name or a password is seen by others; keep them in ~/.netrc");
  }
  if (host.empty()) refuse("this is no address of a web server: write http://HOST/STORE or https://HOST/STORE");
  // Behind a literal address of IPv6, which is in brackets.
  const std::size_t colon = host.find(':', std::min(host.find(']'), host.size() - 1) * (host.front() == '[' ? 1 : 0));
  if (colon != std::string_view::npos && !is_port(host.substr(colon + 1))) {
    refuse("this is no address of a web server: a port is a number from 1 to 65535");
  }
  if (text.find('#') != std::string_view::npos) refuse("an address of a store has no '#'; write %23 for it");
  const auto cannot_be = [](char c) { return c <= ' ' || c >= 127 || c == '"' || c == '<' || c == '>' || c == '\\'; };
  if (std::any_of(shown_.begin(), shown_.end(), cannot_be) || std::any_of(query_.begin(), query_.end(), cannot_be)) {
    refuse("an address holds no blanks, quotes or letters beyond ASCII; write %20 for a blank");
  }
  const std::size_t root = shown_.find(host) + host.size();
  const auto drop = [&](std::string_view end) {
    const bool has = shown_.ends_with(end) && shown_.size() >= root + end.size();
    if (has) shown_.resize(shown_.size() - end.size());
    return has;
  };
  while (drop("/")) {
  }
  drop("/CURRENT");  // the address of the store's first file
}

std::string Address::of(std::string_view file) const {
  std::string address = shown_ + "/";
  address += file;
  if (!query_.empty()) address += "?" + query_;
  return address;
}

bool Address::is_secured(std::string_view address, std::string_view other) {
  return address.starts_with(plain) && other.starts_with(secured) && without_scheme(address) == without_scheme(other);
}

void Address::secure() {
  if (is_secure()) return;
  std::string address(secured);
  address += without_scheme(shown_);
  shown_ = std::move(address);
}

}  // namespace roam::web
