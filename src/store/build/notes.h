#pragma once
/// \file
/// Notes of the import about the parts of a scene.

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

namespace roam::store {

/// The notes of all parts for people. A sentence about several parts appears once, with the first of them.
class Notes {
 public:
  void add(const std::string& part, const std::vector<std::string>& notes) {
    for (const std::string& note : notes) {
      const std::string sentence = note.substr(part.size() + 2);
      const auto [it, is_new] = place_.emplace(sentence, said_.size());
      if (is_new) said_.push_back({part, sentence, 0});
      if (!is_new) ++said_[it->second].others;
    }
  }
  void prepend_to(std::vector<std::string>& notes) const {
    std::vector<std::string> lines;
    for (const Said& s : said_) {
      const std::string others = s.others > 0 ? fmt::format(" and {} more", s.others) : "";
      lines.push_back(s.part + others + ": " + s.sentence);
    }
    notes.insert(notes.begin(), lines.begin(), lines.end());
  }

 private:
  struct Said {
    std::string part, sentence;
    std::size_t others;
  };
  std::map<std::string, std::size_t> place_;
  std::vector<Said> said_;
};

}  // namespace roam::store
