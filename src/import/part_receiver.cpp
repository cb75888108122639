#include "import/part_receiver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "import/part_format.h"
#include "roam/error.h"
#include "roam/mesh.h"

namespace roam::reader {
namespace {

constexpr std::uint64_t reserve_limit = 256u << 20;

}  // namespace

PartReceiver::PartReceiver(DisplayReport& report, std::optional<Vec3>& origin, std::size_t ignore_patterns,
                           std::uint64_t part_bytes, const std::function<bool(DisplayPart&&)>& give)
    : StreamReceiver(report.import, ignore_patterns, part_bytes),
      display_(report),
      origin_(origin),
      give_(give),
      part_bytes_(part_bytes) {}

void PartReceiver::take_content(FrameKind kind, std::span<const std::byte> payload) {
  if (kind == FrameKind::part) return begin_part(payload);
  if (kind == FrameKind::part_bytes) {
    if (payload.size() > bytes_missing_) throw StreamDamaged{"bytes of no part"};
    count_bytes(payload.size());
    bytes_taken_ += payload.size();
    bytes_.insert(bytes_.end(), payload.begin(), payload.end());
    bytes_missing_ -= payload.size();
    if (bytes_missing_ == 0) finish_part();
    return;
  }
  if (kind != FrameKind::missing_texture) throw StreamDamaged{"a frame of unknown kind"};
  PayloadReader fields(payload);
  take_name(fields, display_.missing_texture_files);
  if (!fields.complete()) throw StreamDamaged{"a frame of broken length"};
}

void PartReceiver::begin_part(std::span<const std::byte> payload) {
  if (bytes_missing_ > 0) throw StreamDamaged{"a part that is not whole"};
  PayloadReader fields(payload);
  const auto header = fields.take<PartHeader>();
  if (!fields.complete() || header.bytes == 0) throw StreamDamaged{"a frame of broken length"};
  part_ = {};
  part_.triangles = header.triangles;
  for (int k = 0; k < 3; ++k) {
    part_.origin[k] = header.origin[k];
    part_.bounds.lower[k] = header.lower[k];
    part_.bounds.upper[k] = header.upper[k];
    // False for a NaN too. Files of pages state their own bounds, which may be too large.
    constexpr double limit = 4.0 * coordinate_limit;
    if (!(std::abs(header.origin[k]) <= coordinate_limit && std::abs(header.lower[k]) <= limit &&
          std::abs(header.upper[k]) <= limit && header.lower[k] <= header.upper[k])) {
      throw StreamDamaged{"a part without a place"};
    }
  }
  if (origin_ && *origin_ != part_.origin) throw StreamDamaged{"parts of several origins"};
  // The bytes of a part and the part decoded from them are in memory together for a moment.
  if (header.bytes > (part_bytes_ - bytes_taken_) / 2) throw ContentTooLarge{};
  bytes_missing_ = header.bytes;
  // A header may promise more bytes than ever arrive.
  bytes_.clear();
  bytes_.reserve(std::min<std::uint64_t>(header.bytes, reserve_limit));
}

void PartReceiver::finish_part() {
  // Many small objects take more memory in the display than in the stream. What is decoded takes less than a node does.
  decode(bytes_, part_, part_bytes_ - bytes_taken_);
  // The caller of `give` allocates in turn, so free these bytes first.
  std::vector<std::byte>().swap(bytes_);
  count_bytes(part_.node_bytes());
  bytes_taken_ += part_.node_bytes();
  const bool paged = !part_.pages.empty();
  origin_ = part_.origin;
  triangles_ += part_.triangles;
  display_.origin = part_.origin;
  display_.bounds.include(part_.bounds);
  ++display_.parts;
  display_.triangles += part_.triangles;
  display_.import.triangles += part_.triangles;
  display_.paged = display_.paged || paged;
  if (!give_(std::move(part_))) throw Cancelled();
  part_ = {};
}

void PartReceiver::finish_content(const Totals& totals) {
  if (bytes_missing_ > 0) throw StreamDamaged{"a part that is not whole"};
  if (totals.triangles != triangles_) throw StreamDamaged{"totals that are not those of its parts"};
  display_.textures += totals.textures;
  display_.missing_textures += totals.missing_textures;
}

}  // namespace roam::reader
