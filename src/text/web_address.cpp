#include "text/web_address.h"

#include <algorithm>

namespace roam {
namespace {

/// The size of "http:" or "https:" at the start of a text; 0: none.
std::size_t name_size(std::string_view text) {
  constexpr std::string_view name = "https:";
  std::size_t at = 0;
  for (const char c : name) {
    const char lower = at < text.size() && text[at] >= 'A' && text[at] <= 'Z' ? static_cast<char>(text[at] - 'A' + 'a')
                       : at < text.size()                                     ? text[at]
                                                                              : '\0';
    if (c == lower) {
      ++at;
    } else if (c != 's') {
      return 0;
    }
  }
  return at;
}

bool ends_address(char c) { return static_cast<unsigned char>(c) <= ' ' || c == '"' || c == '<' || c == '>'; }

bool is_of_sentence(char c) { return std::string_view(":;,.)'`").find(c) != std::string_view::npos; }

/// An address behind its scheme, and perhaps the end of a sentence.
std::string shown(std::string_view address) {
  const std::size_t login = login_size(address), question = address.find('?', login);
  std::string text = login > 0 ? "...@" : "";
  text += address.substr(login, question - login);
  if (question == std::string_view::npos) return text;
  std::size_t end = address.size();
  while (end > question && is_of_sentence(address[end - 1])) --end;
  text += address.substr(end);
  return text;
}

}  // namespace

std::size_t scheme_size(std::string_view text) {
  const std::size_t size = name_size(text);
  return size > 0 && text.substr(size).starts_with("//") ? size + 2 : 0;
}

std::string_view scheme_name(std::string_view text) {
  const std::string_view name = text.substr(0, std::min(text.find("://"), text.size()));
  const auto is_of_name = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' || c == '-';
  };
  return name.size() < text.size() && std::all_of(name.begin(), name.end(), is_of_name) ? name : std::string_view();
}

std::string help_for_missing(std::string_view name) {
  if (scheme_size(name) > 0) return "A store at this address is opened as a store; a scene is downloaded first.";
  if (!scheme_name(name).empty()) return "Stores are read by http:// and https://; all else is copied here first.";
  return "Check the spelling.";
}

std::string_view web_host(std::string_view address) {
  const std::size_t scheme = scheme_size(address);
  if (scheme == 0) return {};
  address.remove_prefix(scheme);
  return address.substr(0, address.find_first_of("/?"));
}

std::size_t login_size(std::string_view address) {
  const std::size_t question = std::min(address.find('?'), address.size());
  const std::string_view host = address.substr(0, std::min(address.find_first_of("/?"), address.size()));
  const std::size_t colon = std::min(host.find(':'), host.size());
  // Behind a colon that no port follows a password may hold a slash or a question mark.
  const bool is_port = host.find_first_not_of("0123456789", colon + 1) == std::string_view::npos;
  const std::size_t at = address.substr(0, is_port ? question : address.size()).rfind('@');
  return at == std::string_view::npos ? 0 : at + 1;
}

std::string without_secrets(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    std::size_t begin = text.starts_with("://") ? 1 : name_size(text);
    if (begin == 0 || !text.substr(begin).starts_with('/')) {
      result += text.front();
      text.remove_prefix(1);
      continue;
    }
    while (text.substr(begin).starts_with('/')) ++begin;
    const std::string_view address = text.substr(begin);
    const auto end =
        static_cast<std::size_t>(std::find_if(address.begin(), address.end(), ends_address) - address.begin());
    result += text.substr(0, begin);
    result += shown(address.substr(0, end));
    text.remove_prefix(begin + end);
  }
  return result;
}

}  // namespace roam
