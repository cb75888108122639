#include <gtest/gtest.h>

#include <osg/ApplicationUsage>
#include <osgGA/GUIEventAdapter>

#include "osgRoam/Manipulator.h"

namespace {

using osgRoam::Controls;
using Kind = Controls::Kind;
using Adapter = osgGA::GUIEventAdapter;

/// What is said when `work` is refused; empty when it is not.
template <class Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const roam::Error& error) {
    return error.what();
  }
  return {};
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Controls two_commands() {
  Controls c;
  c.add("forward", "W, Up", "goes", Kind::held);
  c.add("help", "H", "helps", Kind::pressed);
  return c;
}

TEST(Controls, KeyNamesAreReadBackAsTheyArePrinted) {
  for (const char* name :
       {"W",    "1",   "[",      "Up",     "Page_Down", "Shift", "F1",   "F12", "Space",  "Comma",        "Plus",
        "Home", "Tab", "Escape", "Alt",    "Return",    "Ctrl",  "Hash", "/",   "Ctrl+1", "Ctrl+Page_Up", "Ctrl+Plus",
        "'",    ".",   "=",      "Ctrl+=", "\xC3\xA9"}) {
    EXPECT_EQ(Controls::print(Controls::parseKey(name)), name);
  }
}

TEST(Controls, KeyNamesAreReadInEitherCaseAndByTheirOtherNames) {
  EXPECT_EQ(Controls::parseKey("w"), Controls::parseKey("W"));
  EXPECT_EQ(Controls::parseKey("page_down"), Controls::parseKey("PgDn"));
  EXPECT_EQ(Controls::parseKey("esc").symbol, Adapter::KEY_Escape);
  EXPECT_EQ(Controls::parseKey("ctrl+w"), Controls::parseKey("Ctrl+W"));
  EXPECT_EQ(Controls::parseKey("enter").symbol, Adapter::KEY_Return);
}

TEST(Controls, UnknownKeysAreNamedInTheMessage) {
  for (const char* name : {"", "WW", "Pagedown", "F99", "Ctrl+Ctrl+W", "Ctrl+Ctrl", "Ctrl+", "Shift+W"}) {
    EXPECT_TRUE(says(refusal([&] { (void)Controls::parseKey(name); }), "\"")) << name;
  }
  EXPECT_TRUE(says(refusal([] { (void)Controls::parseKey("Pagedown"); }), "Pagedown"));
  std::string many;
  while (many.size() < 1'000'000) many += "Ctrl+";
  EXPECT_TRUE(says(refusal([&] { (void)Controls::parseKey(many + "W"); }), "names Ctrl twice"));
  EXPECT_LT(refusal([&] { (void)Controls::parseKey(std::string(1000, 'x')); }).size(), 200U);
}

TEST(Controls, LookupKnowsKeysWhateverShiftAndTheSideAre) {
  Controls c = two_commands();
  c.add("fast", "Shift", "hurries", Kind::held);
  EXPECT_EQ(c.lookup('w', false)->name, "forward");
  EXPECT_EQ(c.lookup('W', false)->name, "forward");
  EXPECT_EQ(c.lookup(Adapter::KEY_KP_Up, false)->name, "forward");
  EXPECT_EQ(c.lookup(Adapter::KEY_Shift_R, false)->name, "fast");
  EXPECT_EQ(c.lookup('x', false), nullptr);
}

TEST(Controls, WithCtrlItsOwnCommandComesFirst) {
  Controls c = two_commands();
  c.add("store", "Ctrl+H", "stores", Kind::pressed);
  EXPECT_EQ(c.lookup('h', true)->name, "store");
  EXPECT_EQ(c.lookup('h', false)->name, "help");
  EXPECT_EQ(c.lookup('w', true)->name, "forward");
}

TEST(Controls, RebindingIsOneChangeSoThatKeysCanBeSwapped) {
  Controls c = two_commands();
  c.rebind("# mine\n\nforward = H   # was W\nhelp = W, F1\n");
  EXPECT_EQ(c.lookup('h', false)->name, "forward");
  EXPECT_EQ(c.lookup('w', false)->name, "help");
  EXPECT_EQ(c.lookup(Adapter::KEY_Up, false), nullptr);
  EXPECT_EQ(c.text(), "forward = H\nhelp = W, F1\n");
}

TEST(Controls, WhatItPrintsItReads) {
  osg::ref_ptr<osgRoam::Manipulator> m = new osgRoam::Manipulator;
  const std::string before = m->controls().text();
  m->controls().rebind("forward =\nback = F5");
  const std::string changed = m->controls().text();
  EXPECT_NE(before, changed);
  osg::ref_ptr<osgRoam::Manipulator> other = new osgRoam::Manipulator;
  other->controls().rebind(changed);
  EXPECT_EQ(other->controls().text(), changed);
  other->controls().rebind(before);
  EXPECT_EQ(other->controls().text(), before);
}

TEST(Controls, ACommandWithoutKeysIsCalledByNone) {
  Controls c = two_commands();
  c.rebind("forward =");
  EXPECT_EQ(c.lookup('w', false), nullptr);
  EXPECT_EQ(Controls::keyText(*c.find("forward")), "");
}

TEST(Controls, WhatCanNotBeIsRefusedWithItsLineAndChangesNothing) {
  Controls c = two_commands();
  c.add("look", "Drag", "looks", Kind::gesture);
  const std::string before = c.text();
  const auto rebind = [&](const char* lines) { return refusal([&] { c.rebind(lines); }); };
  EXPECT_TRUE(says(rebind("forward = X\nflyy = Y"), "line 2"));
  EXPECT_TRUE(says(rebind("forward = X\nflyy = Y"), "flyy"));
  EXPECT_TRUE(says(rebind("forward = Nokey"), "Nokey"));
  EXPECT_TRUE(says(rebind("forward"), "forward = W, Up"));
  EXPECT_TRUE(says(rebind("look = X"), "mouse"));
  EXPECT_TRUE(says(rebind("forward = W,, Up"), "line 1"));
  EXPECT_EQ(c.text(), before);
}

TEST(Controls, OneKeyForTwoCommandsIsRefusedNamingBoth) {
  Controls c = two_commands();
  for (const std::string& said :
       {refusal([&] { c.rebind("forward = h"); }), refusal([&] { c.add("other", "F2, h", "", Kind::pressed); })}) {
    EXPECT_TRUE(says(said, "H")) << said;
    EXPECT_TRUE(says(said, "\"help\"")) << said;
  }
  EXPECT_TRUE(says(refusal([&] { c.rebind("forward = h"); }), "\"forward\""));
  EXPECT_EQ(c.find("other"), nullptr);
}

TEST(Controls, NamesAreOneWordAndNotGivenTwice) {
  Controls c = two_commands();
  EXPECT_TRUE(says(refusal([&] { c.add("help", "F2", "", Kind::pressed); }), "help"));
  for (const char* name : {"", "two words", "a=b", "a#b", "a\nb"}) {
    EXPECT_NE(refusal([&] { c.add(name, "F2", "", Kind::pressed); }), "") << name;
  }
}

TEST(Controls, TheManipulatorsOwnAreThoseThatPeopleKnow) {
  osg::ref_ptr<osgRoam::Manipulator> m = new osgRoam::Manipulator;
  const auto name = [&](int key) {
    const Controls::Command* command = m->controls().lookup(key, false);
    return command ? command->name : "";
  };
  const std::pair<int, const char*> known[] = {
      {'w', "forward"},
      {'s', "back"},
      {'a', "left"},
      {'d', "right"},
      {'q', "down"},
      {'e', "up"},
      {' ', "jump"},
      {'c', "crouch"},
      {'g', "gravity"},
      {'n', "ghost"},
      {Adapter::KEY_Up, "forward"},
      {Adapter::KEY_Down, "back"},
      {Adapter::KEY_Left, "left"},
      {Adapter::KEY_Right, "right"},
      {Adapter::KEY_Page_Up, "up"},
      {Adapter::KEY_Page_Down, "down"},
      {Adapter::KEY_Shift_L, "fast"},
      {Adapter::KEY_Control_R, "slow"},
      {Adapter::KEY_Home, "home"},
      {Adapter::KEY_Escape, "release"},
  };
  for (const auto& [key, command] : known) EXPECT_EQ(name(key), command);
  for (int digit = '1'; digit <= '7'; ++digit) EXPECT_EQ(name(digit), "");
}

TEST(Controls, TheUsageOfTheManipulatorIsTheTable) {
  osg::ref_ptr<osgRoam::Manipulator> m = new osgRoam::Manipulator;
  m->controls().add("record", "R", "records the way", Kind::pressed);
  m->controls().rebind("forward = Z");
  osg::ref_ptr<osg::ApplicationUsage> usage = new osg::ApplicationUsage;
  m->getUsage(*usage);
  const auto& bindings = usage->getKeyboardMouseBindings();
  EXPECT_EQ(bindings.size(), m->controls().commands().size());
  EXPECT_EQ(bindings.at("R "), "roam: records the way");
  EXPECT_EQ(bindings.at("Z "), "roam: " + m->controls().find("forward")->help);
  EXPECT_EQ(bindings.count("Wheel "), 1u);
  // Longer ones would run into the second column of osgViewer::HelpHandler.
  for (const auto& [keys, help] : bindings) EXPECT_LE(keys.size(), 15u) << keys;
}

}  // namespace
