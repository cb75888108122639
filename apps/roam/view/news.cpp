#include "view/news.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "text/printable.h"
#include "text/web_address.h"

namespace roam::app {
namespace {

constexpr double least_seconds = 6.0;
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

void News::tell(std::string sentence, bool warning) {
  for (const auto& scene : scenes_) {
    for (const auto& path : {std::filesystem::absolute(scene), scene}) {
      const std::string folder = path.parent_path().string() + "/";
      if (folder != "/") erase_where_a_path_begins(sentence, folder);
    }
  }
  tell_as_is(sentence, warning);
}

void News::tell_as_is(const std::string& sentence, bool warning) {
  std::string shown = printable(without_secrets(sentence), longest_sentence);
  const double seconds = std::max(least_seconds, letter_seconds * static_cast<double>(shown.size()));
  items_.push_back({{std::move(shown), warning}, now_ + seconds});
  if (items_.size() > most_items) items_.erase(items_.begin());
}

void News::note(const std::string& sentence) {
  tell(sentence, true);
  if (std::find(notes_.begin(), notes_.end(), sentence) == notes_.end()) notes_.push_back(sentence);
}

void News::written(const std::filesystem::path& file) {
  tell_as_is("written: " + std::filesystem::absolute(file).lexically_normal().string());
  files_.push_back(file.string());
}

std::vector<Told> News::shown() {
  std::erase_if(items_, [&](const Item& item) { return item.until < now_; });
  std::vector<Told> told;
  for (const Item& item : items_) told.push_back(item.told);
  return told;
}

}  // namespace roam::app
