// A hostile child: whatever roam-reader sends, the program takes a scene, or ends with a message.
#include "display_part_made.h"
#include "import/part_format.h"
#include "import/stream.h"
#include "reading.h"

namespace fuzz {
namespace {

using namespace roam::reader;

/// Kinds of frames in the input that stand for several: the end with true totals, and a part with its bytes.
constexpr std::uint8_t true_end = 200, whole_part = 201;

/// Frames with right headers, so that mutations are about what the frames say.
class Frames {
 public:
  void add(FrameKind kind, std::span<const std::byte> payload) {
    const FrameHeader header{frame_magic, kind, 0, number_++, static_cast<std::uint32_t>(payload.size())};
    stream_.append(reinterpret_cast<const char*>(&header), sizeof header);
    stream_ += text_of(payload);
    if (kind == FrameKind::vertices) totals_.vertices += payload.size() / sizeof(roam::Vec3);
    if (kind == FrameKind::triangles) totals_.triangles += payload.size() / sizeof(std::array<std::uint32_t, 3>);
  }
  void add(FrameKind kind, const PayloadWriter& payload) { add(kind, payload.bytes()); }
  void add_part(std::uint64_t triangles, std::span<const std::byte> bytes) {
    const PartHeader header{{1000, 0, 0}, {0, 0, 0}, {1, 1, 1}, triangles, bytes.size()};
    add(FrameKind::part, PayloadWriter().add(header));
    add(FrameKind::part_bytes, bytes);
    totals_.triangles += triangles;
  }
  void end() { add(FrameKind::end, PayloadWriter().add(totals_).add(std::uint32_t{0})); }
  [[nodiscard]] const std::string& stream() const { return stream_; }

 private:
  std::string stream_;
  std::uint32_t number_ = 0;
  Totals totals_;
};

/// The first byte says what is wanted of the child, and whether the rest is a stream or frames: kind, u16 bytes of the
/// payload, payload. A greeting goes before.
void run_protocol(Bytes input) {
  Values values(input);
  const auto choice = values.take<std::uint8_t>();
  const auto wanted = static_cast<Wanted>(choice % 3);
  if (choice / 3 % 2 != 0) {
    (void)taken(text_of(values.rest()), wanted, true);
    return;
  }
  Frames frames;
  frames.add(FrameKind::hello, PayloadWriter().add(Greeting{}));
  while (!values.empty()) {
    const auto kind = values.take<std::uint8_t>();
    const auto payload = std::as_bytes(values.take(values.take<std::uint16_t>()));
    if (kind == true_end) {
      frames.end();
    } else if (kind == whole_part) {
      const std::size_t number = std::min<std::size_t>(payload.size(), 1);
      frames.add_part(number == 0 ? 0 : std::to_integer<std::uint64_t>(payload[0]), payload.subspan(number));
    } else {
      frames.add(static_cast<FrameKind>(kind % 20), payload);
    }
  }
  (void)taken(frames.stream(), wanted, true);
}

std::string frame_of(std::uint8_t kind, std::string_view payload = {}) {
  const auto size = static_cast<std::uint16_t>(payload.size());
  return std::string(1, static_cast<char>(kind)) + std::string(reinterpret_cast<const char*>(&size), sizeof size) +
         std::string(payload);
}
std::string frame_of(FrameKind kind, const PayloadWriter& payload) {
  return frame_of(static_cast<std::uint8_t>(kind), text_of(payload.bytes()));
}

std::vector<std::string> protocol_seeds() {
  const auto corner = [](double x, double y) { return roam::Vec3(x, y, 0.0); };
  const std::string object =
      frame_of(FrameKind::object, PayloadWriter().add_text("wall").add(std::uint8_t{0})) +
      frame_of(FrameKind::vertices, PayloadWriter().add(corner(0, 0)).add(corner(1, 0)).add(corner(0, 1))) +
      frame_of(FrameKind::triangles, PayloadWriter().add(std::array<std::uint32_t, 3>{0, 1, 2}));
  const std::string described =
      frame_of(FrameKind::opened, PayloadWriter().add_text("/a.obj")) +
      frame_of(FrameKind::outside, PayloadWriter().add_text("/etc/passwd")) +
      frame_of(FrameKind::looked_up, PayloadWriter().add_text("/a.mtl").add(LookedUp{9, 1, 1})) +
      frame_of(FrameKind::progress, PayloadWriter().add(std::uint64_t{9})) +
      frame_of(FrameKind::georeference, PayloadWriter().add(corner(5, 6)).add_text("EPSG:1")) +
      frame_of(FrameKind::left_out,
               PayloadWriter().add(std::uint8_t{1}).add_text("door").add(std::uint64_t{3}).add(std::uint64_t{1})) +
      frame_of(FrameKind::missing_page, PayloadWriter().add_text("b.osgb")) +
      frame_of(FrameKind::note, PayloadWriter().add_text("A note."));
  const roam::DisplayPart part = roam::test::full_part();
  const std::string shown = frame_of(whole_part, static_cast<char>(part.triangles) + text_of(encode(part))) +
                            frame_of(FrameKind::missing_texture, PayloadWriter().add_text("wall.png"));
  Frames raw;
  raw.add(FrameKind::hello, PayloadWriter().add(Greeting{}));
  raw.add(FrameKind::failure, PayloadWriter().add_text("a.obj:7").add_text("a.obj:7: so"));
  return {'\0' + described + object + frame_of(true_end), '\1' + object + object + frame_of(true_end),
          '\2' + shown + frame_of(true_end), '\3' + raw.stream()};
}

const Known protocol_target({"protocol", run_protocol, protocol_seeds, {"RMR1"}});

}  // namespace
}  // namespace fuzz
