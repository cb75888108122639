#pragma once
/// \file
/// For authors of spaces alone: what Space::ask_near() offers everything to that comes near a body on its way.
///
///     void ask_near(const roam::Query& query, roam::Collector& collector, roam::Vicinity*) const override {
///       for (std::size_t i = 0; i < triangles.size(); ++i) collector.offer(query, triangles[i], i);
///     }
///
/// A space that has an index leaves out what lies farther than reach(), or than enough(), which both shrink as it
/// offers. Nothing here allocates.

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

/// Keeps the nearest contacts in the memory of whoever asks, as a heap with the farthest on top.
///
/// For a clearance it keeps one, and need not be offered what is hardly nearer (`tolerance`). Be G the true gap, and
/// of each triangle that is offered d its distance, certified and too low by `doubt` at most. Then G <= d + doubt, and
/// whatever comes no nearer than E = d + doubt - tolerance is of no interest: G - tolerance <= E. So enough() is the
/// least E so far, or d where that is less; what has a certified bound beyond it may be left out, if only left_out() is
/// told the bound. certified() is the least of d and of those bounds: none exceeds the true gap, and all are at least
/// the last enough(). As a part of small distances, E gives up less, so that what is near is told exactly, and a sign
/// is never wrong.
///
/// For a gap E is a part of d + doubt. A bound d that is itself no less than that part of d + doubt does as well as an
/// exact one: what is answered is no less than the part of the true gap, whichever bound it comes from.
class Collector {
 public:
  /// The question of the space's caller.
  enum class Kind : std::uint8_t { contacts, clearance, floor_clearance, gap, one_contact };

  [[nodiscard]] Kind kind() const { return kind_; }
  /// Metres from the body's surface. What comes no nearer cannot change the answer.
  [[nodiscard]] double reach() const { return reach_; }
  /// Metres. What comes no nearer may be left out, if left_out() is given the bound.
  [[nodiscard]] double enough() const { return enough_; }
  /// For Kind::one_contact: the first impact whose triangle is wanted, and no other, at the place of the query. Else
  /// null. A space may find it by FirstImpact::place instead of looking for it.
  [[nodiscard]] const FirstImpact* only() const { return only_; }

  /// A triangle, measured here. One of an object that the query ignores is passed over.
  void offer(const Query& query, const Triangle& triangle, TriangleId id, ObjectId object = no_object);
  /// A contact that the space has measured: its distance is certified, and no more than `doubt` (m) less than the true
  /// one. Of Kind::floor_clearance, what is offered must be floor.
  void offer(const Contact& contact, double doubt = 0.0) {
    frame_ == nullptr ? keep(contact, doubt) : keep_seen(contact, doubt);
  }
  /// Something was not offered that comes no nearer than `gap` (m), which is certified and beyond enough().
  void left_out(double gap) { left_out_ = gap < left_out_ ? gap : left_out_; }
  /// Before anything is offered: a clearance is to be at most so much (m) less than the true one; 0: no less than need
  /// be, of a gap, too. A space that does not say is granted 1.99 mm.
  void demand(double tolerance);

  // The rest is for this library's own spaces and for Space.

  Collector(Kind kind, double reach, std::span<Contact> out);
  /// For the contact of a first impact alone. It is looked for as far as a hit may be from what it touches.
  Collector(const FirstImpact& first, Contact& out)
      : out_(&out, 1), only_(&first), asked_(4e-3), reach_(asked_), enough_(asked_), kind_(Kind::one_contact) {}
  /// `repeats`: the same triangle may be offered twice, by pieces of one motion. Looking for it costs a scan.
  void expect_repeats() { repeats_ = true; }
  void take_floor_only(const query::FloorOnly& floor) { floor_ = &floor; }
  /// The one contact that is wanted, of Kind::one_contact.
  void take_only(const Contact& contact) {
    if (frame_ != nullptr) return keep_seen(contact, 0.0);
    out_[0] = contact;
    count_ = 1;
  }
  /// What is offered from now on is seen in this frame; null: in the scene's.
  void enter(const query::Frame* frame) { frame_ = frame; }
  /// Nearest first.
  void sort();
  /// The reach that it was made for.
  [[nodiscard]] double asked() const { return asked_; }
  /// The least gap to anything, for a clearance that found something.
  [[nodiscard]] double certified() const { return out_[0].distance < left_out_ ? out_[0].distance : left_out_; }
  [[nodiscard]] std::span<Contact> kept() const { return out_.first(count_); }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const query::FloorOnly* floor() const { return floor_; }
  /// Whether the caller wants the distance of the nearest and nothing else.
  [[nodiscard]] bool bounds_only() const { return bounds_only_; }
  /// Whether a box of which nothing is known, from which `margin` (m) is kept, counts for a body of this radius.
  [[nodiscard]] bool takes_unknown(const Box& box, double radius, double margin) const;

 private:
  void keep(const Contact& contact, double doubt);
  /// The same of one that is seen in the frame.
  void keep_seen(const Contact& contact, double doubt);
  [[nodiscard]] std::span<Contact>::iterator end() const { return out_.begin() + static_cast<std::ptrdiff_t>(count_); }
  /// Whether the triangle is in the list; a nearer contact with it replaces that one.
  [[nodiscard]] bool known(const Contact& contact);

  std::span<Contact> out_;
  const query::FloorOnly* floor_ = nullptr;
  const query::Frame* frame_ = nullptr;
  const FirstImpact* only_ = nullptr;
  double asked_, reach_, enough_;
  double left_out_ = std::numeric_limits<double>::infinity();
  double tolerance_ = 0.0, part_ = 0.0;
  Kind kind_;
  bool bounds_only_ = false, repeats_ = false;
  std::size_t count_ = 0;
};

}  // namespace roam
