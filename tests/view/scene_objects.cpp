// The objects of a scene by name, and which of them are hidden.
#include "view/scene_objects.h"

#include <gtest/gtest.h>

#include "import/display_part.h"

namespace {

using namespace roam;
using app::SceneObjects;

std::string path(std::initializer_list<const char*> names) {
  std::string text;
  for (const char* name : names) {
    if (!text.empty()) text += DisplayPart::name_separator;
    text += name;
  }
  return text;
}

/// "floor 1 (2) -; Wall x" of the entries: groups with their objects; x hidden, - partly.
std::string shown(const SceneObjects& objects, const std::set<SceneObjects::Number>& open = {},
                  const std::string& search = {}) {
  std::string text;
  for (const SceneObjects::Entry& entry : objects.entries(open, search)) {
    text += (text.empty() ? "" : "; ") + std::string(2 * static_cast<std::size_t>(entry.depth), ' ') + entry.name;
    if (entry.is_group) text += " (" + std::to_string(entry.objects) + ")";
    if (entry.hidden == SceneObjects::Hidden::all) text += " x";
    if (entry.hidden == SceneObjects::Hidden::some) text += " -";
  }
  return text;
}

SceneObjects::Number node_of(const SceneObjects& objects, const std::string& name) {
  for (const SceneObjects::Entry& entry : objects.entries({}, name)) {
    if (entry.name == name) return entry.node;
  }
  return 0;
}

const std::vector<std::string> house_names{path({"house", "floor 1", "Wall"}), path({"house", "floor 1", "Door_1"}),
                                           path({"house", "floor 2", "Wall"}), path({"house", "Roof"})};

TEST(SceneObjects, AreATreeOfNames) {
  SceneObjects objects;
  const auto numbers = objects.add(house_names);
  EXPECT_EQ(objects.add(house_names), numbers) << "the same names are the same objects";
  EXPECT_EQ(shown(objects), "floor 1 (2); floor 2 (1); Roof") << "from the first branching on";
  EXPECT_EQ(shown(objects, {node_of(objects, "floor 1")}), "floor 1 (2);   Wall;   Door_1; floor 2 (1); Roof");
  EXPECT_EQ(shown(objects, {}, "wALL"), "Wall; Wall");
  EXPECT_EQ(objects.count().objects, 4u);
}

TEST(SceneObjects, AreHiddenAsThePersonDecidedBefore) {
  SceneObjects before({"Roof", "Wall"});
  static_cast<void>(before.add(house_names));
  before.set_hidden(node_of(before, "floor 1"), true);
  before.set_hidden(node_of(before, "Door_1"), false);
  before.set_hidden(node_of(before, "Roof"), false);
  SceneObjects objects({"Roof", "Wall"}, before.decisions());
  EXPECT_EQ(shown(objects), "");
  EXPECT_EQ(shown(objects, {}, "o"), "") << "none has come yet";
  EXPECT_FALSE(objects.flags()->any);
  static_cast<void>(objects.add({house_names[0], house_names[1], house_names[2]}));
  EXPECT_EQ(shown(objects, {node_of(objects, "floor 1")}), "floor 1 (2) -;   Door_1;   Wall x; floor 2 (1) x");
  static_cast<void>(objects.add(house_names));
  EXPECT_EQ(shown(objects), "floor 1 (2) -; Roof; floor 2 (1) x");
  EXPECT_EQ(objects.decisions().size(), 3u);
  before.show_all();
  SceneObjects all({"Wall"}, before.decisions());
  static_cast<void>(all.add(house_names));
  EXPECT_EQ(all.count().hidden, 0u);
}

TEST(SceneObjects, AreHiddenWithTheirGroups) {
  SceneObjects objects;
  const auto numbers = objects.add(house_names);
  EXPECT_FALSE(objects.flags()->any);
  objects.set_hidden(node_of(objects, "floor 1"), true);
  EXPECT_EQ(shown(objects), "floor 1 (2) x; floor 2 (1); Roof");
  EXPECT_TRUE(objects.flags()->hides(numbers[0]));
  EXPECT_TRUE(objects.flags()->hides(numbers[1]));
  EXPECT_FALSE(objects.flags()->hides(numbers[2]));
  objects.set_hidden(numbers[0], false);
  EXPECT_EQ(shown(objects), "floor 1 (2) -; floor 2 (1); Roof");
  EXPECT_EQ(objects.count().hidden, 1u);
  objects.show_all();
  EXPECT_EQ(objects.count().hidden, 0u);
  EXPECT_FALSE(objects.flags()->any);
}

TEST(SceneObjects, ThatArriveLaterFollowTheirGroup) {
  SceneObjects objects;
  (void)objects.add(house_names);
  objects.set_hidden(node_of(objects, "floor 1"), true);
  const auto more = objects.add({path({"house", "floor 1", "Lamp"}), path({"house", "floor 2", "Lamp"})});
  EXPECT_TRUE(objects.flags()->hides(more[0]));
  EXPECT_FALSE(objects.flags()->hides(more[1]));
}

TEST(SceneObjects, AreHiddenByPatternsOfTheirNamesOrTheirAncestors) {
  SceneObjects objects({"Door*", "floor 2", "Cellar"});
  const auto numbers = objects.add(house_names);
  EXPECT_FALSE(objects.flags()->hides(numbers[0]));
  EXPECT_TRUE(objects.flags()->hides(numbers[1]));
  EXPECT_TRUE(objects.flags()->hides(numbers[2]));
  EXPECT_EQ(objects.unmatched(), std::vector<std::string>{"Cellar"});
}

TEST(SceneObjects, OfHiddenNamesHaveNoVisibleNamesake) {
  SceneObjects objects;
  const auto numbers = objects.add(house_names);
  objects.set_hidden(node_of(objects, "floor 1"), true);
  EXPECT_EQ(objects.hidden_names().names, (std::map<std::string, std::size_t>{{"Door_1", 1}}))
      << "a wall of floor 2 is to be seen";
  EXPECT_EQ(objects.hidden_names().left_over, 1u);
  objects.set_hidden(numbers[2], true);
  EXPECT_EQ(objects.hidden_names().names, (std::map<std::string, std::size_t>{{"Door_1", 1}, {"Wall", 2}}));
  EXPECT_EQ(objects.hidden_names().left_over, 0u);
}

TEST(SceneObjects, BeyondAnyNumberShareOneNode) {
  SceneObjects objects;
  std::vector<std::string> many;
  for (std::size_t i = 0; i < SceneObjects::most_nodes + 10; ++i) many.push_back(std::to_string(i));
  (void)objects.add(many);
  EXPECT_LE(objects.count().objects, SceneObjects::most_nodes + 1);
  EXPECT_EQ(objects.entries({}, "further objects").size(), 1u);
}

TEST(SceneObjects, BeyondAnyNumberMayHaveAHiddenName) {
  SceneObjects objects;
  std::vector<std::string> many{"Wall"};
  for (std::size_t i = many.size(); i + 1 < SceneObjects::most_nodes; ++i) many.push_back(std::to_string(i));
  const auto numbers = objects.add(many);
  objects.set_hidden(numbers[0], true);
  EXPECT_EQ(objects.hidden_names().names, (std::map<std::string, std::size_t>{{"Wall", 1}}));
  const auto more = objects.add({path({"house", "Wall"})});
  EXPECT_TRUE(objects.hidden_names().names.empty()) << "that wall is to be seen";
  EXPECT_EQ(objects.hidden_names().left_over, 1u);
  objects.set_hidden(more[0], true);
  EXPECT_TRUE(objects.hidden_names().names.contains("Wall"));
}

}  // namespace
