#include "nodes/occupancy_grid/occupancy_grid_layer.h"

namespace stillframe::nodes {

using scenegraph::Status;
using scenegraph::StatusLevel;

std::unique_ptr<scenegraph::Layer> OccupancyGridLayer::create(std::string_view topic) {
  return std::make_unique<OccupancyGridLayer>(topic);
}

bool OccupancyGridLayer::takesOrphan(const scenegraph::ObjectStore& store, const scenegraph::TopicInfo& topic) {
  return topic.type == scenegraph::ObjectType::OccupancyGridUpdate && isOrphan(store, topic.name);
}

OccupancyGridLayer::OccupancyGridLayer(std::string_view topic) : TopicLayer(topic) {}

void OccupancyGridLayer::open(const scenegraph::LayerContext& context) {
  tracker_.emplace(context, topic());
  tiles_.emplace(node());
  applied_.reset();
}

void OccupancyGridLayer::close() {
  tracker_.reset();
  tiles_.reset();
}

void OccupancyGridLayer::clear() {
  product_ = nullptr;
  tiles_->show(nullptr);
  applied_.reset();
}

std::optional<TopicLayer::Anchor> OccupancyGridLayer::load(const scenegraph::Tick& tick) {
  (void)tracker_->update(tick.time);
  if (tracker_->product() != product_) {
    product_ = tracker_->product();
    tiles_->show(product_);
  }
  tiles_->setOrder(tick.order, tick.of_type);
  return product_ != nullptr ? std::optional(Anchor{product_->header.frame_id, product_->header.frame_from_grid})
                             : std::nullopt;
}

void OccupancyGridLayer::draw(const Placement& /*fixed_from_data*/) {
  if (applied_ != settings_) {
    tiles_->apply(settings_);
    applied_ = settings_;
  }
}

osg::BoundingBoxd OccupancyGridLayer::box() const {
  const GridHeader& header = product_->header;
  return header.cellCount() > 0 ? osg::BoundingBoxd(0.0, 0.0, 0.0, header.resolution_m * header.width,
                                                    header.resolution_m * header.height, 0.0)
                                : osg::BoundingBoxd();
}

Status OccupancyGridLayer::remark() const {
  const GridState& state = product_->state;
  const std::string base = sampleText(product_->base);
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
