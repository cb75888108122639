#pragma once
/// \file
/// A report: a first line that says the result, and labelled lines below it; or the same as sentences.

#include <string>
#include <string_view>

namespace roam::words {

class Lines {
 public:
  explicit Lines(std::string_view first);
  /// "  label      text", with lines of at most 100 columns where words allow. An empty text adds nothing. Names in
  /// `text` must be printable already.
  void add(std::string_view label, std::string_view text);
  [[nodiscard]] std::string text() const { return text_; }
  /// In one line: "First. Label: text. Label: text."
  [[nodiscard]] std::string sentences() const { return sentences_; }

 private:
  void wrap(std::string_view text, std::size_t indent);
  std::string text_, sentences_;
};

}  // namespace roam::words
