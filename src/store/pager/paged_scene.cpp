#include "store/pager/paged_scene.h"

#include <algorithm>
#include <span>

#include "index/rest.h"
#include "world/remaining.h"
#include "world/unknown.h"

namespace roam::paging {
namespace {

static_assert(index::tile_triangle_bits == store::triangle_bits);

/// Callbacks for the absent tiles that a traversal of one page meets.
struct Asking {
  const Residents& residents;
  const index::Piece& piece;
  Collector* collector = nullptr;
  bool only_coming = false;
  std::uint32_t page = 0;
  Cells met;

  [[nodiscard]] const store::TileEntry& entry(std::uint32_t tile) const {
    return residents.page(page).in.view.tiles[tile];
  }
  [[nodiscard]] index::Absent absent() {
    return {.sweep = &sweep, .near = &near, .context = this, .margin = Pager::margin, .only = only_coming};
  }

  static double sweep(void* self, std::uint32_t tile, double until) {
    Asking& a = *static_cast<Asking*>(self);
    const MetCells met = sweep_cells(a.entry(tile), a.piece, until);
    if (met.time < until) a.met = met.cells;
    return met.time;
  }
  static double near(void* self, std::uint32_t tile) {
    Asking& a = *static_cast<Asking*>(self);
    const PagedItem item{a.page, tile};
    if (!a.only_coming || !a.residents.has_failed(item)) {
      near_cells(a.entry(tile), a.piece, unknown_base(item), *a.collector);
    }
    return a.collector->enough();
  }
};

constexpr TriangleId page_base(std::uint32_t page) { return store::stored_id(page, 0, 0); }

/// Calls visit(page, its roots) for each page with roots.
template <class Visit>
void each_page(const index::Roots& roots, const Visit& visit) {
  const index::Root* const end = roots.root.data() + roots.count;
  for (const index::Root* begin = roots.root.data(); begin != end;) {
    const std::uint32_t page = begin->owner;
    const index::Root* const last = std::find_if(begin, end, [page](const index::Root& r) { return r.owner != page; });
    visit(page, std::span(begin, last));
    begin = last;
  }
}

}  // namespace

bool gather(const Residents& residents, const Box& box, index::Roots& out) {
  const index::Absent none{.sweep = nullptr, .near = nullptr, .context = nullptr, .margin = Pager::margin};
  bool complete = true;
  residents.tree().near(
      {box.center(), Vec3(0.0), 0.5 * box.size() + Pager::margin}, [&](std::uint32_t number, const Interval&) {
        const Residents::Page& page = residents.page(number);
        complete = complete && page.in.tiles != nullptr && index::gather(residents.view(page, none), number, box, out);
      });
  return complete;
}

template <class Use>
auto PagedScene::in_rest(const index::Index& page, const Use& use) const {
  if (ignored_ == nullptr) return use(page);
  const query::Remaining rest(page, *ignored_, nullptr);
  return use(rest.index());
}

std::optional<double> PagedScene::first(const index::Piece& piece) {
  if (roots_ != nullptr) return first_of_roots(piece);
  Asking asking{residents_, piece, nullptr, false, 0, {}};
  const index::Absent absent = asking.absent();
  double until = 1.0;
  bool hit = false;
  residents_.tree().along(way_around(piece, 0.0), until, [&](std::uint32_t number, const Interval&) {
    const Residents::Page& page = residents_.page(number);
    if (page.in.tiles == nullptr) {
      const Impact impact = unknown::sweep(page.box, Pager::margin, piece.body, piece.start, piece.motion);
      if (!impact.hit || impact.time >= until) return;
      until = impact.time;
      known_ = false;
      box_ = page.box;
      base_ = unknown_base({number, PagedItem::whole});
    } else {
      asking.page = number;
      const index::Impact impact = in_rest(residents_.view(page, absent), [&](const index::Index& index) {
        return index.skip == nullptr ? index::first_impact(index, piece, until)
                                     : index::first_impact_of_rest(index, piece, until);
      });
      if (!impact.hit) return;
      until = impact.time;
      known_ = !page.in.tiles[impact.place.tile].absent();
      page_ = number;
      place_ = impact.place;
      if (!known_) {
        box_ = asking.met.box;
        base_ = unknown_base({number, impact.place.tile}) + asking.met.first * unknown::sides;
      }
    }
    hit = true;
  });
  return hit ? std::optional(until) : std::nullopt;
}

std::optional<double> PagedScene::first_of_roots(const index::Piece& piece) {
  const index::Absent none{};
  double until = 1.0;
  bool hit = false;
  each_page(*roots_, [&](std::uint32_t number, std::span<const index::Root> roots) {
    const index::Index page = residents_.view(residents_.page(number), none);
    const index::Impact impact = in_rest(page, [&](const index::Index& index) {
      return index.skip == nullptr ? index::first_impact(index, roots, piece, until)
                                   : index::first_impact_of_rest(index, roots, piece, until);
    });
    if (!impact.hit) return;
    hit = known_ = true;
    until = impact.time;
    page_ = number;
    place_ = impact.place;
  });
  return hit ? std::optional(until) : std::nullopt;
}

bool PagedScene::name(FirstImpact& first) const {
  if (!known_) return false;
  const index::Absent none{};
  first.triangle = page_base(page_) + query::number_at(residents_.view(residents_.page(page_), none), place_);
  first.locator = {place_.tile, place_.leaf, place_.triangle, page_};
  return true;
}

Contact PagedScene::touched(const index::Piece& at_rest) const {
  if (!known_) return near_box(box_, at_rest, base_);
  const index::Absent none{};
  const index::Index index = residents_.view(residents_.page(page_), none);
  Contact c = query::contact_at(index, at_rest, place_);
  c.triangle = page_base(page_) + query::number_at(index, place_);
  return c;
}

index::Index index_of(const Residents& residents, const FirstImpact& first) {
  const index::Absent none{};
  return residents.view(residents.page(first.locator[3]), none);
}

void PagedScene::near(const index::Piece& piece, Collector& collector) const {
  if (roots_ != nullptr) {
    const index::Absent none{};
    each_page(*roots_, [&](std::uint32_t number, std::span<const index::Root> roots) {
      in_rest(residents_.view(residents_.page(number), none),
              [&](const index::Index& index) { query::visit_near(index, roots, piece, page_base(number), collector); });
    });
    return;
  }
  const bool only_coming = what_ == What::coming;
  Asking asking{residents_, piece, &collector, only_coming, 0, {}};
  const index::Absent absent = asking.absent();
  Sweep look = way_around(piece, collector.reach());
  residents_.tree().near(look, [&](std::uint32_t number, const Interval&) {
    const Residents::Page& page = residents_.page(number);
    if (page.in.tiles != nullptr) {
      asking.page = number;
      in_rest(residents_.view(page, absent),
              [&](const index::Index& index) { query::visit_near(index, piece, page_base(number), collector); });
    } else if ((!only_coming || !page.failed) && collector.takes_unknown(page.box, piece.body.radius, Pager::margin)) {
      collector.offer(near_box(page.box, piece, unknown_base({number, PagedItem::whole})), Pager::margin);
    }
    look = way_around(piece, collector.reach());
  });
}

}  // namespace roam::paging
