#pragma once
/// \file
/// A line of text that the person types in the window.

#include <functional>
#include <osgGA/GUIEventHandler>
#include <string>

#include "view/stage.h"

namespace roam::app {

/// Appends the character of a key, as UTF-8. Other keys have none.
void append_character(std::string& text, int key);
/// Removes the last character.
void remove_character(std::string& text);

/// While it asks, all keys are text: Enter answers, Escape does not. Add it to the viewer before other handlers. Call
/// all members from the thread that draws, between two frames.
class Prompt : public osgGA::GUIEventHandler {
 public:
  using Answer = std::function<void(const std::string&)>;

  explicit Prompt(Stage& stage) : stage_(stage) {}

  /// Begins to ask. `text`: what is to be edited. `answer` gets a text that is not empty.
  void ask(std::string question, std::string text, Answer answer);

  [[nodiscard]] bool is_asking() const { return answer_ != nullptr; }

  using osgGA::GUIEventHandler::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

 protected:
  ~Prompt() override = default;

 private:
  void press(int key);
  void show();

  Stage& stage_;
  std::string question_, text_;  ///< UTF-8
  Answer answer_;                ///< empty: it does not ask
  int swallowed_ = 0;            ///< the key that ended it; its release is no command
};

}  // namespace roam::app
