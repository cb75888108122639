#pragma once
/// \file
/// Addresses of web servers in text, whose secrets are not shown.

#include <cstddef>
#include <string>
#include <string_view>

namespace roam {

/// The size of "http://" or "https://" at the start of a text, in any case; 0: none.
[[nodiscard]] std::size_t scheme_size(std::string_view text);

/// The name before "://" at the start of a text, such as "ftp"; empty: there is none.
[[nodiscard]] std::string_view scheme_name(std::string_view text);

/// What to do if there is no file or folder of this name, which may be an address.
[[nodiscard]] std::string help_for_missing(std::string_view name);

/// The size of a name and a password, with the @, at the start of an address behind its scheme; 0: none.
[[nodiscard]] std::size_t login_size(std::string_view address);

/// "host:port" of an address; empty: it is none.
[[nodiscard]] std::string_view web_host(std::string_view address);

/// The text with every address in it, of any scheme, cut at its question mark, and without a name and a password. An
/// address ends at the next blank; http:/ with one slash, as in a path, counts too.
[[nodiscard]] std::string without_secrets(std::string_view text);

}  // namespace roam
