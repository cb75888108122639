#pragma once
/// \file
/// The space without what the picture hides: for clicks, and for a body that may pass through it.

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "osgRoam/Manipulator.h"
#include "roam/filtered.h"
#include "roam/pager.h"
#include "view/arrival.h"
#include "view/commands.h"
#include "view/news.h"
#include "view/scene_graph.h"
#include "view/section.h"
#include "view/status.h"
#include "view/view_report.h"

namespace roam::app {

/// The body meets what is hidden, unless the person lets it pass through. Then it moves in a Filtered of its own that
/// leaves out the hidden objects, except those with a name that something visible has, too; and each triangle that lies
/// as a whole beyond one plane of the section, or one side of its box. A triangle that is seen in part stays as a
/// whole. The Filtered follows the section and the objects, so that the body keeps its motion. A store has no objects:
/// they stay solid there.
///
/// Call all members from the thread that draws, between two frames.
class HiddenSpace {
 public:
  /// `may_pass`: whether the body may pass at all. No if all its moves are to be verified, or follow a path.
  HiddenSpace(SceneGraph& scene, const Arrival& arrival, osgRoam::Manipulator& roamer, News& news, bool may_pass);

  /// Adds "pass_hidden", which changes whether the body passes.
  void add_to(Commands& commands);
  /// Call it in each frame, with the section that is drawn.
  void update(const SectionShape& section);

  /// Lets the body pass through what is hidden, or no longer. Says so, or why not. While the walls are being loaded, it
  /// waits for them.
  void pass_through(bool passes);
  [[nodiscard]] bool passes() const { return passes_; }

  /// The space without hidden objects, and without what the section hides whole; null if nothing is hidden, or its
  /// triangles are not known.
  [[nodiscard]] const Space* visible() const { return visible_.get(); }
  /// The space that the body meets now, for another thread.
  struct Met {
    std::shared_ptr<const Space> space;  ///< never changes, unless it is a Pager
    std::vector<HalfSpace> open;         ///< the body also passes each triangle that lies as a whole in one of them
    bool operator==(const Met&) const = default;
  };
  [[nodiscard]] Met met() const;
  /// Patterns of --ignore for the objects that the body passes through.
  [[nodiscard]] std::vector<std::string> passed() const;
  /// Whether the body passes through what the section hides.
  [[nodiscard]] bool is_section_open() const { return passes_ && !section_.empty(); }

  void fill(Status& status) const;
  void fill(ViewReport& report) const;

 private:
  [[nodiscard]] std::vector<ObjectId> hidden_objects();
  void use(std::shared_ptr<const World> world, std::shared_ptr<Pager> pager);
  void give_to_body();
  [[nodiscard]] bool keeps_objects() const { return passes_ && pager_ != nullptr && !names_.names.empty(); }
  void tell_of_store();

  SceneGraph& scene_;
  const Arrival& arrival_;
  osgRoam::Manipulator& roamer_;
  News& news_;
  bool may_pass_;
  bool passes_ = false;
  bool told_of_store_ = false;  ///< that objects stay solid

  // The inputs of the last update().
  std::shared_ptr<const SceneObjects::Flags> flags_;
  SceneObjects::HiddenNames names_;
  std::shared_ptr<const World> world_;  ///< that the body collides with, or
  std::shared_ptr<Pager> pager_;        ///< the store; neither while nothing is loaded
  std::vector<HalfSpace> section_;
  std::unordered_multimap<std::string, ObjectId> ids_;  ///< of the world's objects
  std::string section_text_;

  std::vector<ObjectId> without_;  ///< the hidden objects
  std::vector<HalfSpace> beyond_;  ///< the half spaces in which a triangle is hidden whole
  std::shared_ptr<const Space> visible_;
  std::shared_ptr<Filtered> open_;  ///< the space of a body that passes; null before the first time
};

}  // namespace roam::app
