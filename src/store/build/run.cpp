#include "store/build/run.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>

#include "roam/error.h"
#include "store/build/curve.h"
#include "store/files.h"

namespace roam::store {
namespace {

constexpr char run_magic[8] = {'r', 'o', 'a', 'm', 'r', 'u', 'n', '1'};
/// Blocks encoded in parallel before they are written.
constexpr std::size_t blocks_at_once = 32;

constexpr const char* too_short = "it is too short";

/// The head of a block. The vertices follow, then three 16-bit corners of each triangle, then a 32-bit number of each.
struct BlockHeader {
  std::uint32_t triangles;
  std::uint32_t vertices : 31;
  std::uint32_t floats : 1;  ///< the coordinates are floats, which are exact for all of them
};
static_assert(sizeof(BlockHeader) == 8);

std::size_t block_bytes(const BlockHeader& header) {
  const std::size_t vertex = 3 * (header.floats != 0 ? sizeof(float) : sizeof(double));
  return sizeof header + header.vertices * vertex + header.triangles * std::size_t{3 * 2 + 4};
}
/// The size of a full block whose triangles share no vertex.
constexpr std::size_t most_block_bytes = sizeof(BlockHeader) + block_triangles * std::size_t{3 * 24 + 3 * 2 + 4};

bool all_floats(std::span<const Vec3> vertices) {
  for (const Vec3& v : vertices) {
    for (int k = 0; k < 3; ++k) {
      if (double(static_cast<float>(v[k])) != v[k]) return false;
    }
  }
  return true;
}

/// Assigns each vertex an index in the block's table.
class LocalVertices {
 public:
  void clear() {
    slots_.assign(slots, {});
    vertices.clear();
  }
  std::uint16_t add(std::uint32_t vertex, const std::vector<Vec3>& all) {
    for (std::uint32_t at = vertex * 2654435761U >> (32 - bit_count);; at = (at + 1) % slots) {
      Slot& slot = slots_[at];
      if (slot.used && slot.vertex == vertex) return slot.place;
      if (slot.used) continue;
      slot = {vertex, static_cast<std::uint16_t>(vertices.size()), true};
      vertices.push_back(all[vertex]);
      return slot.place;
    }
  }
  std::vector<Vec3> vertices;

 private:
  static constexpr std::uint32_t bit_count = 13, slots = 1u << bit_count;
  static_assert(slots > 3 * block_triangles);
  struct Slot {
    std::uint32_t vertex = 0;
    std::uint16_t place = 0;
    bool used = false;
  };
  std::vector<Slot> slots_;
};

std::vector<std::byte> encode_block(const RunContent& run, std::span<const RunItem> items) {
  static thread_local LocalVertices local;
  local.clear();
  std::vector<std::uint16_t> corners;
  std::vector<std::uint32_t> numbers;
  corners.reserve(3 * items.size());
  numbers.reserve(items.size());
  for (const RunItem& item : items) {
    for (const std::uint32_t v : run.triangles[item.triangle]) corners.push_back(local.add(v, run.vertices));
    numbers.push_back(item.triangle);
  }
  const bool floats = all_floats(local.vertices);
  const BlockHeader header{static_cast<std::uint32_t>(items.size()),
                           static_cast<std::uint32_t>(local.vertices.size()) & 0x7fffffffU, floats};
  std::vector<std::byte> bytes(block_bytes(header));
  std::byte* at = bytes.data();
  const auto put = [&at](const void* from, std::size_t size) {
    std::memcpy(at, from, size);
    at += size;
  };
  put(&header, sizeof header);
  for (const Vec3& v : local.vertices) {
    if (floats) {
      const float f[3] = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
      put(f, sizeof f);
    } else {
      const double d[3] = {v.x, v.y, v.z};
      put(d, sizeof d);
    }
  }
  put(corners.data(), corners.size() * 2);
  put(numbers.data(), numbers.size() * 4);
  return bytes;
}

}  // namespace

struct RunReader::Footer {
  char magic[8];
  std::uint64_t first_number;
  std::uint64_t index_offset;
  std::uint64_t index_hash;
  std::uint64_t blocks;
  std::uint64_t zero;
  std::uint64_t hash;  ///< of all members before it

  /// Whether this is the end of a whole run file of so many bytes.
  [[nodiscard]] bool is_right(std::uint64_t bytes) const {
    return std::memcmp(magic, run_magic, sizeof run_magic) == 0 && hash == hash_of_members() && index_offset <= bytes &&
           blocks <= bytes / sizeof(Entry) && index_offset + blocks * sizeof(Entry) + sizeof(Footer) == bytes;
  }
  [[nodiscard]] std::uint64_t hash_of_members() const {
    return xxh3(std::as_bytes(std::span(this, 1)).first(offsetof(Footer, hash)));
  }
};

std::vector<RunItem> sort_run(const RunContent& run) {
  std::vector<RunItem> items(run.triangles.size());
  tbb::parallel_for(std::size_t{0}, items.size(), [&](std::size_t i) {
    items[i] = {place_of(run.triangle(i)).key, static_cast<std::uint32_t>(i)};
  });
  tbb::parallel_sort(items.begin(), items.end(), [](const RunItem& a, const RunItem& b) {
    return a.key != b.key ? a.key < b.key : a.triangle < b.triangle;
  });
  return items;
}

std::uint64_t write_run(const Folder& store, const std::string& name, const RunContent& run,
                        std::span<const RunItem> items) {
  NewFile out(store, name);
  const std::size_t blocks = (items.size() + block_triangles - 1) / block_triangles;
  std::vector<RunReader::Entry> index(blocks);
  std::vector<std::vector<std::byte>> encoded(blocks_at_once);
  for (std::size_t first = 0; first < blocks; first += blocks_at_once) {
    const std::size_t count = std::min(blocks_at_once, blocks - first);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      const std::size_t begin = (first + i) * block_triangles;
      const auto block = items.subspan(begin, std::min<std::size_t>(block_triangles, items.size() - begin));
      encoded[i] = encode_block(run, block);
      index[first + i] = {
          block.front().key, 0, xxh3(encoded[i]), static_cast<std::uint32_t>(encoded[i].size()), {0, 0, 0}};
    });
    for (std::size_t i = 0; i < count; ++i) {
      index[first + i].offset = out.size();
      out.write(encoded[i]);
    }
  }
  const auto index_bytes = std::as_bytes(std::span(index));
  RunReader::Footer footer{};
  std::memcpy(footer.magic, run_magic, sizeof run_magic);
  footer.first_number = run.first;
  footer.index_offset = out.size();
  footer.index_hash = xxh3(index_bytes);
  footer.blocks = blocks;
  footer.hash = footer.hash_of_members();
  out.write(index_bytes);
  out.write(std::as_bytes(std::span(&footer, 1)));
  out.commit();
  return footer.hash;
}

bool is_run(const Folder& store, const std::string& name, std::uint64_t hash) {
  const Descriptor file = open_file(store, name, O_RDONLY);
  if (!file.is_open() && is_foreign(errno)) fail("read", store, name, errno);
  struct stat status {};
  RunReader::Footer footer{};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0) return false;
  const auto size = static_cast<std::uint64_t>(status.st_size);
  const auto end = std::as_writable_bytes(std::span(&footer, 1));
  return size >= end.size() && files::read_fully(file.number(), size - end.size(), end) == end.size() &&
         footer.is_right(size) && footer.hash == hash;
}

RunReader::RunReader(const Folder& store, const std::string& name, std::uint64_t hash)
    : store_(store), name_(name), hash_(hash), descriptor_(open_file(store, name, O_RDONLY)) {
  if (!descriptor_.is_open()) fail_to_read();
  if (const char* const damage = load()) refuse(damage);
}

const char* RunReader::load() {
  struct stat status {};
  Footer footer{};
  if (::fstat(descriptor_.number(), &status) != 0) fail_to_read();
  number_ = {status.st_dev, status.st_ino};
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size < sizeof footer || !get(size - sizeof footer, std::as_writable_bytes(std::span(&footer, 1)))) {
    return too_short;
  }
  if (!footer.is_right(size)) return "its end is damaged";
  if (footer.hash != hash_) {
    const std::string file = (store_ / name_).string();
    throw Error::at(file,
                    fmt::format("{} is not the one of the plan: its part was read again since; plan again", file));
  }
  first_number_ = footer.first_number;
  index_.resize(static_cast<std::size_t>(footer.blocks));
  const auto bytes = std::as_writable_bytes(std::span(index_));
  if (!get(footer.index_offset, bytes)) return too_short;
  const bool fits =
      std::all_of(index_.begin(), index_.end(), [](const Entry& e) { return e.bytes <= most_block_bytes; });
  return fits && xxh3(bytes) == footer.index_hash ? nullptr : "its index is damaged";
}

RunReader::Range RunReader::blocks(CurveKey first, CurveKey last) const {
  // A block that begins at or before `first` may reach beyond it; several may begin at `first`.
  const auto begin =
      std::lower_bound(index_.begin(), index_.end(), first, [](const Entry& e, CurveKey key) { return e.first < key; });
  const auto end =
      std::upper_bound(index_.begin(), index_.end(), last, [](CurveKey key, const Entry& e) { return key < e.first; });
  const auto b = static_cast<std::size_t>(begin - index_.begin());
  return {b > 0 ? b - 1 : 0, static_cast<std::size_t>(end - index_.begin())};
}

void RunReader::read(std::size_t block, RunBlock& out) const {
  if (!decode(block, out)) refuse("a block of it is damaged");
}

bool RunReader::decode(std::size_t block, RunBlock& out) const {
  const Entry& entry = index_[block];
  out.bytes.resize(entry.bytes);
  if (!get(entry.offset, out.bytes) || xxh3(out.bytes) != entry.hash) return false;
  const std::byte* at = out.bytes.data();
  const auto take = [&at](void* to, std::size_t size) {
    std::memcpy(to, at, size);
    at += size;
  };
  BlockHeader header{};
  if (out.bytes.size() < sizeof header) return false;
  take(&header, sizeof header);
  if (header.triangles > block_triangles || header.vertices > 3 * block_triangles ||
      out.bytes.size() != block_bytes(header)) {
    return false;
  }
  out.vertices.resize(header.vertices);
  for (Vec3& v : out.vertices) {
    if (header.floats != 0) {
      float f[3];
      take(f, sizeof f);
      v = {f[0], f[1], f[2]};
    } else {
      double d[3];
      take(d, sizeof d);
      v = {d[0], d[1], d[2]};
    }
  }
  out.triangles.resize(header.triangles);
  for (Triangle& t : out.triangles) {
    std::uint16_t corners[3];
    take(corners, sizeof corners);
    for (int c = 0; c < 3; ++c) {
      if (corners[c] >= out.vertices.size()) return false;
      t[c] = out.vertices[corners[c]];
    }
  }
  out.numbers.resize(header.triangles);
  for (std::uint64_t& n : out.numbers) {
    std::uint32_t number = 0;
    take(&number, sizeof number);
    n = first_number_ + number;
  }
  return true;
}

/// False at the end of the file.
bool RunReader::get(std::uint64_t offset, std::span<std::byte> out) const {
  if (files::read_fully(descriptor_.number(), offset, out) == out.size()) return true;
  if (errno != 0) fail_to_read();
  return false;
}

void RunReader::fail_to_read() const {
  if (errno != ENOENT) fail("read", store_, name_, errno);
  const std::string file = (store_ / name_).string();
  throw Error::at(file, fmt::format("{} is gone: plan or build again, and its part is read again", file));
}

/// Whether the file of this name still is this one, and damaged: not only in what this machine remembers of it.
bool RunReader::is_still_damaged() const {
  RunReader anew(store_, name_, hash_, open_file(store_, name_, O_RDONLY));
  if (!anew.descriptor_.is_open()) anew.fail_to_read();
  ::posix_fadvise(anew.descriptor_.number(), 0, 0, POSIX_FADV_DONTNEED);
  const bool ends_right = anew.load() == nullptr;
  if (anew.number_ != number_) return false;
  RunBlock block;
  bool right = ends_right;
  for (std::size_t i = 0; right && i < anew.index_.size(); ++i) right = anew.decode(i, block);
  return !right;
}

void RunReader::refuse(const char* why) const {
  const std::string file = (store_ / name_).string();
  if (!is_still_damaged()) {
    throw Error::at(file, fmt::format("{} was read wrongly ({}), and is right when read again: build again; if that "
                                      "happens on one machine only, check its memory and its network",
                                      file, why));
  }
  remove_file(store_, name_);
  throw Error::at(
      file,
      fmt::format("{} was damaged ({}), and is removed: plan or build again, and its part is read again", file, why));
}

}  // namespace roam::store
