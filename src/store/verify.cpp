#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <set>
#include <string_view>
#include <tuple>
#include <vector>

#include "math/parallel_floating_point.h"
#include "store/files.h"
#include "store/held.h"
#include "store/part_bytes.h"
#include "store/tile_reader.h"
#include "store/web/server.h"
#include "store/web_files.h"

namespace roam {
namespace store {
namespace {

/// Of a file on a web server, of which a few dozen pieces are read at once.
constexpr std::uint64_t piece_bytes = 256 << 10;

/// A failure of the network or the server: nothing is known of the file.
struct NotReached : Error {
  using Error::Error;
};

/// Whether a web server's answer tells that its file is not the one that was written.
bool is_damage(std::string_view problem) {
  return problem.find("404 or 410") != std::string_view::npos || problem == web::too_short;
}

class Verifier {
 public:
  /// `folder`: that of the store; null: it is on a web server.
  Verifier(std::shared_ptr<const Store> store, const Folder* folder,
           const std::function<bool(std::uint64_t, std::uint64_t)>& progress)
      : folder_(folder), store_(std::move(store)), state_(store_->state()), progress_(progress) {
    if (folder) hashes_ = std::make_unique<FileHashes>(*folder);
  }

  StoreVerification run() {
    check_files();
    const Manifest& manifest = state_.manifest;
    std::vector<std::uint64_t> first_page(manifest.shards.size());
    for (std::uint64_t p = state_.pages.size(); p-- > 0;) first_page[state_.pages[p].shard] = p;
    check_spare();
    // Over a network many reads are under way for each file already.
    tbb::task_arena arena(folder_ ? tbb::task_arena::automatic : 2);
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, parts_.size(), [&](std::size_t i) { check_part(*parts_[i]); });
      tbb::parallel_for(std::size_t{0}, manifest.shards.size(),
                        [&](std::size_t i) { check_shard(manifest.shards[i], first_page[i]); });
    });
    Box bounds;
    for (const ShardInfo& shard : manifest.shards) bounds.include(shard.bounds);
    if (bounds.lower != manifest.bounds.lower || bounds.upper != manifest.bounds.upper) {
      damage({"the manifest", "its bounds are not those of its shards", bounds});
    }
    if (geometry_hash_ != manifest.geometry_hash && report_.damage.empty()) {
      damage({"the manifest", "the triangles of all tiles are not those that it counts", manifest.bounds});
    }
    report_.bytes = done_;
    report_.tiles = tiles_;
    // Threads report in any order; the result is sorted.
    std::sort(report_.damage.begin(), report_.damage.end(), [](const StoreDamage& a, const StoreDamage& b) {
      return std::tie(a.what, a.why) < std::tie(b.what, b.why);
    });
    return std::move(report_);
  }

 private:
  /// Sums up the sizes of all files that the manifest names; every byte of them is hashed. Parts of the same content
  /// share a file, which is checked once.
  void check_files() {
    std::set<std::string_view> seen;
    for (const PartInfo& part : state_.manifest.parts) {
      if (!seen.insert(part.file).second) continue;
      parts_.push_back(&part);
      total_ += size_in(part_file(part.file), part.bytes);
    }
    for (const ShardInfo& shard : state_.manifest.shards) {
      total_ += size_in(pack_file(shard.pack), shard.bytes);
      packs_.insert(shard.pack);
    }
  }
  /// The size on disk, because the manifest may say anything.
  [[nodiscard]] std::uint64_t size_in(const std::string& file, std::uint64_t said) const {
    if (!folder_) return said;
    try {
      return size_of(*folder_, file).value_or(0);
    } catch (const Error&) {
      return 0;
    }
  }

  /// SHA-256 of a file that has this many bytes, or on the disk as many as it has.
  [[nodiscard]] std::string hash_of(const std::string& file, std::uint64_t bytes) {
    if (hashes_) return hashes_->sha256(file, [&](std::uint64_t read) { tick(read); });
    Sha256 hash;
    ReadAhead ahead(*state_.bytes);
    const auto piece = [&](std::uint64_t at) { return CheckedRange{file, at, std::min(bytes - at, piece_bytes)}; };
    for (std::uint64_t at = 0, begun = 0; at < bytes; at += piece_bytes) {
      for (begun = std::max(begun, at); begun < bytes && ahead.has_room(); begun += piece_bytes) {
        ahead.begin(piece(begun));
      }
      const ReadAhead::Result read = ahead.take(piece(at), {});
      if (read.problem) {
        demand_reached(file, read.problem);
        throw Error(read.problem);
      }
      hash.add(read.bytes);
      tick(read.bytes.size());
    }
    return hash.digits();
  }

  /// Throws NotReached for a problem of the network.
  void demand_reached(const std::string& what, const std::string& problem) const {
    if (folder_ || is_damage(problem)) return;
    throw NotReached(store_->name(), "cannot be verified: " + what + ": " + problem);
  }

  void tick(std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    done_ += bytes;
    if (cancelled_ || (progress_ && !progress_(done_, total_))) {
      cancelled_ = true;
      throw Cancelled();
    }
  }

  void damage(StoreDamage what) {
    const std::lock_guard lock(mutex_);
    report_.damage.push_back(std::move(what));
  }

  /// Older stores have no spare manifest, and web servers are not asked for it.
  void check_spare() {
    if (!folder_) return;
    const std::string& hash = state_.info.hash;
    const std::string file = spare_file(hash);
    try {
      if (!size_of(*folder_, file)) return;
      const std::string found = hashes_->sha256(file, [&](std::uint64_t) { tick(0); });
      if (found != hash) damage({file, "its SHA-256 is not its name", Box{}});
    } catch (const Error& error) {
      damage({file, error.what(), Box{}});
    }
  }

  void check_part(const PartInfo& part) {
    const std::string file = part_file(part.file);
    try {
      if (hash_of(file, part.bytes) != part.file) {
        throw Error("its SHA-256 is not its name");
      }
      PartVisitor visitor;
      visitor.enough = [&] {
        tick(0);
        return false;
      };
      PartBytes(state_, part).visit(std::move(visitor));
    } catch (const NotReached&) {
      throw;
    } catch (const PartUnread& error) {
      demand_reached(file, error.why);
      damage({file + " (" + part.name + ")", error.what(), Box{}});
    } catch (const Error& error) {
      damage({file + " (" + part.name + ")", error.what(), Box{}});
    }
  }

  void check_shard(const ShardInfo& shard, std::uint64_t first_page) {
    const std::string file = pack_file(shard.pack);
    std::string found;
    try {
      found = hash_of(file, shard.bytes);
      if (found != shard.pack) damage({file, "its SHA-256 is not its name", shard.bounds});
    } catch (const NotReached&) {
      throw;
    } catch (const Error& error) {
      damage({file, error.what(), shard.bounds});
      return;  // missing or unreadable
    }
    // Pages are checked even in a damaged pack, to find out which tiles are usable; but the same content only once, for
    // a file may have any number of names.
    if (found != shard.pack && !is_new(found)) return;
    TileReader reader(state_);
    ShardInfo counted;
    bool counts = true;
    for (std::uint64_t p = first_page; p < first_page + shard.pages.size(); ++p) {
      counts = check_page(p, reader, counted) && counts;
    }
    if (counts && (counted.triangles != shard.triangles || counted.tiles != shard.tiles ||
                   counted.geometry_hash != shard.geometry_hash || counted.largest_error != shard.largest_error)) {
      damage({file, "its triangles are not those that the manifest counts", shard.bounds});
    }
    const std::lock_guard lock(mutex_);
    geometry_hash_ += counted.geometry_hash;
  }

  /// Whether no pack of this content is checked under another name.
  [[nodiscard]] bool is_new(const std::string& hash) {
    const std::lock_guard lock(mutex_);
    return packs_.insert(hash).second;
  }

  bool check_page(std::uint64_t number, TileReader& reader, ShardInfo& counted) {
    const Box& box = state_.pages[number].ref.box;
    LoadedPage page;
    try {
      page = reader.page(number);
    } catch (const Unusable& error) {
      if (error.unread) demand_reached(name_of(number, box), error.why);
      damage({name_of(number, box), error.why, box});
      return false;
    }
    bool good = true;
    std::size_t expected = 0;
    for (std::uint32_t t = 0; t < page.view.tiles.size(); ++t) {
      for (; expected < page.view.tiles.size() && reader.expects_more(); ++expected) {
        reader.expect(number, page.view.tiles[expected]);
        reader.expect_numbers(number, page.view.tiles[expected]);
      }
      const TileEntry& entry = page.view.tiles[t];
      try {
        check_tile(number, entry, t, reader);
        ++tiles_;
        ++counted.tiles;
        counted.triangles += entry.triangles;
        counted.geometry_hash += entry.geometry_hash;
        counted.largest_error = std::max(counted.largest_error, double(entry.fine_error));
      } catch (const Unusable& error) {
        if (error.unread) demand_reached(name_of(number, t, box_of(entry)), error.why);
        damage({name_of(number, t, box_of(entry)), error.why, box_of(entry)});
        good = false;
      } catch (const NotReached&) {
        throw;
      } catch (const Error& error) {
        damage({name_of(number, t, box_of(entry)), error.what(), box_of(entry)});
        good = false;
      }
    }
    return good;
  }

  void check_tile(std::uint64_t page, const TileEntry& entry, std::uint32_t number, TileReader& reader) const {
    // Both before any check: all that is expected is read.
    const std::string numbers_problem = problem_of_numbers(page, entry, number, reader);
    const LoadedTile tile = reader.tile(page, entry, number);
    if (geometry_hash(tile.tile, tile.leaves, tile.fine) != entry.geometry_hash) {
      throw Error("its triangles are not those that its entry counts");
    }
    if (!numbers_problem.empty()) throw Error(numbers_problem);
  }

  /// Empty: there is none.
  std::string problem_of_numbers(std::uint64_t page, const TileEntry& entry, std::uint32_t number,
                                 TileReader& reader) const {
    try {
      static_cast<void>(reader.numbers(page, entry, number));
      return {};
    } catch (const Unusable& error) {
      if (error.unread) demand_reached(name_of(page, number, box_of(entry)), error.why);
      return "the numbers of its triangles in the scene: " + error.why;
    } catch (const Error& error) {
      return error.what();
    }
  }

  const Folder* const folder_;
  std::unique_ptr<FileHashes> hashes_;
  const std::shared_ptr<const Store> store_;
  const Store::State& state_;
  const std::function<bool(std::uint64_t, std::uint64_t)>& progress_;
  std::mutex mutex_;
  StoreVerification report_;
  std::vector<const PartInfo*> parts_;  ///< of different content
  std::set<std::string> packs_;         ///< SHA-256 of all that are checked
  bool cancelled_ = false;
  std::uint64_t done_ = 0, total_ = 0;
  std::atomic<std::uint64_t> tiles_{0};
  std::uint64_t geometry_hash_ = 0;
};

}  // namespace

Folder hold_store(const std::filesystem::path& folder) {
  try {
    return Folder::held(folder, true);
  } catch (const FileError&) {
    refuse_to_open(folder);
  }
}

namespace {

StoreVerification verified(const auto& open, const Folder* folder,
                           const std::function<bool(std::uint64_t, std::uint64_t)>& progress) {
  StoreVerification nothing;
  try {
    return in_default_floating_point([&] { return Verifier(open(), folder, progress).run(); });
  } catch (const NotComplete&) {
    nothing.complete = false;
  } catch (const RootDamage& damage) {
    nothing.damage.push_back({damage.what_is_damaged, damage.why, Box{}});
  }
  return nothing;
}

}  // namespace

StoreVerification verify_store(const Folder& folder, const std::function<bool(std::uint64_t, std::uint64_t)>& progress,
                               std::uint64_t memory) {
  return verified([&] { return open_store(folder, memory); }, &folder, progress);
}

}  // namespace store

StoreVerification verify_store(const std::filesystem::path& folder,
                               const std::function<bool(std::uint64_t, std::uint64_t)>& progress,
                               const WebAccess& web) {
  if (Store::is_address(folder.native())) {
    return store::verified([&] { return Store::open(folder, Store::usual_memory, web); }, nullptr, progress);
  }
  return store::verify_store(store::hold_store(folder), progress);
}

}  // namespace roam
