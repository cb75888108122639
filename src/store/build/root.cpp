#include "store/build/root.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "store/authentic.h"
#include "store/build/plan.h"
#include "store/files.h"
#include "store/json_reader.h"

namespace roam::store {
namespace {

namespace fs = std::filesystem;

/// Files that may hold a manifest, the newest first.
std::vector<std::string> copies_of_manifests(const Folder& store) {
  std::vector<std::pair<fs::file_time_type, std::string>> found;
  std::error_code error;
  for (const char* folder : {"manifests", "spare"}) {
    for (std::string& file : files_in(store, folder)) {
      if (!is_named_by_hash(file, ".json")) continue;
      found.emplace_back(fs::last_write_time(store / file, error), std::move(file));
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> files;
  for (auto& [time, file] : found) files.push_back(std::move(file));
  return files;
}

/// Whether there is, or was, a root. A build that was never published has none.
bool has_root(const Folder& store) {
  try {
    if (!is_file(store, current_file)) refuse_to_open(store);
  } catch (const RootDamage&) {
    return true;
  } catch (const Error&) {
    return false;
  }
  return true;
}

std::string wrong_with_root(const Work& work) {
  try {
    if (!manifest_in_force(work)) refuse_to_open(work.store);
    return "";
  } catch (const RootDamage& damage) {
    return damage.what_is_damaged + ": " + damage.why;
  }
}

}  // namespace

std::string keep_spare(const Folder& store, const Manifest& manifest) {
  const std::string text = to_text(manifest);
  const std::string hash = sha256(std::as_bytes(std::span(text)));
  const std::string file = spare_file(hash);
  if (!size_of(store, file) || sha256_of_file(store, file) != hash) {
    make_folder_in(store, "spare");
    write_file(store, file, text);
  }
  return hash;
}

RootMending mend_root(Work& work, const std::optional<StoreKey>& key) {
  const Folder& store = work.store;
  const std::uint64_t memory = work.options.memory;
  RootMending mending;
  if (!has_root(store)) return mending;
  mending.wrong = wrong_with_root(work);
  if (mending.wrong.empty()) return mending;
  if (!holds_store(store)) {
    throw Error::at(
        store.string(),
        fmt::format("{} is no store: its file CURRENT is none of a store; choose another output", store.string()));
  }
  FileHashes hashes(store);
  for (const std::string& copy : copies_of_manifests(store)) {
    const std::string hash = fs::path(copy).stem().string();
    if (key && !has_code(*files_of(store), hash, *key)) continue;
    if (size_of(store, copy) > memory) throw TooLarge((store / copy).string(), memory);
    if (hashes.sha256(copy, [&](std::uint64_t) { work.tick(); }) != hash) continue;
    const std::vector<std::byte> bytes = read_file(store, copy, memory);
    std::optional<Manifest> manifest;
    try {
      manifest =
          parse_manifest({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, (store / copy).string(), memory);
    } catch (const NewerFormat&) {
      throw;
    } catch (const TooLarge&) {
      throw;
    } catch (const Error&) {
      continue;  // undamaged, but unusable
    }
    publish(store, *manifest);
    mending.mended = true;
    break;
  }
  return mending;
}

}  // namespace roam::store
