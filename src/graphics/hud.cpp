#include "graphics/hud.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <osg/BlendFunc>
#include <osg/Camera>
#include <osg/NodeCallback>
#include <utility>

#include "graphics/hud_panels.h"

namespace roam::graphics {

/// The contents of the display, and the nodes that show them. As an update callback it makes the nodes match the
/// contents before each frame.
class Hud::Panels : public osg::NodeCallback {
 public:
  explicit Panels(osg::ref_ptr<osg::Camera> picture) : picture_(std::move(picture)) {}

  std::vector<StatusLine> status;
  std::string message;
  Tone tone = Tone::info;
  std::optional<double> progress;
  std::string hint, recording;
  std::vector<HudLabel> labels;
  double hint_opacity = 1.0;
  std::vector<HelpLine> help;
  std::string help_focus, button, list_focus;
  std::optional<HudList> list;
  Rectangle plan;
  bool help_shown = false;
  std::size_t help_page = 0, help_pages = 1;
  Detail detail = Detail::full;
  bool crosshair = true;
  bool status_changed = true, message_changed = true, help_changed = true, crosshair_changed = true;
  bool hint_changed = true, recording_changed = true, labels_changed = true, button_changed = true;
  bool list_changed = true;
  // Where the last frame drew these.
  std::vector<Target> help_targets, button_targets, list_targets;
  Rectangle message_place, hint_place, recording_place, button_place, list_place, help_place;

  /// Adds the nodes, from the lowest to the topmost.
  void add_to(osg::Group& group) {
    for (osg::Node* node :
         {static_cast<osg::Node*>(labels_.get()), static_cast<osg::Node*>(crosshair_.get()), status_panel_.node(),
          static_cast<osg::Node*>(message_.get()), static_cast<osg::Node*>(recording_.get()),
          static_cast<osg::Node*>(button_.get()), static_cast<osg::Node*>(list_.get()),
          static_cast<osg::Node*>(help_.get()), static_cast<osg::Node*>(hint_.get())}) {
      group.addChild(node);
    }
  }

  /// The name of the part at a point of the picture, x and y in [-1, 1]; empty: none.
  [[nodiscard]] std::string name_at(const std::vector<Target>& targets, double x, double y) const {
    const auto found =
        std::find_if(targets.begin(), targets.end(), [&](const Target& target) { return is_in(target.where, x, y); });
    return found == targets.end() || detail == Detail::off ? std::string() : found->name;
  }
  /// Whether a point of the picture, x and y in [-1, 1], is in a rectangle of pixels.
  [[nodiscard]] bool is_in(const Rectangle& r, double x, double y) const {
    const double across = 0.5 * (x + 1.0) * page_.width, up = 0.5 * (y + 1.0) * page_.height;
    return across >= r.x && across < r.x + r.width && up >= r.y && up < r.y + r.height;
  }
  /// The page of the present window, before anything covers a part of it.
  [[nodiscard]] Page whole_page() const {
    const osg::Viewport& viewport = *picture_->getViewport();
    return Page::of(static_cast<float>(viewport.width()), static_cast<float>(viewport.height()));
  }
  [[nodiscard]] std::vector<Rectangle> places() const {
    std::vector<Rectangle> all{hint_place};
    if (detail != Detail::off) {
      all.insert(all.end(),
                 {status_panel_.place(), message_place, recording_place, button_place, list_place, help_place});
    }
    std::erase_if(all, [](const Rectangle& r) { return r == Rectangle{}; });
    return all;
  }

  void change_all() {
    status_changed = message_changed = help_changed = crosshair_changed = hint_changed = recording_changed = true;
    labels_changed = button_changed = list_changed = true;
  }
  /// Hides everything but the hint, or no longer.
  void set_off(bool off) {
    const osg::Node::NodeMask mask = off ? 0u : ~0u;
    status_panel_.node()->setNodeMask(mask);
    for (const auto& group : {labels_, crosshair_, message_, recording_, button_, list_, help_}) {
      group->setNodeMask(mask);
    }
  }

  [[nodiscard]] std::vector<StatusLine> status_shown() const {
    if (help_shown) return {};  // the help takes its place
    std::vector<StatusLine> shown = status;
    if (detail == Detail::minimal) shown.resize(std::min<std::size_t>(shown.size(), 1));
    return shown;
  }

  void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
    Page page = whole_page();
    if (plan != Rectangle{} && !leaves_room(plan, page)) {
      const float gap = std::round(0.4f * page.margin);
      page.right = plan.x - gap;
      page.below = plan.y - gap;
    }
    if (list && !help_shown && detail != Detail::off) page.right = std::min(page.right, left_of_list(page));
    if (page != page_) change_all();
    page_ = page;
    if (detail != Detail::off) show_recording();
    if (detail != Detail::off && status_changed) status_panel_.lay_out(status_page(), status_shown());
    status_changed = status_changed && detail == Detail::off;
    // The status is the first, then what makes room for it.
    const Rectangle before = std::exchange(status_place_, detail == Detail::off ? Rectangle{} : status_panel_.place());
    const Rectangle plan_before = std::exchange(hint_plan_, plan);
    if (hint_changed || before != status_place_ || plan_before != plan) show_hint();
    message_changed = message_changed || before != status_place_;
    if (detail != Detail::off) lay_out();
    traverse(node, visitor);
  }

 private:
  void show_recording() {
    if (!std::exchange(recording_changed, false)) return;
    const Rectangle before = recording_place;
    const Placed made = recording.empty() ? Placed{} : make_recording(page_, recording, plates_.get());
    show_only(*recording_, {made.node});
    recording_place = made.where;
    status_changed = status_changed || before != recording_place;
  }

  /// In a narrow window the status also stays left of the recording.
  [[nodiscard]] Page status_page() const {
    Page page = page_;
    if (page.small && recording_place != Rectangle{}) {
      page.right = std::min(page.right, recording_place.x - std::round(0.4f * page.margin));
    }
    return page;
  }

  void show_hint() {
    const Rectangle before = hint_place;
    const Placed made =
        hint.empty() ? Placed{} : make_hint(page_, hint, hint_opacity, {status_place_, plan}, plates_.get());
    show_only(*hint_, {made.node});
    hint_place = made.where;
    hint_changed = false;
    message_changed = message_changed || before != hint_place;
  }

  /// The height below which a message has to end, because of the status and the hint.
  [[nodiscard]] float message_limit() const {
    float limit = page_.height;
    for (const Rectangle& above : {status_place_, hint_place}) {
      if (above != Rectangle{}) limit = std::min(limit, above.y - std::round(0.4f * page_.margin));
    }
    return limit;
  }

  void lay_out() {
    osg::StateSet* plates = plates_.get();
    if (message_changed) {
      const bool any = (!message.empty() || progress) && !(help_shown && page_.small);
      const Placed made = any ? make_message(page_, message, tone, progress, message_limit(), plates) : Placed{};
      show_only(*message_, {made.node});
      message_place = made.where;
    }
    if (help_changed) {
      const Help made = help_shown ? make_help(page_, help, help_page, help_focus, plates) : Help{};
      help_page = made.page;
      help_pages = made.pages;
      help_place = show(*help_, help_targets, made);
    }
    if (button_changed) {
      const bool any = !button.empty() && !help_shown && detail == Detail::full;
      button_place = show(*button_, button_targets, any ? make_button(page_, button, plates) : Clickable{});
    }
    if (list_changed) {
      const bool any = list && !help_shown;
      list_place = show(*list_, list_targets, any ? make_list(page_, *list, list_focus, plates) : Clickable{});
    }
    if (crosshair_changed) show_only(*crosshair_, {crosshair && !help_shown ? make_crosshair(page_, plates) : nullptr});
    std::vector<Rectangle> above = places();
    if (plan != Rectangle{}) above.push_back(plan);
    if (labels_changed || above != above_labels_) {
      above_labels_ = std::move(above);
      show_only(*labels_, {help_shown ? nullptr : make_labels(page_, labels, above_labels_, plates)});
    }
    message_changed = help_changed = crosshair_changed = labels_changed = button_changed = list_changed = false;
  }

  static Rectangle show(osg::Group& group, std::vector<Target>& targets, Clickable made) {
    show_only(group, {made.node});
    targets = std::move(made.targets);
    return made.where;
  }

  osg::ref_ptr<osg::Camera> picture_;
  Page page_;
  osg::ref_ptr<osg::StateSet> plates_ = plate_state();
  StatusPanel status_panel_{plates_};
  osg::ref_ptr<osg::Group> message_ = new osg::Group, help_ = new osg::Group, crosshair_ = new osg::Group;
  osg::ref_ptr<osg::Group> hint_ = new osg::Group, recording_ = new osg::Group, labels_ = new osg::Group;
  osg::ref_ptr<osg::Group> button_ = new osg::Group, list_ = new osg::Group;
  Rectangle status_place_;               ///< for which hint and message are laid out
  Rectangle hint_plan_;                  ///< for which the hint is laid out
  std::vector<Rectangle> above_labels_;  ///< for which the labels are laid out
};

Hud::Hud(Frame& frame) : panels_(new Panels(frame.flat())), parent_(frame.flat()), group_(new osg::Group) {
  group_->setName("head-up display");
  osg::StateSet& state = *group_->getOrCreateStateSet();
  // In the order in which they were added, whatever bins the texts would choose: panels before their texts.
  state.setRenderBinDetails(0, "TraversalOrderBin", osg::StateSet::OVERRIDE_RENDERBIN_DETAILS);
  state.setAttributeAndModes(new osg::BlendFunc);
  state.setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
  panels_->add_to(*group_);
  group_->addUpdateCallback(panels_);
  parent_->addChild(group_);
}

Hud::~Hud() { parent_->removeChild(group_); }

void Hud::set_status(std::vector<StatusLine> lines) {
  if (lines == panels_->status) return;
  panels_->status = std::move(lines);
  panels_->status_changed = true;
}

void Hud::set_message(std::string text, Tone tone) {
  if (text == panels_->message && tone == panels_->tone) return;
  panels_->message = std::move(text);
  panels_->tone = tone;
  panels_->message_changed = true;
}

void Hud::set_progress(double share) {
  const std::optional<double> progress = share < 0 ? std::nullopt : std::optional(share);
  if (progress == panels_->progress) return;
  panels_->progress = progress;
  panels_->message_changed = true;
}

void Hud::set_hint(std::string text, double opacity) {
  if (text == panels_->hint && opacity == panels_->hint_opacity) return;
  panels_->hint = std::move(text);
  panels_->hint_opacity = opacity;
  panels_->hint_changed = true;
}

void Hud::set_recording(std::string text) {
  if (text == panels_->recording) return;
  panels_->recording = std::move(text);
  panels_->recording_changed = true;
}

void Hud::set_labels(std::vector<HudLabel> labels) {
  if (labels == panels_->labels) return;
  panels_->labels = std::move(labels);
  panels_->labels_changed = true;
}

void Hud::set_help(std::vector<HelpLine> lines) {
  if (lines == panels_->help) return;
  panels_->help = std::move(lines);
  panels_->help_changed = true;
}

void Hud::show_help(bool shown) {
  if (shown == panels_->help_shown) return;
  panels_->help_shown = shown;
  panels_->help_page = 0;
  panels_->change_all();
}

void Hud::turn_help(int pages) {
  const auto count = static_cast<int>(panels_->help_pages);
  const int page = std::max(0, static_cast<int>(panels_->help_page) + pages) % count;
  if (!panels_->help_shown || panels_->help_page == static_cast<std::size_t>(page)) return;
  panels_->help_page = static_cast<std::size_t>(page);
  panels_->help_changed = true;
}

bool Hud::help_goes_on() const { return panels_->help_shown && panels_->help_page + 1 < panels_->help_pages; }

bool Hud::help_shown() const { return panels_->help_shown; }

std::string Hud::help_at(double x, double y) const { return panels_->name_at(panels_->help_targets, x, y); }

void Hud::set_help_focus(std::string name) {
  if (name == panels_->help_focus) return;
  panels_->help_focus = std::move(name);
  panels_->help_changed = true;
}

void Hud::set_button(std::string text) {
  if (text == panels_->button) return;
  panels_->button = std::move(text);
  panels_->button_changed = true;
}

bool Hud::button_at(double x, double y) const { return !panels_->name_at(panels_->button_targets, x, y).empty(); }

void Hud::set_list(std::optional<HudList> list) {
  if (list == panels_->list) return;
  panels_->list = std::move(list);
  panels_->list_changed = true;
}

std::size_t Hud::list_rows() const { return rows_of_list(panels_->whole_page()); }

std::string Hud::list_at(double x, double y) const { return panels_->name_at(panels_->list_targets, x, y); }

bool Hud::list_covers(double x, double y) const {
  return panels_->detail != Detail::off && panels_->is_in(panels_->list_place, x, y);
}

void Hud::set_list_focus(std::string name) {
  if (name == panels_->list_focus) return;
  panels_->list_focus = std::move(name);
  panels_->list_changed = true;
}

void Hud::set_plan(const Rectangle& where) { panels_->plan = where; }

std::vector<Rectangle> Hud::panels() const { return panels_->places(); }

void Hud::set_detail(Detail detail) {
  if (detail == panels_->detail) return;
  panels_->detail = detail;
  panels_->change_all();
  panels_->set_off(detail == Detail::off);
}

Detail Hud::detail() const { return panels_->detail; }

void Hud::set_crosshair(bool shown) {
  if (shown == panels_->crosshair) return;
  panels_->crosshair = shown;
  panels_->crosshair_changed = true;
}

std::string Hud::text() const {
  std::string all;
  const std::string hint = panels_->hint.empty() ? std::string() : panels_->hint + '\n';
  if (panels_->detail == Detail::off) return hint;
  for (const StatusLine& line : panels_->status_shown()) {
    all += line.label.empty() ? line.value : line.label + ": " + line.value;
    all += '\n';
  }
  if (!panels_->recording.empty()) all += "recording: " + panels_->recording + '\n';
  if (!panels_->message.empty()) all += panels_->message + '\n';
  all += hint;
  for (const HudLabel& label : panels_->labels) all += label.text + '\n';
  if (panels_->list && !panels_->help_shown) {
    all += panels_->list->title + '\n';
    for (const ListRow& row : panels_->list->rows) {
      const char* const boxes[] = {"", "[ ] ", "[-] ", "[x] "};
      all += boxes[static_cast<std::size_t>(row.box)] + row.text + '\n';
    }
  }
  if (panels_->help_shown) {
    for (const HelpLine& line : panels_->help) {
      all += (line.effect.empty() ? line.key : line.key + ": " + line.effect) + '\n';
    }
  }
  return all;
}

}  // namespace roam::graphics
