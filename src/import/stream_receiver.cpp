#include "import/stream_receiver.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "import/processor_budget.h"
#include "import/scene_scope.h"
#include "text/cut.h"
#include "text/printable.h"

namespace roam::reader {
namespace {

/// The least room for new bytes: the size of the pipe.
constexpr std::size_t room_bytes = 1u << 20;
/// An incomplete frame and room for more, so that bytes are seldom moved.
constexpr std::size_t buffer_bytes = payload_limit + 2 * room_bytes;

/// Most notes that one reader may send.
constexpr std::size_t note_limit = 100;

}  // namespace

StreamReceiver::StreamReceiver(ImportReport& report, std::size_t ignore_patterns, std::uint64_t content_bytes)
    : report_(report),
      ignore_patterns_(ignore_patterns),
      content_bytes_left_(content_bytes),
      buffer_(std::make_unique_for_overwrite<std::byte[]>(buffer_bytes)),
      bad_objects_{report.bad_objects},
      ignored_objects_{report.ignored_objects} {}

/// Adds to the entry of the same name, or adds an entry if there is room.
void StreamReceiver::LeftOutObjects::add(LeftOutObject&& object) {
  for (std::size_t i = places.size(); i < list.size(); ++i) places.try_emplace(list[i].name, i);
  if (const auto known = places.find(object.name); known != places.end()) {
    list[known->second].vertices += object.vertices;
    list[known->second].triangles += object.triangles;
  } else if (list.size() < ImportReport::name_limit) {
    list.push_back(std::move(object));
  }
}

std::span<std::byte> StreamReceiver::room() {
  if (buffer_bytes - end_ < room_bytes) {
    std::memmove(buffer_.get(), buffer_.get() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  return {buffer_.get() + end_, buffer_bytes - end_};
}

void StreamReceiver::take(std::size_t count) {
  end_ += count;
  while (end_ - begin_ >= sizeof(FrameHeader)) {
    FrameHeader header;
    std::memcpy(&header, buffer_.get() + begin_, sizeof(header));
    if (header.magic != frame_magic || header.zero != 0 || header.bytes > payload_limit) {
      throw StreamDamaged{"bytes that are no frame"};
    }
    if (header.number != next_number_) throw StreamDamaged{"frames out of order"};
    if ((header.number == 0) != (header.kind == FrameKind::hello)) throw StreamDamaged{"no greeting"};
    if (ended_) throw StreamDamaged{"frames after the end"};
    if (end_ - begin_ - sizeof(header) < header.bytes) return;
    const std::span payload(buffer_.get() + begin_ + sizeof(header), header.bytes);
    ++next_number_;
    begin_ += sizeof(header) + header.bytes;
    handle(header, payload);
  }
  if (begin_ == end_) begin_ = end_ = 0;
}

void StreamReceiver::handle(const FrameHeader& header, std::span<const std::byte> payload) {
  switch (header.kind) {
    case FrameKind::object:
    case FrameKind::vertices:
    case FrameKind::triangles:
    case FrameKind::part:
    case FrameKind::part_bytes:
      return take_content(header.kind, payload);
    default:
      break;
  }
  const double before = processor_seconds();
  take_description(header, payload);
  own_seconds_ += processor_seconds() - before;
}

void StreamReceiver::take_description(const FrameHeader& header, std::span<const std::byte> payload) {
  PayloadReader fields(payload);
  switch (header.kind) {
    case FrameKind::hello:
      take_hello(fields);
      break;
    case FrameKind::opened: {
      std::string file = fields.take_text();
      if (file.size() > longest_path) throw StreamDamaged{"a path that is too long"};
      opened_.push_back(std::move(file));
      break;
    }
    case FrameKind::looked_up:
      take_looked_up(fields);
      break;
    case FrameKind::outside:
      ++report_.outside_references;
      take_name(fields, report_.outside_files);
      break;
    case FrameKind::progress:
      bytes_read_ = fields.take<std::uint64_t>();
      break;
    case FrameKind::georeference: {
      Georeference georeference;
      georeference.origin = fields.take<Vec3>();
      georeference.srs = fields.take_text();
      for (int k = 0; k < 3; ++k) {
        if (!std::isfinite(georeference.origin[k])) throw StreamDamaged{"a place that is not finite"};
      }
      if (!report_.georeference) report_.georeference = std::move(georeference);
      break;
    }
    case FrameKind::unit: {
      const auto unit = fields.take<LengthUnit>();
      if (static_cast<std::size_t>(unit) >= length_unit_names.size()) throw StreamDamaged{"an unknown unit"};
      if (!report_.stated_unit) report_.stated_unit = unit;
      break;
    }
    case FrameKind::left_out:
      take_left_out(fields);
      break;
    case FrameKind::missing_page:
      take_name(fields, report_.missing_page_files);
      break;
    case FrameKind::note: {
      const std::string sentence = fields.take_text();
      if (report_.notes.size() < note_limit) report_.notes.push_back(printable(spelt(sentence), longest_sentence));
      break;
    }
    case FrameKind::failure: {
      const std::string place = printable(spelt(fields.take_text()), longest_sentence);
      const std::string sentence = printable(spelt(fields.take_text()), longest_sentence);
      if (!fields.complete()) break;
      ended_ = true;
      throw Error::at(place, sentence);
    }
    case FrameKind::end:
      take_end(fields);
      break;
    default:
      return take_content(header.kind, payload);
  }
  if (!fields.complete()) throw StreamDamaged{"a frame of broken length"};
}

void StreamReceiver::take_name(PayloadReader& fields, std::vector<std::string>& names) {
  std::string name = fields.take_text();
  if (names.size() < ImportReport::name_limit) names.push_back(std::move(name));
}

std::string StreamReceiver::take_object_name(PayloadReader& fields) {
  return cut_text(fields.take_text(), object_name_limit);
}

void StreamReceiver::count_bytes(std::size_t bytes) {
  if (bytes > content_bytes_left_) throw ContentTooLarge{};
  content_bytes_left_ -= bytes;
}

void StreamReceiver::take_hello(PayloadReader& fields) {
  const auto greeting = fields.take<Greeting>();
  if (!fields.complete() || greeting.version != stream_version) throw StreamDamaged{"another version of the stream"};
  const Confinement before = report_.confinement.value_or(Confinement{greeting.landlock, true, true, true, true});
  report_.confinement =
      Confinement{std::min(greeting.landlock, before.landlock), greeting.system_calls != 0 && before.system_calls,
                  greeting.no_new_privileges != 0 && before.no_new_privileges, greeting.limits != 0 && before.limits,
                  greeting.empty_folder != 0 && before.empty_folder};
}

void StreamReceiver::take_looked_up(PayloadReader& fields) {
  std::string file = fields.take_text();
  const auto state = fields.take<LookedUp>();
  if (file.size() > longest_path) throw StreamDamaged{"a path that is too long"};
  if (!fields.complete() || look_ups_ == nullptr || !*look_ups_) return;
  (*look_ups_)({std::move(file), state.found != 0, state.bytes, state.changed_ns});
}

void StreamReceiver::spell(std::string readers_name, std::string users_name) {
  readers_name_ = std::move(readers_name);
  users_name_ = std::move(users_name);
}

std::string StreamReceiver::spelt(std::string sentence) const {
  if (readers_name_.empty() || readers_name_ == users_name_) return sentence;
  for (std::size_t at = 0; (at = sentence.find(readers_name_, at)) != std::string::npos; at += users_name_.size()) {
    sentence.replace(at, readers_name_.size(), users_name_);
  }
  return sentence;
}

void StreamReceiver::take_left_out(PayloadReader& fields) {
  const auto reason = fields.take<LeftOutReason>();
  LeftOutObject object;
  object.name = take_object_name(fields);
  object.vertices = fields.take<std::uint64_t>();
  object.triangles = fields.take<std::uint64_t>();
  const bool bad = reason == LeftOutReason::bad_vertices;
  // A sum that wraps around would be small.
  constexpr std::uint64_t most = std::uint64_t{1} << 62;
  left_out_triangles_ = std::min(left_out_triangles_ + std::min(object.triangles, most), most);
  (bad ? bad_objects_ : ignored_objects_).add(std::move(object));
}

void StreamReceiver::take_end(PayloadReader& fields) {
  const auto totals = fields.take<Totals>();
  if (fields.take<std::uint32_t>() != ignore_patterns_) throw StreamDamaged{"totals of other patterns"};
  for (std::size_t i = 0; i < ignore_patterns_; ++i) matched_.push_back(fields.take<std::uint8_t>() != 0);
  finish_content(totals);
  report_.files += totals.files;
  report_.bad_vertices += totals.bad_vertices;
  report_.bad_triangles += totals.bad_triangles;
  report_.ignored_triangles += totals.ignored_triangles;
  report_.missing_pages += totals.missing_pages;
  ended_ = true;
}

}  // namespace roam::reader
