// Copies a store to where a web server serves it.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <system_error>
#include <vector>

#include "roam/error.h"
#include "roam/store_build.h"
#include "store/build/merge.h"
#include "store/build/output_folder.h"
#include "store/files.h"
#include "store/opened.h"

namespace roam {
namespace store {
namespace {

constexpr std::size_t copied_at_once = 1 << 20;

class Publisher {
 public:
  Publisher(const Store& from, const Folder& to, const std::function<bool(std::uint64_t, std::uint64_t)>& progress)
      : from_(from.state()), to_(to), progress_(progress) {
    done_.hash = from_.info.hash;
    for (const ShardInfo& shard : from_.manifest.shards) total_ += shard.bytes;
    std::set<std::string_view> files;  // parts of the same content share one
    for (const PartInfo& part : from_.manifest.parts) total_ += files.insert(part.file).second ? part.bytes : 0;
  }

  StorePublication run() {
    const std::vector<std::byte> manifest = copied();
    publish(to_, {reinterpret_cast<const char*>(manifest.data()), manifest.size()}, from_.manifest.format);
    return done_;
  }

 private:
  /// Copies all but the manifest, and returns that. Says that readers see no difference if it fails.
  std::vector<std::byte> copied() {
    try {
      return copy_all();
    } catch (const Error& error) {
      if (done_.files == 0) throw;
      throw Error::at(to_.string(), fmt::format("{}; for readers nothing has changed, and the next publication goes on "
                                                "from what is copied",
                                                error.what()));
    }
  }
  std::vector<std::byte> copy_all() {
    for (const char* folder : {"packs", "parts", "manifests"}) make_folder_in(to_, folder);
    for (const PartInfo& part : from_.manifest.parts) copy(part_file(part.file), part.file, part.bytes);
    for (const ShardInfo& shard : from_.manifest.shards) copy(pack_file(shard.pack), shard.pack, shard.bytes);
    std::vector<std::byte> manifest = from_.bytes->whole(manifest_file(done_.hash), Store::usual_memory);
    // A second request may have another answer than the first, such as the page of a login.
    if (sha256(manifest) != done_.hash) {
      throw Error::at(from_.name, fmt::format("cannot publish {}: {} is not what it was when the store was opened; "
                                              "publish again",
                                              from_.name, manifest_file(done_.hash)));
    }
    return manifest;
  }

  void tick(std::uint64_t bytes) {
    bytes_ += bytes;
    if (progress_ && !progress_(bytes_, total_)) throw Cancelled();
  }

  void copy(const std::string& name, const std::string& hash, std::uint64_t bytes) {
    if (!seen_.insert(name).second) return;
    if (size_of(to_, name) == bytes) {
      ++done_.present;
      tick(bytes);
      return;
    }
    NewFile file(to_, std::string(split(name).first) + "/new" + std::filesystem::path(name).extension().string());
    std::vector<std::byte> piece(static_cast<std::size_t>(std::min<std::uint64_t>(bytes, copied_at_once)));
    for (std::uint64_t at = 0; at < bytes; at += piece.size()) {
      piece.resize(static_cast<std::size_t>(std::min<std::uint64_t>(bytes - at, copied_at_once)));
      if (const char* problem = from_.bytes->read(name, at, piece)) {
        throw Error::at(from_.name, fmt::format("cannot publish {}: {}: {}", from_.name, name, problem));
      }
      file.write(piece);
      tick(piece.size());
    }
    if (!file.commit_if_hash_is(hash)) {
      throw Error::at(from_.name,
                      fmt::format("cannot publish {}: {} is damaged; `roam verify` says what is, and repairs "
                                  "it from the scene",
                                  from_.name, name));
    }
    ++done_.files;
    done_.bytes += bytes;
  }

  const Store::State& from_;
  const Folder& to_;
  const std::function<bool(std::uint64_t, std::uint64_t)>& progress_;
  std::set<std::string> seen_;
  std::uint64_t bytes_ = 0, total_ = 0;
  StorePublication done_;
};

/// The store that is in a folder, held: no files that it consists of are removed. Null if there is none, or a damaged
/// one.
std::shared_ptr<const Store> held_in(const Folder& folder) {
  try {
    if (is_file(folder, current_file)) return open_store(files_of(folder), folder.string());
  } catch (const Error&) {
  }
  return nullptr;
}

}  // namespace
}  // namespace store

StorePublication publish_store(const std::filesystem::path& store, const std::filesystem::path& folder,
                               const std::function<bool(std::uint64_t, std::uint64_t)>& progress,
                               const WebAccess& web) {
  if (Store::is_address(folder.native())) {
    throw Error::at(folder.string(),
                    fmt::format("cannot publish to {}: name the folder from which it is served", folder.string()));
  }
  const auto from = Store::open(store, Store::usual_memory, web);
  std::error_code none;
  const bool is_same_folder = std::filesystem::equivalent(store, folder, none);  // also through another mount
  if (!Store::is_address(store.native()) && (is_same_folder || store::is_inside(folder, store))) {
    throw Error::at(folder.string(), fmt::format("{} is the store itself, or lies in it; name the folder from which it "
                                                 "is served",
                                                 folder.string()));
  }
  store::Folder to(folder);
  store::OutputFolder output(to, true, {});
  const auto before = store::held_in(to);
  StorePublication done = store::Publisher(*from, to, progress).run();
  output.keep();
  // Another publication of the same version must not remove the one before it.
  const bool is_same = before && before->info().hash == done.hash;
  done.unchanged = is_same && done.files == 0;
  try {
    static_cast<void>(store::tidy(to, Store::usual_memory, is_same));
  } catch (const Error&) {
    if (!is_same) throw;  // else an older version is damaged, and all stays
  }
  return done;
}

}  // namespace roam
