#include "nodes/tf_axes/tf_axes_layer.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ranges>
#include <regex>

#include "nodes/osg_math.h"
#include "nodes/tf_axes/frame_list.h"
#include "nodes/tf_axes/label_layout.h"
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
        .help = "Names of frames that are not drawn, separated by commas; a comma in a name has a backslash before it.",
        .kind = SettingKind::Text},
       &S::hidden_frames},
      {{.key = "stale_after",
        .label = "Stale after (s)",
        .help = "A moving frame whose sample is older than this is dimmed and its age is written; 0: never.",
        .kind = SettingKind::Double,
        .minimum = 0,
        .maximum = 1e9},
       &S::stale_after_s},
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

/// Whether a pattern occurs in a name; a search too complex for the library finds nothing.
bool occursIn(const std::string& name, const std::regex& pattern) {
  try {
    return std::regex_search(name, pattern);
  } catch (const std::regex_error&) {
    return false;
  }
}

/// "3.2 s", "45 s", "12 min", "5 h": short, and steady while the time goes on.
std::string ageText(double seconds) {
  std::array<char, 32> text{};
  if (seconds < 10.0) {
    std::snprintf(text.data(), text.size(), "%.1f s", seconds);
  } else if (seconds < 120.0) {
    std::snprintf(text.data(), text.size(), "%.0f s", seconds);
  } else if (seconds < 7200.0) {
    std::snprintf(text.data(), text.size(), "%.0f min", seconds / 60.0);
  } else {
    std::snprintf(text.data(), text.size(), "%.4g h", seconds / 3600.0);
  }
  return text.data();
}

scenegraph::Color dimmed(const scenegraph::Color& color) {
  return {.r = 0.55F * color.r, .g = 0.55F * color.g, .b = 0.55F * color.b, .a = color.a};
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
  dim_triad_ = nullptr;
  unit_line_ = nullptr;
}

void TfAxesLayer::changeVisible(bool visible) {
  visible_ = visible;
  if (!visible && context_) {
    clear();
  }
}

void TfAxesLayer::clear() {
  for (const Shown& shown : shown_ | std::views::reverse) {
    context_->frames.unhang(shown.name, *shown.group);
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
    const auto stamp = buffer.stampInForce(shown.id, tick.time);
    if (shown.line.valid() && (!shown.is_posed || shown.stamp != stamp)) {
      shown.is_posed = true;
      shown.stamp = stamp;
      poseLine(shown, tick.time);
    }
    judgeAge(shown, stamp, tick.time);
  }
  judge();
}

void TfAxesLayer::rebuild() {
  const tf::TransformBuffer& buffer = context_->frames.buffer();
  const bool has_new_settings = !applied_ || applied_->settings != settings_;
  if (has_new_settings) {
    clear();
    triad_ = settings_.show_axes ? makeTriad(settings_.axis_length_m) : nullptr;
    dim_triad_ = settings_.show_axes ? makeTriad(settings_.axis_length_m, true) : nullptr;
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
  const auto hidden = splitFrameNames(settings_.hidden_frames);
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
    Shown& shown = all.emplace_back();
    shown.id = id;
    shown.name = names[id];
    shown.parent = buffer.parent(id);
    hang(shown);
  }
  shown_ = std::move(all);
  for (Shown& shown : shown_) {
    const auto edge = buffer.edge(shown.id);
    shown.is_static = !edge || edge->is_static;
    shown.is_posed = false;
  }
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
    shown.label = labels_.make(shown.name, settings_.label_height_px, settings_.label_color);
    shown.group->addChild(shown.label);
  }
  context_->frames.hang(shown.name, *shown.group);
}

void TfAxesLayer::poseLine(Shown& shown, tf::TimePoint time) {
  // From above, which is the sample as it lies there; the other way would be closed across the tree.
  const auto parent_from_child = context_->frames.buffer().tryLookupTransform(shown.parent, shown.id, time);
  const bool has_length = parent_from_child && parent_from_child->translation != glm::dvec3(0.0);
  if (has_length) {
    const osg::Matrixd matrix = lineMatrix(toOsg(tf::inverse(*parent_from_child).translation));
    if (matrix != shown.line->getMatrix()) {
      shown.line->setMatrix(matrix);
    }
  }
  shown.line->setNodeMask(has_length ? ~0U : 0U);
}

void TfAxesLayer::judgeAge(Shown& shown, std::optional<tf::TimePoint> stamp, tf::TimePoint time) {
  const bool may_age = !shown.is_static && settings_.stale_after_s > 0.0;
  const double age_s = may_age && stamp ? tf::secondsBetween(*stamp, time) : 0.0;
  const bool is_stale = may_age && age_s > settings_.stale_after_s;
  if (is_stale != shown.is_stale && triad_.valid()) {
    shown.group->replaceChild(is_stale ? triad_.get() : dim_triad_.get(), is_stale ? dim_triad_.get() : triad_.get());
  }
  shown.is_stale = is_stale;
  if (shown.label.valid()) {
    shown.text = is_stale ? shown.name + " (" + ageText(age_s) + " old)" : shown.name;
    writeLabel(shown, shown.text);
    shown.label->setNodeMask(~0U);
  }
}

void TfAxesLayer::writeLabel(const Shown& shown, const std::string& text) const {
  FrameLabels::setText(*shown.label, text, shown.is_stale ? dimmed(settings_.label_color) : settings_.label_color);
}

void TfAxesLayer::setView(const scenegraph::CameraView& view, const scenegraph::PictureSize& size) {
  if (!context_ || !visible_ || !settings_.show_labels) {
    return;
  }
  constexpr double kSamePx = 3.0;
  constexpr double kWidthOfLetter = 0.62;  // of the height of the text, in DejaVu Sans with some air
  constexpr double kHeightOfLine = 1.2;
  constexpr std::size_t kMostLines = 6;
  std::vector<LabelWish> wishes(shown_.size());
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const auto fixed_from_frame = context_->frames.fixedFromFrame(shown_[i].name, shown_[i].id);
    const auto at = fixed_from_frame ? scenegraph::toScreen(view, size, fixed_from_frame->translation) : std::nullopt;
    if (at && at->position_px.x >= 0.0 && at->position_px.x <= size.width_px && at->position_px.y >= 0.0 &&
        at->position_px.y <= size.height_px) {
      wishes[i] = {at->position_px,
                   settings_.label_height_px * size.pixel_ratio *
                       glm::dvec2(kWidthOfLetter * static_cast<double>(shown_[i].text.size()), kHeightOfLine),
                   at->depth_m, true};
    }
  }
  const std::vector<LabelPlace> places = placeLabels(wishes, kSamePx * size.pixel_ratio, kMostLines);
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    shown_[i].label->setNodeMask(places[i].is_shown ? ~0U : 0U);
    if (!places[i].is_shown) {
      continue;
    }
    std::string text = shown_[i].text;
    const auto& also = places[i].also;
    const std::size_t named = also.size() < kMostLines ? also.size() : kMostLines - 2;
    for (std::size_t line = 0; line < named; ++line) {
      text += '\n' + shown_[also[line]].text;
    }
    if (named < also.size()) {
      text += "\n+ " + std::to_string(also.size() - named) + " more";
    }
    FrameLabels::setHeight(*shown_[i].label, settings_.label_height_px * size.pixel_ratio);
    writeLabel(shown_[i], text);
  }
}

void TfAxesLayer::judge() {
  status_ = {};
  resolved_ = 0;
  bounds_.init();
  const Shown* first_failed = nullptr;
  tf::LookupFailure first_failure;
  const double arm = settings_.axis_length_m;
  for (const Shown& shown : shown_) {
    const auto fixed_from_frame = context_->frames.fixedFromFrame(shown.name, shown.id);
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

std::vector<scenegraph::SettingSpec> TfAxesLayer::settingSpecs() const { return table().specs(); }

scenegraph::SettingTexts TfAxesLayer::settings() const { return table().texts(settings_); }

std::expected<void, SettingError> TfAxesLayer::changeSettings(const scenegraph::SettingTexts& texts) {
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
