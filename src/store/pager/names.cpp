#include "store/pager/names.h"

#include <algorithm>
#include <utility>

#include "import/stream.h"
#include "store/pager/residents.h"
#include "text/cut.h"

namespace roam::paging {
namespace {

using Clock = std::chrono::steady_clock;

/// A caller may ask for a name in every frame; this must not keep a failing disk busy.
constexpr std::chrono::milliseconds retry_after{500};

}  // namespace

Names::Entry* Names::entry_of(TriangleId triangle) {
  const auto at = std::find_if(entries_.begin(), entries_.end(),
                               [&](const Entry& e) { return e.asked > 0 && e.triangle == triangle; });
  return at == entries_.end() ? nullptr : &*at;
}

std::string Names::ask(TriangleId triangle) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return "";
  Entry* entry = entry_of(triangle);
  if (!entry) {
    entry = &*std::min_element(entries_.begin(), entries_.end(),
                               [](const Entry& a, const Entry& b) { return a.asked < b.asked; });
    *entry = {triangle, {}, 0, true, {}};
  }
  entry->asked = ++count_;
  // The reason why an item is unknown may change.
  if ((triangle & unknown_bit) != 0) entry->wanted = true;
  // A name that could not be read may become readable.
  if (entry->again != Clock::time_point{} && Clock::now() >= entry->again) entry->wanted = true;
  return entry->name;
}

bool Names::serve(Kind kind, const std::function<std::optional<std::string>(TriangleId)>& find) {
  TriangleId triangle = 0;
  {
    const std::lock_guard lock(mutex_);
    Entry* last = nullptr;
    for (Entry& e : entries_) {
      if (!e.wanted || ((e.triangle & unknown_bit) != 0) != (kind == Kind::reason)) continue;
      if (last == nullptr || e.asked > last->asked) last = &e;
    }
    if (last == nullptr) return false;
    last->wanted = false;
    triangle = last->triangle;
  }
  std::optional<std::string> name = find(triangle);
  const std::lock_guard lock(mutex_);
  Entry* const entry = entry_of(triangle);
  if (!entry) return true;
  entry->again = name ? Clock::time_point{} : Clock::now() + retry_after;
  if (name) entry->name = cut_text(std::move(*name), reader::object_name_limit);
  return true;
}

}  // namespace roam::paging
