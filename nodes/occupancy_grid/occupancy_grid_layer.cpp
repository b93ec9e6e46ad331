#include "nodes/occupancy_grid/occupancy_grid_layer.h"

#include <algorithm>
#include <array>
#include <cmath>

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

std::optional<scenegraph::Picked> OccupancyGridLayer::describeData(const scenegraph::PickHit& hit) const {
  if (product_ == nullptr) {
    return std::nullopt;
  }
  const GridHeader& header = product_->header;
  // The grid is the plane z = 0 of its own frame.
  const tf::RigidTransform& frame_from_grid = header.frame_from_grid;
  const std::array<glm::dvec3, 3> plane{frame_from_grid.translation,
                                        tf::transformPoint(frame_from_grid, {1.0, 0.0, 0.0}),
                                        tf::transformPoint(frame_from_grid, {0.0, 1.0, 0.0})};
  const glm::dvec3 in_frame = scenegraph::meetPlane(hit.ray_in_frame, plane).value_or(hit.point_in_frame);
  const glm::dvec3 in_cells = tf::transformPoint(tf::inverse(frame_from_grid), in_frame) / header.resolution_m;
  const double column = std::floor(in_cells.x);
  const double row = std::floor(in_cells.y);
  if (!(column >= 0.0 && column < header.width && row >= 0.0 && row < header.height)) {
    return std::nullopt;
  }
  const auto x = static_cast<std::uint32_t>(column);
  const auto y = static_cast<std::uint32_t>(row);
  const glm::dvec3 centre_in_grid(header.resolution_m * (column + 0.5), header.resolution_m * (row + 0.5), 0.0);
  scenegraph::Picked picked{.kind = "cell",
                            .id = std::to_string(x) + "," + std::to_string(y),
                            .point_in_frame = tf::transformPoint(frame_from_grid, centre_in_grid),
                            .stamp = header.stamp,
                            .fields = {},
                            .radius_m = std::max(1.0, 4.0 * header.resolution_m)};
  const int value = product_->state->cells.at(x, y);
  picked.add("column", x);
  picked.add("row", y);
  picked.add("value", value);
  picked.add("state", std::string(value == -1                 ? "unknown"
                                  : value < -1 || value > 100 ? "invalid"
                                  : value >= 65               ? "occupied"
                                                              : "free or uncertain"));
  picked.add("resolution_m", header.resolution_m);
  picked.add("updates", product_->state->applied);
  return picked;
}

Status OccupancyGridLayer::remark() const {
  const GridState& state = *product_->state;
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

/// Of the values between the special ones (unknown, invalid; in costmaps 0, 99 and 100).
std::optional<scenegraph::ColorLegend> OccupancyGridLayer::legend() const {
  if (product_ == nullptr) {
    return std::nullopt;
  }
  constexpr std::array kBlack{0.0F, 0.0F, 0.0F};
  constexpr std::array kWhite{1.0F, 1.0F, 1.0F};
  if (settings_.color_scheme == "raw") {
    return scenegraph::ColorLegend{"byte", "", 0.0, 255.0, {kBlack, kWhite}, settings_.has_legend};
  }
  if (settings_.color_scheme == "costmap") {
    const auto color = [](float byte) { return std::array{byte / 255.0F, 0.0F, 1.0F - byte / 255.0F}; };
    return scenegraph::ColorLegend{"cost", "", 1.0, 98.0, {color(2.0F), color(249.0F)}, settings_.has_legend};
  }
  return scenegraph::ColorLegend{"occupancy", "%", 0.0, 100.0, {kWhite, kBlack}, settings_.has_legend};
}

scenegraph::LayerCounts OccupancyGridLayer::counts() const {
  if (product_ == nullptr) {
    return {{"cells", 0}, {"unknown", 0}, {"occupied", 0}, {"invalid", 0}, {"updates", 0}};
  }
  const CellCounts& counts = product_->state->cells.counts();
  return {{"cells", product_->header.cellCount()},
          {"unknown", counts.unknown},
          {"occupied", counts.occupied},
          {"invalid", counts.invalid},
          {"updates", product_->state->applied}};
}

std::vector<scenegraph::SettingSpec> OccupancyGridLayer::settingSpecs() const {
  return occupancyGridSettingsTable().specs();
}

scenegraph::SettingTexts OccupancyGridLayer::settings() const { return occupancyGridSettingsTable().texts(settings_); }

std::expected<void, scenegraph::SettingError> OccupancyGridLayer::changeSettings(
    const scenegraph::SettingTexts& texts) {
  return occupancyGridSettingsTable().apply(texts, settings_);
}

}  // namespace stillframe::nodes
