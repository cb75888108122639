// Batches: queries in arrays of any layout, on all cores.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <mutex>
#include <string>

#include "c/progress.h"
#include "c/query.h"
#include "c/structs.h"
#include "math/parallel_floating_point.h"

namespace roam::c {
namespace {

/// Results that one core computes at a time: some 0.1 ms.
constexpr std::size_t results_at_a_time = 64;

template <class T>
T read(const roam_input& from, std::size_t i) {
  T value{};
  if (from.data == nullptr) return value;
  std::memcpy(&value, static_cast<const char*>(from.data) + static_cast<std::ptrdiff_t>(i) * from.stride, sizeof(T));
  return value;
}

/// Writes entry `entry` of the results of query i.
template <class T>
void write(const roam_output& to, std::size_t i, std::size_t entry, const T& value) {
  if (to.data == nullptr) return;
  char* const begin = static_cast<char*>(to.data) + static_cast<std::ptrdiff_t>(i) * to.stride;
  std::memcpy(begin + entry * sizeof(T), &value, sizeof(T));
}

class Batch {
 public:
  Batch(const roam_space& space, const roam_batch* from) : it(given(from, "roam_batch")) {
    if (it.count > 0) needed(it.from.data, "roam_batch::from");
    if (it.ignored_count > 0) (void)needed(it.ignored, "roam_batch::ignored");
    filter_.objects = {it.ignored, it.ignored_count};
    check_ignored(space, filter_.objects);
    for (const roam_output* to : {&it.hit, &it.time, &it.gap, &it.point, &it.normal, &it.triangle, &it.object,
                                  &it.feature, &it.unknown, &it.found}) {
      if (to->data != nullptr && to->stride == 0 && it.count > 1) {
        throw Invalid("an output of roam_batch has stride 0; set it to the bytes from one result to the next");
      }
    }
  }
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  [[nodiscard]] Query query(std::size_t i) const {
    return {{read<double>(it.radius, i), read<double>(it.half_height, i)},
            read<Vec3>(it.from, i),
            read<Vec3>(it.motion, i),
            &filter_};
  }
  [[nodiscard]] bool wants_contact() const {
    return it.gap.data != nullptr || it.point.data != nullptr || it.normal.data != nullptr ||
           it.feature.data != nullptr;
  }

  void put(std::size_t i, const Impact& impact) const {
    write(it.time, i, 0, impact.time);
    put_near(i, 0, c_of(impact), impact.hit);
  }
  void put(std::size_t i, const FirstImpact& impact) const {
    write(it.time, i, 0, impact.time);
    write(it.hit, i, 0, static_cast<std::uint8_t>(impact.hit));
    write(it.triangle, i, 0, impact.triangle);
    write(it.object, i, 0, impact.object);
    write(it.unknown, i, 0, static_cast<std::uint8_t>(impact.unknown));
  }
  void put(std::size_t i, std::size_t entry, const roam_contact& contact) const {
    put_near(i, entry, contact, contact.found != 0);
  }

  const roam_batch it;

 private:
  template <class Near>
  void put_near(std::size_t i, std::size_t entry, const Near& near, bool found) const {
    write(it.hit, i, entry, static_cast<std::uint8_t>(found));
    write(it.gap, i, entry, near.gap);
    write(it.point, i, entry, near.point);
    write(it.normal, i, entry, near.normal);
    write(it.triangle, i, entry, near.triangle);
    write(it.object, i, entry, near.object);
    write(it.feature, i, entry, near.feature);
    write(it.unknown, i, entry, near.unknown);
  }

  ObjectFilter filter_;
};

/// Computes all queries by `compute(i)`. The first of those that are refused is named.
template <class Compute>
void compute_all(const roam_batch& batch, const Compute& compute) {
  Progress progress(batch.progress, batch.progress_data);
  std::atomic<std::size_t> done{0}, refused{batch.count};
  std::mutex refusing;
  std::string why;  // of the first; computed again, its input might have changed
  std::atomic<bool> cancelled{false};
  const std::size_t at_a_time = std::max<std::size_t>(1, results_at_a_time / std::max<std::size_t>(1, batch.most));
  const auto compute_some = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && i < refused && !cancelled; ++i) {
      try {
        compute(i);
      } catch (const Error& error) {
        const std::lock_guard lock(refusing);
        if (i >= refused) continue;
        refused = i;
        why = error.what();
      }
    }
    done += end - begin;
    if (!progress.goes_on(static_cast<double>(done) / static_cast<double>(batch.count))) cancelled = true;
  };
  if (batch.count <= at_a_time) {
    compute_some(0, batch.count);
  } else {
    in_default_floating_point([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, batch.count, at_a_time), [&](const auto& some) {
        // TBB hands out as many as it likes.
        for (std::size_t i = some.begin(); i < some.end() && !cancelled; i += at_a_time)
          compute_some(i, std::min(i + at_a_time, some.end()));
      });
    });
  }
  if (cancelled) throw Cancelled();
  if (refused != batch.count) throw Invalid("query " + std::to_string(refused), why);
}

template <class Compute>
roam_status run(const roam_space* space, const roam_batch* from, const Compute& compute) {
  return guarded([&] {
    const roam_space& in = needed(space, "the space");
    const Batch batch(in, from);
    if (batch.it.count > 0) compute_all(batch.it, [&](std::size_t i) { compute(*in.space, batch, i); });
  });
}

}  // namespace
}  // namespace roam::c

using namespace roam::c;

roam_status roam_sweep_batch(const roam_space* space, const roam_batch* batch) {
  return run(space, batch, [](const roam::Space& in, const Batch& all, std::size_t i) {
    all.wants_contact() ? all.put(i, in.sweep(all.query(i))) : all.put(i, in.first_impact(all.query(i)));
  });
}

roam_status roam_clearance_batch(const roam_space* space, const roam_batch* batch) {
  return run(space, batch, [](const roam::Space& in, const Batch& all, std::size_t i) {
    all.put(i, 0, c_of(in.clearance(all.query(i), all.it.reach)));
  });
}

roam_status roam_contacts_batch(const roam_space* space, const roam_batch* batch) {
  return run(space, batch, [](const roam::Space& in, const Batch& all, std::size_t i) {
    if (all.it.most == 0) throw Invalid("roam_batch::most is 0; set it to the number of contacts that you want");
    thread_local std::vector<roam::Contact> found;
    found.resize(all.it.most);
    const std::size_t count = in.contacts(all.query(i), all.it.reach, found);
    write(all.it.found, i, 0, count);
    roam::Clearance none;
    none.distance = all.it.reach;
    for (std::size_t k = 0; k < all.it.most; ++k) all.put(i, k, k < count ? c_of(found[k]) : c_of(none));
  });
}

roam_status roam_fits_batch(const roam_space* space, const roam_batch* batch) {
  return run(space, batch, [](const roam::Space& in, const Batch& all, std::size_t i) {
    const Fit found(in, all.query(i));
    all.put(i, 0, c_of(found.nearest));
    write(all.it.hit, i, 0, static_cast<std::uint8_t>(found.fits));
  });
}
