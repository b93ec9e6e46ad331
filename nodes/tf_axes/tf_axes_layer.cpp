#include "nodes/tf_axes/tf_axes_layer.h"

#include <algorithm>
#include <ranges>
#include <regex>
#include <set>

#include "nodes/osg_math.h"
#include "nodes/tf_axes/triad.h"
#include "scenegraph/placement.h"

namespace stillframe::nodes {
namespace {

using scenegraph::SettingError;
using scenegraph::SettingKind;
using scenegraph::SettingsTable;
using scenegraph::Status;
using scenegraph::StatusLevel;

const SettingsTable<TfAxesLayer::Settings>& table() {
  using S = TfAxesLayer::Settings;
  static const SettingsTable<S> kTable{
      {{.key = "axis_length",
        .label = "Axis length (m)",
        .help = "Length of each arm.",
        .kind = SettingKind::Double,
        .minimum = 1e-4,
        .maximum = 1e6},
       &S::axis_length_m},
      {{.key = "axes", .label = "Axes", .help = "Draw a triad at each frame.", .kind = SettingKind::Bool},
       &S::show_axes},
      {{.key = "parent_lines",
        .label = "Parent lines",
        .help = "Draw a line from each frame to its parent.",
        .kind = SettingKind::Bool},
       &S::show_parent_lines},
      {{.key = "labels", .label = "Names", .help = "Write each frame's name beside it.", .kind = SettingKind::Bool},
       &S::show_labels},
      {{.key = "label_height",
        .label = "Name height (px)",
        .help = "Height of the names.",
        .kind = SettingKind::Double,
        .minimum = 4,
        .maximum = 200},
       &S::label_height_px},
      {{.key = "frame_filter",
        .label = "Only frames",
        .help = "Regular expression that a frame's name must contain; empty shows every frame.",
        .kind = SettingKind::Text},
       &S::frame_filter},
      {{.key = "hidden_frames",
        .label = "Hidden frames",
        .help = "Names of frames that are not drawn, separated by commas.",
        .kind = SettingKind::Text},
       &S::hidden_frames},
      {{.key = "max_frames",
        .label = "Most frames",
        .help = "How many frames are drawn at most, the first to appear; filter them to see others.",
        .kind = SettingKind::Int,
        .minimum = 1,
        .maximum = 1e6},
       &S::max_frames},
      {{.key = "line_color", .label = "Line colour", .help = "Colour of the parent lines.", .kind = SettingKind::Color},
       &S::line_color},
      {{.key = "label_color", .label = "Name colour", .help = "Colour of the names.", .kind = SettingKind::Color},
       &S::label_color}};
  return kTable;
}

std::set<std::string, std::less<>> splitNames(const std::string& list) {
  std::set<std::string, std::less<>> names;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::size_t first = list.find_first_not_of(' ', begin);
    const std::size_t last = list.find_last_not_of(' ', end == 0 ? 0 : end - 1);
    if (first < end && last != std::string::npos && last >= first) {
      names.insert(list.substr(first, last - first + 1));
    }
    begin = end + 1;
  }
  return names;
}

/// Whether a pattern occurs in a name; a search too complex for the library finds nothing.
bool occursIn(const std::string& name, const std::regex& pattern) {
  try {
    return std::regex_search(name, pattern);
  } catch (const std::regex_error&) {
    return false;
  }
}

/// Transform that lays the unit line from the origin to `end`.
osg::Matrixd lineMatrix(const osg::Vec3d& end) {
  osg::Quat turn;
  turn.makeRotate(osg::Vec3d(1.0, 0.0, 0.0), end);
  const double length = end.length();
  return osg::Matrixd::scale(length, length, length) * osg::Matrixd::rotate(turn);
}

}  // namespace

std::unique_ptr<scenegraph::Layer> TfAxesLayer::create(std::string_view) { return std::make_unique<TfAxesLayer>(); }

TfAxesLayer::TfAxesLayer() = default;
TfAxesLayer::~TfAxesLayer() = default;

void TfAxesLayer::attach(const scenegraph::LayerContext& context) { context_.emplace(context); }

void TfAxesLayer::detach() {
  if (context_) {
    clear();
  }
  context_.reset();
  triad_ = nullptr;
  unit_line_ = nullptr;
}

void TfAxesLayer::setVisible(bool visible) {
  visible_ = visible;
  if (!visible && context_) {
    clear();
  }
}

void TfAxesLayer::clear() {
  for (const Shown& shown : shown_ | std::views::reverse) {
    if (osg::MatrixTransform* const node = context_->frames.node(shown.name)) {
      node->removeChild(shown.group);
    }
    context_->frames.release(shown.name);
  }
  shown_.clear();
  applied_.reset();
  resolved_ = 0;
  left_out_ = 0;
  bounds_.init();
  status_ = {};
}

void TfAxesLayer::update(const scenegraph::Tick& tick) {
  if (!context_ || !visible_) {
    return;
  }
  const tf::TransformBuffer& buffer = context_->frames.buffer();
  Inputs inputs{tick.time, context_->frames.fixedFrame(), buffer.revision(), settings_};
  if (applied_ == inputs) {
    return;
  }
  if (!applied_ || applied_->settings != settings_ || applied_->revision != inputs.revision) {
    rebuild();
  }
  applied_ = std::move(inputs);
  for (Shown& shown : shown_) {
    if (shown.line.valid()) {
      poseLine(shown, tick.time);
    }
  }
  judge();
}

void TfAxesLayer::rebuild() {
  const tf::TransformBuffer& buffer = context_->frames.buffer();
  const bool has_new_settings = !applied_ || applied_->settings != settings_;
  if (has_new_settings) {
    clear();
    triad_ = settings_.show_axes ? makeTriad(settings_.axis_length_m) : nullptr;
    unit_line_ = settings_.show_parent_lines ? makeUnitLine() : nullptr;
    if (unit_line_.valid()) {
      unit_line_->setStateSet(line_state_.stateSet());
    }
    line_state_.setColor(settings_.line_color);
  }
  // Frame ids are dense and only ever added, unless the buffer was cleared.
  const std::vector<std::string> names = buffer.frames();
  const bool is_grown = std::ranges::all_of(shown_, [&](const Shown& shown) {
    return shown.id < names.size() && names[shown.id] == shown.name && buffer.parent(shown.id) == shown.parent;
  });
  if (!is_grown) {
    clear();
  }
  const std::regex filter(settings_.frame_filter, std::regex::ECMAScript | std::regex::nosubs);
  const auto hidden = splitNames(settings_.hidden_frames);
  std::size_t next = 0;
  left_out_ = 0;
  std::vector<Shown> all;
  for (tf::FrameId id = 0; id < names.size(); ++id) {
    if (next < shown_.size() && shown_[next].id == id) {
      all.push_back(std::move(shown_[next++]));
      continue;
    }
    if (hidden.contains(names[id]) || !occursIn(names[id], filter)) {
      continue;
    }
    if (all.size() >= static_cast<std::size_t>(settings_.max_frames)) {
      ++left_out_;
      continue;
    }
    Shown& shown = all.emplace_back(Shown{id, names[id], buffer.parent(id), {}, {}});
    hang(shown);
  }
  shown_ = std::move(all);
}

void TfAxesLayer::hang(Shown& shown) {
  shown.group = new osg::Group;
  shown.group->setName("tf");
  if (triad_.valid()) {
    shown.group->addChild(triad_);
  }
  if (unit_line_.valid() && shown.parent != tf::kNoFrame) {
    shown.line = new osg::MatrixTransform;
    shown.line->setDataVariance(osg::Object::DYNAMIC);
    shown.line->addChild(unit_line_);
    shown.group->addChild(shown.line);
  }
  if (settings_.show_labels) {
    shown.group->addChild(labels_.make(shown.name, settings_.label_height_px, settings_.label_color));
  }
  context_->frames.acquire(shown.name).addChild(shown.group);
}

void TfAxesLayer::poseLine(Shown& shown, tf::TimePoint time) {
  const auto child_from_parent = context_->frames.buffer().tryLookupTransform(shown.id, shown.parent, time);
  const bool has_length = child_from_parent && child_from_parent->translation != glm::dvec3(0.0);
  if (has_length) {
    const osg::Matrixd matrix = lineMatrix(toOsg(child_from_parent->translation));
    if (matrix != shown.line->getMatrix()) {
      shown.line->setMatrix(matrix);
    }
  }
  shown.line->setNodeMask(has_length ? ~0U : 0U);
}

void TfAxesLayer::judge() {
  status_ = {};
  resolved_ = 0;
  bounds_.init();
  const Shown* first_failed = nullptr;
  tf::LookupFailure first_failure;
  const double arm = settings_.axis_length_m;
  for (const Shown& shown : shown_) {
    const auto fixed_from_frame = context_->frames.fixedFromFrame(shown.name);
    if (fixed_from_frame) {
      ++resolved_;
      const osg::Vec3d at = toOsg(fixed_from_frame->translation);
      bounds_.expandBy(at + osg::Vec3d(arm, arm, arm));
      bounds_.expandBy(at - osg::Vec3d(arm, arm, arm));
    } else if (first_failed == nullptr) {
      first_failed = &shown;
      first_failure = fixed_from_frame.error();
    }
  }
  if (first_failed != nullptr) {
    const Status reason = scenegraph::placementStatus(context_->frames, first_failed->name, first_failure);
    const std::uint64_t unresolved = shown_.size() - resolved_;
    status_ = {StatusLevel::Info, "UnresolvedFrames",
               std::to_string(unresolved) + " of " + std::to_string(shown_.size()) +
                   (unresolved == 1 ? " frames is" : " frames are") + " not drawn: " + reason.message +
                   (unresolved == 1 ? "" : "; and others") + (left_out_ > 0 ? "; " + leftOutText() : "")};
  } else if (left_out_ > 0) {
    status_ = {StatusLevel::Info, "TooManyFrames", leftOutText()};
  }
}

std::string TfAxesLayer::leftOutText() const {
  return "the first " + std::to_string(shown_.size()) + " of " + std::to_string(shown_.size() + left_out_) +
         " frames are drawn: set frame_filter to see others, or raise max_frames";
}

scenegraph::LayerCounts TfAxesLayer::counts() const {
  scenegraph::LayerCounts counts{{"frames", shown_.size()}, {"unresolved", shown_.size() - resolved_}};
  if (left_out_ > 0) {
    counts.emplace_back("left_out", left_out_);
  }
  return counts;
}

std::vector<scenegraph::SettingSpec> TfAxesLayer::settingSpecs() const { return table().specs(); }

scenegraph::SettingTexts TfAxesLayer::settings() const { return table().texts(settings_); }

std::expected<void, SettingError> TfAxesLayer::applySettings(const scenegraph::SettingTexts& texts) {
  Settings changed = settings_;
  if (const auto applied = table().apply(texts, changed); !applied) {
    return applied;
  }
  try {
    const std::regex check(changed.frame_filter, std::regex::ECMAScript | std::regex::nosubs);
  } catch (const std::regex_error& error) {
    return std::unexpected(SettingError{
        "BadValue", "frame_filter: '" + changed.frame_filter + "' is no regular expression: " + error.what()});
  }
  settings_ = std::move(changed);
  return {};
}

}  // namespace stillframe::nodes
