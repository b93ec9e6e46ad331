#include "nodes/occupancy_grid/occupancy_grid_layer.h"

#include "nodes/osg_math.h"
#include "scenegraph/placement.h"
#include "scenegraph/store/tf_clock.h"

namespace stillframe::nodes {

using scenegraph::Status;
using scenegraph::StatusLevel;

std::unique_ptr<scenegraph::Layer> OccupancyGridLayer::create(std::string_view topic) {
  return std::make_unique<OccupancyGridLayer>(topic);
}

bool OccupancyGridLayer::takesOrphan(const scenegraph::ObjectStore& store, const scenegraph::TopicInfo& topic) {
  return topic.type == scenegraph::ObjectType::OccupancyGridUpdate && isOrphan(store, topic.name);
}

OccupancyGridLayer::OccupancyGridLayer(std::string_view topic) : topic_(topic) {}

void OccupancyGridLayer::attach(const scenegraph::LayerContext& context) {
  context_.emplace(context);
  tracker_.emplace(context, topic_);
  tiles_.emplace(topic_);
  applied_.reset();
}

void OccupancyGridLayer::detach() {
  if (context_) {
    clear();
  }
  tracker_.reset();
  tiles_.reset();
  context_.reset();
}

void OccupancyGridLayer::setVisible(bool visible) {
  visible_ = visible;
  if (!visible && context_) {
    clear();
  }
}

void OccupancyGridLayer::clear() {
  product_ = nullptr;
  tiles_->show(nullptr);
  hold(std::nullopt);
  applied_.reset();
  status_ = {};
  bounds_.init();
}

bool OccupancyGridLayer::isPending() const { return visible_ && tracker_ && tracker_->isPending(); }

void OccupancyGridLayer::update(const scenegraph::Tick& tick) {
  if (!context_ || !visible_) {
    return;
  }
  (void)tracker_->update(tick.time);
  if (tracker_->product() != product_) {
    product_ = tracker_->product();
    tiles_->show(product_);
  }
  hold(product_ != nullptr ? std::optional(product_->header.frame_id) : std::nullopt);
  tiles_->setOrder(tick.order, tick.of_type);
  if (applied_ != settings_) {
    tiles_->apply(settings_);
    applied_ = settings_;
  }
  const Placement placement = fixedFromGrid();
  bounds_.init();
  if (product_ != nullptr && placement && product_->header.cellCount() > 0) {
    const GridHeader& header = product_->header;
    for (const double x : {0.0, header.resolution_m * header.width}) {
      for (const double y : {0.0, header.resolution_m * header.height}) {
        bounds_.expandBy(toOsg(tf::transformPoint(*placement, {x, y, 0.0})));
      }
    }
  }
  status_ = judge(placement);
}

void OccupancyGridLayer::hold(const std::optional<std::string>& frame) {
  if (held_frame_ == frame) {
    return;
  }
  if (held_frame_) {
    if (osg::MatrixTransform* const parent = context_->frames.node(*held_frame_)) {
      parent->removeChild(tiles_->node());
    }
    context_->frames.release(*held_frame_);
  }
  held_frame_ = frame;
  if (held_frame_) {
    context_->frames.acquire(*held_frame_).addChild(tiles_->node());
  }
}

OccupancyGridLayer::Placement OccupancyGridLayer::fixedFromGrid() const {
  if (product_ == nullptr) {
    return std::unexpected(tf::LookupFailure{});
  }
  const auto fixed_from_frame = context_->frames.fixedFromFrame(*held_frame_);
  if (!fixed_from_frame) {
    return fixed_from_frame;
  }
  return *fixed_from_frame * product_->header.frame_from_grid;
}

Status OccupancyGridLayer::judge(const Placement& placement) const {
  if (product_ == nullptr) {
    return tracker_->status();
  }
  if (!placement) {
    return scenegraph::placementStatus(context_->frames, *held_frame_, placement.error());
  }
  if (tracker_->status().level != StatusLevel::Ok) {
    return tracker_->status();
  }
  const GridState& state = product_->state;
  const std::string base = "'" + topic_ + "' at " + scenegraph::timeText(product_->base.log_time) + ": ";
  const std::string all = std::to_string(state.applied + state.refused) + " updates ";
  if (state.refused > 0) {
    return {StatusLevel::Info, "UpdatesRefused",
            base + std::to_string(state.refused) + " of " + all + "are not applied; the first: " + state.first_refusal};
  }
  if (state.clipped > 0) {
    return {StatusLevel::Info, "UpdatesClipped",
            base + std::to_string(state.clipped) + " of " + all + "reach beyond the grid and are applied in part"};
  }
  if (state.other_frame > 0) {
    return {StatusLevel::Info, "UpdateFrameDiffers",
            base + std::to_string(state.other_frame) + " of " + all + "name another frame, first '" +
                state.first_frame + "', than the grid, '" + product_->header.frame_id +
                "'; they are applied by their cells"};
  }
  if (product_->header.note.level != StatusLevel::Ok) {
    Status note = product_->header.note;
    note.message = base + note.message;
    return note;
  }
  if (product_->header.cellCount() == 0) {
    return {StatusLevel::Info, "EmptyGrid", base + "the grid has no cells"};
  }
  return {};
}

scenegraph::LayerCounts OccupancyGridLayer::counts() const {
  if (product_ == nullptr) {
    return {{"cells", 0}, {"unknown", 0}, {"occupied", 0}, {"invalid", 0}, {"updates", 0}};
  }
  const CellCounts& counts = product_->state.cells.counts();
  return {{"cells", product_->header.cellCount()},
          {"unknown", counts.unknown},
          {"occupied", counts.occupied},
          {"invalid", counts.invalid},
          {"updates", product_->state.applied}};
}

std::vector<scenegraph::SettingSpec> OccupancyGridLayer::settingSpecs() const {
  return occupancyGridSettingsTable().specs();
}

scenegraph::SettingTexts OccupancyGridLayer::settings() const { return occupancyGridSettingsTable().texts(settings_); }

std::expected<void, scenegraph::SettingError> OccupancyGridLayer::applySettings(const scenegraph::SettingTexts& texts) {
  return occupancyGridSettingsTable().apply(texts, settings_);
}

}  // namespace stillframe::nodes
