#include "store/manifest.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <string_view>

#include "store/files.h"
#include "store/json_reader.h"
#include "text/web_address.h"

namespace roam::store {
namespace {

constexpr std::uint64_t current_limit = 4096;
constexpr std::string_view current_start = "roam store ";
constexpr const char* manifest_name = "the manifest";
/// Versions published while a store is opened, each of which removes the one before.
constexpr int most_versions = 10;
constexpr const char* no_current = "its content is not that of a store's CURRENT";

std::string text_of(const std::vector<std::byte>& content) {
  return {reinterpret_cast<const char*>(content.data()), content.size()};
}

/// The hash in the text of CURRENT: "roam store 1\n", 64 digits, "\n".
std::string named_by(const std::string& current, const std::string& store) {
  const auto end = current.find('\n');
  std::uint32_t version = 0;
  if (!current.starts_with(current_start) || end == std::string::npos || end > current_start.size() + 9) {
    throw RootDamage(store, current_file, no_current);
  }
  for (std::size_t i = current_start.size(); i < end; ++i) {
    if (current[i] < '0' || current[i] > '9') throw RootDamage(store, current_file, no_current);
    version = 10 * version + static_cast<std::uint32_t>(current[i] - '0');
  }
  check_format(version, store);
  std::string named = current.substr(end + 1, 64);
  if (version < 1 || current[current_start.size()] == '0' || !is_digits(named, 64) ||
      current.substr(end + 65) != "\n") {
    throw RootDamage(store, current_file, no_current);
  }
  return named;
}

}  // namespace

RootDamage::RootDamage(const std::string& store, std::string damaged, std::string reason)
    : Error(at(store, Store::is_address(store)
                          ? fmt::format("{} is no store, or damaged: {}: {}; whoever serves it can publish it again",
                                        store, damaged, reason)
                          : fmt::format("{0} is damaged: {1}: {2}; `roam build` with its scene and `-o {0}` mends it",
                                        store, damaged, reason))),
      what_is_damaged(std::move(damaged)),
      why(std::move(reason)) {}

bool holds_store(const Folder& store) {
  return type_of(store, "packs") == S_IFDIR || type_of(store, "manifests") == S_IFDIR;
}

void refuse_to_open(const Folder& store) {
  namespace fs = std::filesystem;
  const std::string name = store.string();
  std::error_code none;
  if (!store.open().is_open() && !fs::exists(store.path(), none)) {
    if (name.empty()) throw Error("the name of a store is empty; name its folder or its address");
    if (!scheme_name(name).empty()) throw Error(name, "there is no such folder. " + help_for_missing(name));
    throw Error::at(name, fmt::format("{} is not there{}; make a store with roam build", name,
                                      fs::is_symlink(store.path(), none) ? ": it is a link that leads nowhere" : ""));
  }
  if (!holds_store(store)) throw Error::at(name, fmt::format("{} is no store; make one with roam build", name));
  const unsigned current = type_of(store, current_file);
  if (current == S_IFLNK) throw RootDamage(name, current_file, "it is a symbolic link, which no store has");
  if (current != 0) throw RootDamage(name, current_file, "it is no file");
  const bool has_manifest = type_of(store, "manifests") == S_IFDIR && !names_in(store, "manifests").empty();
  // A build killed just before it writes CURRENT has written its manifest and still has its plan.
  if (type_of(store, "scratch/plan.json") != 0 || (!has_manifest && type_of(store, "scratch") == S_IFDIR)) {
    throw NotComplete(name,
                      "this store is not complete: `roam build` with its scene, and -o, goes on where it stopped");
  }
  throw RootDamage(name, current_file, "it is not there");
}

Manifest read_manifest(StoreBytes& bytes, const std::string& store, std::string* hash, std::uint64_t* text_bytes,
                       std::uint64_t memory, std::uint64_t* kept) {
  const auto whole = [&](const std::string& file, std::uint64_t limit, const char* what) {
    try {
      return bytes.whole(file, limit);
    } catch (const FileError& error) {
      // A file that cannot be read, perhaps only now, is not damaged.
      if (error.number == ENOENT) throw RootDamage(store, what, file + " is not there");
      if (error.number == EFBIG && limit == current_limit) {
        throw RootDamage(store, what, file + " is larger than any of its kind");
      }
      if (error.number == EFBIG) {
        throw TooLarge(store + "/" + file, limit);
      }
      if (is_foreign(error.number)) throw RootDamage(store, what, error.what());
      throw;
    }
  };
  std::string current = text_of(whole(current_file, current_limit, current_file));
  for (int versions = 1;; ++versions) {
    const std::string named = named_by(current, store);
    const std::string file = manifest_file(named);
    std::vector<std::byte> content;
    try {
      content = whole(file, memory, manifest_name);
    } catch (const Error&) {
      // Another manifest may have been published since CURRENT was read, and this one removed.
      std::string now = text_of(whole(current_file, current_limit, current_file));
      if (now == current) throw;
      if (versions == most_versions) {
        throw Error::at(store, fmt::format("cannot open {}: its {} named {} manifests in turn, and none of them can be "
                                           "read; open it again later",
                                           store, current_file, versions));
      }
      current = std::move(now);
      continue;
    }
    if (sha256(content) != named) {
      throw RootDamage(store, manifest_name,
                       file + " is not what it was when it was written" +
                           (Store::is_address(store) ? ", or was cut off on the way" : ""));
    }
    if (hash != nullptr) *hash = named;
    if (text_bytes != nullptr) *text_bytes = content.size() + current.size();
    try {
      const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
      return parse_manifest(text, store + "/" + file, memory, kept);
    } catch (const NewerFormat&) {
      throw;
    } catch (const TooLarge&) {
      throw;
    } catch (const Error& error) {
      throw RootDamage(store, manifest_name, error.what());
    }
  }
}

std::string publish(const Folder& store, const Manifest& manifest) {
  return publish(store, to_text(manifest), manifest.format);
}

std::string publish(const Folder& store, std::string_view text, std::uint32_t format) {
  make_folder_in(store, "manifests");
  NewFile file(store, manifest_file("new"));
  file.write(std::as_bytes(std::span(text.data(), text.size())));
  const std::string hash = file.commit_by_hash();
  write_file(store, current_file, fmt::format("{}{}\n{}\n", current_start, format, hash));
  return hash;
}

}  // namespace roam::store
