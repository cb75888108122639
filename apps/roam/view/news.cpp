#include "view/news.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "cli/tell.h"
#include "text/printable.h"
#include "text/web_address.h"

namespace roam::app {
namespace {

constexpr double least_seconds = 6.0;
constexpr double first_seconds = 12.0;   // of a note with its remedy
constexpr double letter_seconds = 0.07;  // reading time
constexpr std::size_t most_items = 4;    // lines shown at a time

void erase_where_a_path_begins(std::string& text, const std::string& folder) {
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder, at)) {
    const bool begins = at == 0 || std::string_view(" '\"(`").find(text[at - 1]) != std::string_view::npos;
    if (begins) {
      text.erase(at, folder.size());
    } else {
      ++at;
    }
  }
}

}  // namespace

void News::tell(std::string sentence, bool warning) { show(without_folders(std::move(sentence)), {"", warning}); }

void News::tell_as_is(const std::string& sentence, bool warning) { show(sentence, {"", warning}); }

std::string News::without_folders(std::string sentence) const {
  for (const auto& scene : scenes_) {
    for (const auto& path : {std::filesystem::absolute(scene), scene}) {
      const std::string folder = path.parent_path().string() + "/";
      if (folder != "/") erase_where_a_path_begins(sentence, folder);
    }
  }
  return sentence;
}

/// Shows `item` with this sentence: after the others, or after the others that come first. The oldest of the others
/// that does not come first makes room, or else the oldest.
void News::show(const std::string& sentence, Item item) {
  item.text = printable(without_secrets(sentence), longest_sentence);
  item.until = now_ + std::max(item.first ? first_seconds : least_seconds,
                               letter_seconds * static_cast<double>(item.text.size()));
  const auto others = [&] {
    return std::find_if(items_.begin(), items_.end(), [](const Item& one) { return !one.first; });
  };
  if (items_.size() == most_items) items_.erase(others() == items_.end() ? items_.begin() : others());
  items_.insert(item.first ? others() : items_.end(), std::move(item));
}

void News::note(const std::string& sentence, const std::string& shown) {
  const auto led =
      std::find_if(items_.begin(), items_.end(), [&](const Item& one) { return one.first && one.note == sentence; });
  if (led == items_.end() && !was_noted_before(sentence) && !shown.empty()) {
    show(without_folders(shown), {sentence, true});
  }
  if (std::find(notes_.begin(), notes_.end(), sentence) != notes_.end()) return;
  notes_.push_back(sentence);
  tell_on_terminal(sentence);
}

bool News::was_noted_before(const std::string& sentence) const {
  return std::find(before_.begin(), before_.end(), sentence) != before_.end();
}

void News::tell_on_terminal(const std::string& sentence) const {
  if (!was_noted_before(sentence)) app::tell("note: " + sentence);
}

void News::note_first(const std::string& sentence, const std::string& remedy) {
  std::erase_if(items_, [&](const Item& one) { return one.note == sentence; });
  std::string shown = without_folders(sentence);
  if (!remedy.empty()) shown += shown.ends_with('.') ? " " + remedy + "." : "; " + remedy;
  show(shown, {sentence, true, true});
  const auto known = std::find(notes_.begin(), notes_.end(), sentence);
  if (known - notes_.begin() < first_notes_) return;
  if (known != notes_.end()) {
    notes_.erase(known);
  } else {
    tell_on_terminal(sentence);
  }
  notes_.insert(notes_.begin() + first_notes_++, sentence);
}

void News::keep_for_report(const std::string& sentence) {
  note(sentence, {});
  std::erase_if(items_, [&](const Item& one) { return one.note == sentence; });
  before_.push_back(sentence);
}

void News::written(const std::filesystem::path& file) {
  tell_as_is("written: " + std::filesystem::absolute(file).lexically_normal().string());
  files_.push_back(file.string());
}

std::vector<Told> News::shown() {
  std::erase_if(items_, [&](const Item& item) { return item.until < now_; });
  std::vector<Told> told;
  for (const Item& item : items_) told.push_back({item.text, item.warning});
  return told;
}

}  // namespace roam::app
