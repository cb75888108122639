#include "view/prompt.h"

#include <fmt/format.h>

#include <utility>

namespace roam::app {
namespace {

using Adapter = osgGA::GUIEventAdapter;

constexpr std::size_t longest = 60;  // bytes

}  // namespace

// X numbers keys by Latin-1, or Unicode.
void append_character(std::string& text, int key) {
  constexpr int unicode_keys = 0x01000000;
  const int c = key >= unicode_keys ? key - unicode_keys : key;
  const bool printable = (c >= 0x20 && c <= 0x7e) || (c >= 0xa0 && c <= 0xff) || (key != c && c <= 0xffff);
  if (!printable) return;
  const auto byte = [&](int value) { text += static_cast<char>(value); };
  if (c < 0x80) {
    byte(c);
  } else if (c < 0x800) {
    byte(0xc0 | c >> 6);
    byte(0x80 | (c & 0x3f));
  } else {
    byte(0xe0 | c >> 12);
    byte(0x80 | (c >> 6 & 0x3f));
    byte(0x80 | (c & 0x3f));
  }
}

void remove_character(std::string& text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80) text.pop_back();
  if (!text.empty()) text.pop_back();
}

void Prompt::ask(std::string question, std::string text, Answer answer) {
  question_ = std::move(question);
  text_ = std::move(text);
  answer_ = std::move(answer);
  show();
}

void Prompt::show() { stage_.ask(fmt::format("{}: {}_     Enter: keep     Escape: cancel", question_, text_)); }

bool Prompt::handle(const Adapter& event, osgGA::GUIActionAdapter& /*action*/) {
  if (event.getEventType() == Adapter::KEYUP && event.getKey() == swallowed_) {
    swallowed_ = 0;
    return true;
  }
  if (!answer_ || event.getHandled()) return false;
  // Releases go on: keys that were held before must not stick.
  if (event.getEventType() != Adapter::KEYDOWN) return false;
  press(event.getKey());
  return true;
}

void Prompt::press(int key) {
  const bool enters = key == Adapter::KEY_Return || key == Adapter::KEY_KP_Enter;
  if (key == Adapter::KEY_Escape || enters) {
    swallowed_ = key;
    stage_.ask({});
    const Answer answer = std::exchange(answer_, nullptr);
    if (enters && !text_.empty()) answer(text_);
    return;
  }
  if (key == Adapter::KEY_BackSpace) {
    remove_character(text_);
  } else if (text_.size() < longest) {
    append_character(text_, key);
  }
  show();
}

}  // namespace roam::app
