#include "store/web_files.h"

#include <fmt/format.h>

#include <cerrno>
#include <optional>
#include <utility>

#include "store/files.h"
#include "store/web/disk_cache.h"
#include "store/web/server.h"

namespace roam::store {
namespace {

/// Requests at once. More would only share the same line.
constexpr int requests_at_once = 8;

constexpr const char* gone =
    "the web server does not have it (status 404 or 410): the store was replaced or removed: open it anew; or "
    "not all of it is served: publish it again";

/// Whether a store has a file of this name. Only such files are requested from a web server, for manifests come from
/// strangers.
bool is_asked_for(std::string_view file) {
  if (file == current_file) return true;
  const auto is = [&](std::string_view folder, std::string_view extension) {
    return file.starts_with(folder) && file.size() == folder.size() + 64 + extension.size() &&
           is_named_by_hash(file, extension);
  };
  return is("packs/", ".pack") || is("parts/", ".part") || is("manifests/", ".json") || is("codes/", ".hmac");
}

class WebFiles : public StoreBytes {
 public:
  WebFiles(const web::Address& address, const WebAccess& access, std::stop_token stop)
      : name_(address.shown()), stop_(std::move(stop)), server_(address, {access.redirects, access.patience}) {
    if (!access.cache.empty()) cache_.emplace(access.cache, access.cache_bytes);
  }

  std::vector<std::byte> whole(const std::string& file, std::uint64_t limit) override {
    demand_asked_for(file);
    const bool is_manifest = file.starts_with("manifests/");
    const std::string key = is_manifest && cache_ ? key_of(file) : std::string();
    if (!key.empty()) {
      std::optional<std::vector<std::byte>> kept = cache_->find(key, limit);
      if (kept && is_named_for(file, *kept)) return std::move(*kept);
    }
    std::vector<std::byte> bytes;
    const auto get = [&](bool anew) {
      return server_.get({.file = file, .whole = &bytes, .limit = limit, .anew = anew}, stop_);
    };
    web::Answer answer = get(file == current_file);
    // The connection may have ended early, and no length said so; or a cache on the way keeps wrong bytes.
    if (is_manifest && !answer.problem && !is_named_for(file, bytes)) answer = get(true);
    const std::string place = name_ + "/" + file;
    if (answer.problem) {
      const bool is_none = answer.missing && file == current_file;
      const Error error = is_none
                              ? Error(name_, "there is no store at this address: the web server has no file CURRENT")
                              : Error::at(place, fmt::format("cannot read {}: {}", place, answer.problem));
      if (answer.too_large) throw FileError(error, EFBIG);
      throw Error(error);
    }
    if (!key.empty() && is_named_for(file, bytes)) cache_->keep(key, bytes);
    return bytes;
  }

  const char* read(const std::string& file, std::uint64_t offset, std::span<std::byte> out,
                   const std::stop_token& stop) override {
    demand_asked_for(file);
    if (out.empty()) return nullptr;
    const web::Answer answer = server_.get({.file = file, .offset = offset, .out = out}, stop);
    return answer.missing ? gone : answer.problem;
  }

  const char* read_checked(const std::string& file, std::uint64_t offset, std::span<std::byte> out, std::uint64_t hash,
                           const std::stop_token& stop) override {
    if (!cache_) return StoreBytes::read_checked(file, offset, out, hash, stop);
    // With the hash: bytes that one manifest leads to are never those of another.
    const std::string key = key_of(fmt::format("{} {} {} {:016x}", file, offset, out.size(), hash));
    const bool is_kept = cache_->find(key, out) && xxh3(out) == hash;
    if (!is_kept) {
      if (const char* problem = StoreBytes::read_checked(file, offset, out, hash, stop)) return problem;
    }
    cache_->keep(key, out);
    return nullptr;
  }

  [[nodiscard]] int best_at_once() const override { return requests_at_once; }

 private:
  void demand_asked_for(const std::string& file) const {
    if (!is_asked_for(file)) throw Error(name_, "a file that no store has is not asked for");
  }
  /// The address is part of it: the bytes of one server are never those of another.
  [[nodiscard]] std::string key_of(const std::string& what) const {
    const std::string key = name_ + "/" + what;
    return sha256(std::as_bytes(std::span(key)));
  }
  [[nodiscard]] static bool is_named_for(const std::string& file, std::span<const std::byte> bytes) {
    return manifest_file(sha256(bytes)) == file;
  }

  std::string name_;
  std::stop_token stop_;
  std::optional<web::DiskCache> cache_;
  web::Server server_;
};

}  // namespace

void check(const WebAccess& access) {
  if (!(access.patience >= 0.1 && access.patience <= 3600.0)) {
    throw Error(fmt::format("a patience of {} s with a web server: 0.1 to 3600 are possible", access.patience));
  }
  if (!access.cache.empty() && access.cache_bytes < web::DiskCache::least_bytes) {
    throw Error(access.cache.string(), fmt::format("a cache has {} MiB at least", web::DiskCache::least_bytes >> 20));
  }
}

WebStore web_store(const std::string& text, const WebAccess& access, std::stop_token stop) {
  check(access);
  web::Address address(text);
  if (!access.query.empty()) {
    if (!address.query().empty()) throw Error(address.shown(), "the address has a query already; give it one");
    address = web::Address(address.shown() + "?" + access.query);
  }
  return {std::make_shared<WebFiles>(address, access, std::move(stop)), address.shown()};
}

}  // namespace roam::store
