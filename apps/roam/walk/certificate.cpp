#include "walk/certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/output_file.h"
#include "cli/tell.h"
#include "files/whole_file.h"
#include "roam/error.h"

namespace roam::app {
namespace {

using verification::Piece;

/// Pieces in memory at a time: 0.4 MB.
constexpr std::size_t together = 4096;

std::string numbers(const Vec3& p) { return fmt::format("{} {} {}", p.x, p.y, p.z); }
std::string numbers(const Body& body) { return fmt::format("{} {}", body.radius, body.half_height); }
bool same(const Body& a, const Body& b) { return a.radius == b.radius && a.half_height == b.half_height; }

/// The segments of a certificate, and what its head says of them.
class Segments {
 public:
  void add(const Piece& piece) {
    // The way out of a wall in which the walk begins.
    if (!last_ && !(piece.clearance > 0.0)) return;
    // A rest says nothing new after the segment that ended there.
    if (last_ && last_->to == piece.from && piece.from == piece.to && same(last_->body, piece.body)) return;
    if (!last_) start_ = piece.from;
    last_ = piece;
    const auto is_this = [&](const Body& size) { return same(size, piece.body); };
    if (std::none_of(sizes_.begin(), sizes_.end(), is_this)) sizes_.push_back(piece.body);
    if (++count_ > checking::most_segments) return;  // it will be refused
    fmt::format_to(std::back_inserter(lines_), "segment {} {} {} {} {}\n", count_, numbers(piece.from),
                   numbers(piece.to), numbers(piece.body), piece.clearance);
  }

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::string certificate(const checking::SceneSum& scene) const {
    std::string text = fmt::format("{}\nscene {} {:016x}\nway {} {} {}\n", checking::first_line, scene.triangles,
                                   scene.hash, count_, numbers(start_), numbers(last_->to));
    for (const Body& size : sizes_) text += "size " + numbers(size) + "\n";
    text += lines_;
    return text + checking::checksum_line(text);
  }

 private:
  std::string lines_;
  std::uint64_t count_ = 0;
  Vec3 start_{0.0};
  std::optional<Piece> last_;
  std::vector<Body> sizes_;
};

}  // namespace

FileKind certificates() { return beginning_with(checking::first_line, "certificate"); }

void add(checking::SceneSum& sum, const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) sum.add(mesh.triangle(i));
}

bool certify(const std::filesystem::path& file, const OpenScene& scene, const verification::PieceLog& pieces,
             const checking::SceneSum* source) {
  if (file.empty()) return false;
  if (scene.store() && !source) {
    tell("note: no certificate: Ctrl-C came before the scene was read" + earlier_stays(file));
    return false;
  }
  checking::SceneSum sum;
  if (scene.store()) sum = *source;
  for (const Mesh& mesh : scene.loaded().meshes) add(sum, mesh);
  Segments segments;
  pieces.each(together, [&](std::span<const Piece> some) {
    for (const Piece& piece : some) segments.add(piece);
  });
  if (segments.count() == 0) {
    throw Error("--certify " + file.string(),
                "the body was never free: nothing can be certified" + earlier_stays(file));
  }
  if (segments.count() > checking::most_segments) {
    throw Error(
        "--certify " + file.string(),
        fmt::format(
            "the walk has {} segments, and a certificate at most {}; walk its path in parts, each with --certify{}",
            segments.count(), checking::most_segments, earlier_stays(file)));
  }
  const std::string text = segments.certificate(sum);
  try {
    (void)checking::read_certificate(text);
  } catch (const checking::Refused& refused) {
    throw Error::at(
        "--certify " + file.string(),
        fmt::format(
            "this walk has no certificate: segment {}: {} (a body that was put elsewhere on its way has none){}",
            refused.segment, refused.what(), earlier_stays(file)));
  }
  files::write_whole(file, text, files::Naming::exact, certificates());
  return true;
}

}  // namespace roam::app
