#pragma once
/// \file
/// The collector of contacts: the receiver of the results of Space::find_near(), for authors of spaces.
///
///     void find_near(const roam::Query& query, roam::Collector& collector, roam::Vicinity*) const override {
///       for (std::size_t i = 0; i < triangles.size(); ++i) collector.offer(query, triangles[i], i);
///     }
///
/// A space with an index may leave out triangles beyond reach() or enough(), which shrink. Nothing here allocates.

#include <cstddef>
#include <limits>
#include <span>

#include "roam/math.h"
#include "roam/mesh.h"
#include "roam/space.h"

namespace roam {
namespace query {
class FloorOnly;
struct Frame;
}  // namespace query

/// Keeps the nearest contacts in the caller's memory. Lengths are metres.
///
/// For a clearance it keeps one contact. G is the true gap. Each offered distance d is certified and at most `doubt`
/// too low: G <= d + doubt. Each offer has a limit E = d + doubt - tolerance, raised to 15/16 d so that the sign is
/// right. A triangle at distance E or more may be left out; the error of the result is then at most the tolerance.
///   - enough() is the smallest E or d of all offers.
///   - certified() is the smallest d of all offers and of the bounds passed to left_out(): at most G, and at least the
///     last enough().
/// For a gap, E is 7/8 (d + doubt): a lower bound d of at least E serves as well as an exact distance.
class Collector {
 public:
  enum class Kind : std::uint8_t { contacts, clearance, floor_clearance, gap, one_contact };  ///< the caller's query

  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] double reach() const { return reach_; }    ///< from the body; nothing beyond it changes the result
  [[nodiscard]] double enough() const { return enough_; }  ///< leave out triangles beyond it, with left_out()
  /// For Kind::one_contact: the first impact whose triangle alone is wanted, at the query's position. Else null.
  [[nodiscard]] const FirstImpact* only() const { return only_; }

  /// Offers a triangle. The collector measures it unless it is ignored.
  void offer(const Query& query, const Triangle& triangle, TriangleId id, ObjectId object = no_object);
  /// Offers a measured contact: its distance is certified, at most `doubt` too low. Kind::floor_clearance takes floor.
  void offer(const Contact& contact, double doubt = 0.0) {
    frame_ == nullptr ? keep(contact, doubt) : keep_seen(contact, doubt);
  }
  /// Reports that a triangle was left out. `gap` is a certified lower bound of its distance, beyond enough().
  void left_out(double gap) { left_out_ = gap < left_out_ ? gap : left_out_; }
  /// Before any offer(): how much too low a clearance may be, 1.99 mm by default. 0: clearances and gaps are exact.
  void demand(double tolerance);

  // The rest is for this library's own spaces and for Space.

  Collector(Kind kind, double reach, std::span<Contact> out);
  Collector(const FirstImpact& first, Contact& out)
      : out_(&out, 1),
        only_(&first),
        initial_reach_(4e-3),
        reach_(initial_reach_),
        enough_(initial_reach_),
        kind_(Kind::one_contact) {}
  void expect_repeats() { repeats_ = true; }  ///< one triangle may be offered twice; costs a scan an offer
  void take_floor_only(const query::FloorOnly& floor) { floor_ = &floor; }
  void take_only(const Contact& contact) {
    if (frame_ != nullptr) return keep_seen(contact, 0.0);
    out_[0] = contact;
    count_ = 1;
  }
  void enter(const query::Frame* frame) { frame_ = frame; }  ///< the frame of offers from now on; null: the scene's
  void sort();                                               ///< nearest first
  [[nodiscard]] double initial_reach() const { return initial_reach_; }  ///< the reach that it was made with
  /// The smallest gap, of a clearance that found something.
  [[nodiscard]] double certified() const { return out_[0].distance < left_out_ ? out_[0].distance : left_out_; }
  [[nodiscard]] std::span<Contact> kept() const { return out_.first(count_); }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const query::FloorOnly* floor() const { return floor_; }
  [[nodiscard]] bool bounds_only() const { return bounds_only_; }  ///< only the nearest distance is wanted
  /// Whether an unknown box, from which a body of this radius keeps `margin`, counts.
  [[nodiscard]] bool takes_unknown(const Box& box, double radius, double margin) const;

 private:
  void keep(const Contact& contact, double doubt);
  void keep_seen(const Contact& contact, double doubt);  ///< the same of a contact in the frame
  [[nodiscard]] std::span<Contact>::iterator end() const { return out_.begin() + static_cast<std::ptrdiff_t>(count_); }
  [[nodiscard]] bool known(const Contact& contact);  ///< whether it is in the list; a nearer one replaces it

  std::span<Contact> out_;
  const query::FloorOnly* floor_ = nullptr;
  const query::Frame* frame_ = nullptr;
  const FirstImpact* only_ = nullptr;
  double initial_reach_, reach_, enough_;
  double left_out_ = std::numeric_limits<double>::infinity();
  double tolerance_ = 0.0, part_ = 0.0;
  Kind kind_;
  bool bounds_only_ = false, repeats_ = false;
  std::size_t count_ = 0;
};

}  // namespace roam
