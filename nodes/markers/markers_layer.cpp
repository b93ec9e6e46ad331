#include "nodes/markers/markers_layer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "nodes/buffer_limit.h"
#include "nodes/osg_math.h"
#include "scenegraph/how_many.h"
#include "scenegraph/placement.h"
#include "scenegraph/store/tf_clock.h"

namespace stillframe::nodes {

using scenegraph::howMany;
using scenegraph::Status;
using scenegraph::StatusLevel;

std::unique_ptr<scenegraph::Layer> MarkersLayer::create(std::string_view topic) {
  return std::make_unique<MarkersLayer>(topic);
}

void MarkersLayer::attach(const scenegraph::LayerContext& context) {
  context_.emplace(context);
  tracker_.emplace(context, topic_);
  picture_.emplace(context.frames, topic_);
  shelf_.emplace(context);
}

void MarkersLayer::detach() {
  if (context_) {
    clear();
  }
  tracker_.reset();
  picture_.reset();
  shelf_.reset();
  context_.reset();
}

void MarkersLayer::changeVisible(bool visible) {
  visible_ = visible;
  if (!visible && context_) {
    clear();
  }
}

void MarkersLayer::clear() {
  tracker_->reset();
  picture_->clear();
  status_ = {};
  bounds_.init();
}

void MarkersLayer::update(const scenegraph::Tick& tick) {
  if (!context_ || !visible_) {
    return;
  }
  const std::uint64_t namespaces_before = picture_->namespacesRevision();
  tracker_->update(tick.time);
  if (tracker_->product() != nullptr) {
    buffer_texels_ = tick.buffer_texels;
    picture_->show(tracker_->product(), settings_, buffer_texels_);
    shelf_->want(picture_->wantedModels());
    picture_->setModels(shelf_->models());
  } else {
    picture_->clear();
  }
  if (picture_->namespacesRevision() != namespaces_before) {
    noteOtherSettings();
  }
  bounds_.init();
  for (const std::string& frame : picture_->frames()) {
    const osg::BoundingBoxd box = picture_->boxIn(frame);
    const auto fixed_from_frame = context_->frames.fixedFromFrame(frame);
    for (unsigned i = 0; fixed_from_frame && box.valid() && i < 8; ++i) {
      const osg::Vec3d corner = box.corner(i);
      bounds_.expandBy(toOsg(tf::transformPoint(*fixed_from_frame, {corner.x(), corner.y(), corner.z()})));
    }
  }
  status_ = judge(tick.time);
}

Status MarkersLayer::judge(tf::TimePoint time) const {
  const std::vector<std::string> frames = picture_->frames();
  const std::string* first = nullptr;
  tf::LookupFailure failure;
  std::size_t failed = 0;
  for (const std::string& frame : frames) {
    const auto fixed_from_frame = context_->frames.fixedFromFrame(frame);
    if (!fixed_from_frame && failed++ == 0) {
      first = &frame;
      failure = fixed_from_frame.error();
    }
  }
  if (first != nullptr) {
    Status status = scenegraph::placementStatus(context_->frames, *first, failure);
    if (frames.size() > 1) {
      status.message = std::to_string(failed) + " of the " + std::to_string(frames.size()) + " frames of '" + topic_ +
                       "' cannot be placed: " + status.message;
    }
    return status;
  }
  return tracker_->status().level != StatusLevel::Ok ? tracker_->status() : remark(time);
}

Status MarkersLayer::remark(tf::TimePoint time) const {
  const SceneState& state = *tracker_->product();
  const std::string base = "'" + topic_ + "': ";
  if (state.refused > 0) {
    return {StatusLevel::Warn, "TooManyMarkers",
            base + howMany(state.refused, "markers") +
                " found no room: all together are beyond 1 GiB, or lie in more frames than can be drawn"};
  }
  if (!state.faults.empty()) {
    return {StatusLevel::Warn, "MarkersRefused",
            base + (state.faults.size() == 1
                        ? state.faults.front()
                        : std::to_string(state.faults.size()) +
                              " markers of the newest message are not drawn; the first: " + state.faults.front())};
  }
  const MarkerPicture::Counts counts = picture_->counts();
  if (counts.texels_too_many > 0) {
    return bufferTooLarge(base + "shapes or lines among its " + howMany(counts.entities, "markers"),
                          counts.texels_too_many, buffer_texels_);
  }
  if (state.totals.unsound + counts.left_out > 0) {
    return {StatusLevel::Warn, "PrimitivesLeftOut",
            base + howMany(state.totals.unsound + counts.left_out, "primitives") +
                " are left out: poses or sizes that are not finite or beyond reach, wrong indices, triangles without "
                "area, or more than " +
                std::to_string(RestParts::kMostTexts) + " texts"};
  }
  if (const auto failure = picture_->modelFailure()) {
    const std::uint64_t others = counts.failed_models - 1;
    return {StatusLevel::Warn, failure->code,
            base + failure->message + (others > 0 ? ", and so for " + howMany(others, "others") : "")};
  }
  if (state.totals.flat > 0) {
    return {StatusLevel::Info, "ZeroScale",
            base + howMany(state.totals.flat, "primitives") + " drawn flat, for a scale of 0 along an axis"};
  }
  if (state.totals.invisible > 0) {
    return {StatusLevel::Info, "Transparent",
            base + howMany(state.totals.invisible, "primitives") + " cannot be seen, for an alpha of 0"};
  }
  if (state.undecodable > 0) {
    return {StatusLevel::Info, "UndecodableMessages",
            base + howMany(state.undecodable, "earlier messages") + " could not be read; what they did is not shown"};
  }
  if (state.totals.entities == 0) {
    return {StatusLevel::Info, "NoMarkers",
            base + "no marker is there at " + scenegraph::timeText(time) +
                ": all have been deleted or their lifetime has ended"};
  }
  if (counts.entities == 0) {
    return {StatusLevel::Info, "NamespacesHidden",
            base + howMany(counts.hidden, "markers") + ", all in namespaces that are switched off"};
  }
  if (const auto moved = movedFrame(time)) {
    return {StatusLevel::Info, "NotFrameLocked",
            base + "markers that are not frame-locked are carried along with '" + *moved +
                "' all the same, which has moved since their message"};
  }
  return {};
}

std::optional<std::string> MarkersLayer::movedFrame(tf::TimePoint time) const {
  const SceneState& state = *tracker_->product();
  if (state.totals.free_in_fixed == 0) {
    return std::nullopt;
  }
  const tf::TransformBuffer& buffer = context_->frames.buffer();
  for (const std::string& frame : picture_->frames()) {
    const auto since = picture_->oldestFree(frame);
    const auto now = context_->frames.fixedFromFrame(frame);
    if (!since || !now || frame == context_->frames.fixedFrame() || *since >= time) {
      continue;
    }
    const auto then = buffer.tryLookupTransform(context_->frames.fixedFrame(), frame, *since);
    if (then && (glm::distance(then->translation, now->translation) > 1e-3 ||
                 std::abs(glm::dot(then->rotation, now->rotation)) < 1.0 - 1e-7)) {
      return frame;
    }
  }
  return std::nullopt;
}

void MarkersLayer::collectNodes(std::vector<osg::Node*>& nodes) const {
  if (picture_) {
    picture_->collectNodes(nodes);
  }
}

scenegraph::LayerCounts MarkersLayer::counts() const {
  const auto counts = picture_ ? picture_->counts() : MarkerPicture::Counts{};
  return {{"entities", counts.entities},
          {"primitives", counts.primitives},
          {"hidden", counts.hidden},
          {"draw_calls", counts.draw_calls}};
}

std::string MarkersLayer::sourceFrame() const {
  const auto frames = picture_ ? picture_->frames() : std::vector<std::string>{};
  return frames.empty() ? "" : frames.front();
}

std::vector<scenegraph::SettingSpec> MarkersLayer::settingSpecs() const {
  return markersSettingSpecs(settings_, picture_ ? picture_->namespaces() : std::set<std::string>{});
}

scenegraph::SettingTexts MarkersLayer::settings() const {
  return markersSettingTexts(settings_, picture_ ? picture_->namespaces() : std::set<std::string>{});
}

std::expected<void, scenegraph::SettingError> MarkersLayer::changeSettings(const scenegraph::SettingTexts& texts) {
  return applyMarkersSettings(texts, settings_);
}

}  // namespace stillframe::nodes
