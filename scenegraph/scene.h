#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <osg/BoundingBox>
#include <osg/Group>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/layer.h"

namespace stillframe::scenegraph {

/// A layer in a view, with the name it goes by.
struct LayerSlot {
  std::string topic;  ///< or the type's name for a built-in
  const LayerType* type = nullptr;
  std::unique_ptr<Layer> layer;
};

/// What one view shows: its fixed frame, its layers and their graph; no window, no camera, no Qt.
///
/// The view widget, `stillframe render`, `export` and the osgDB plugin all drive this one class. GUI thread only (the
/// thread that owns the graph); background work goes through the executor.
class Scene {
 public:
  Scene(std::shared_ptr<Dataset> dataset, std::span<const LayerType> types, Executor& executor,
        std::function<void()> request_update = {});
  ~Scene();

  [[nodiscard]] Dataset& dataset() noexcept { return *dataset_; }
  [[nodiscard]] osg::Group& root() noexcept { return frames_.root(); }
  [[nodiscard]] FrameGraph& frames() noexcept { return frames_; }

  /// Frame chosen by hand, or nullopt to choose by itself: map, world, odom, ... else the root with the most frames.
  void setFixedFrame(std::optional<std::string> frame);
  [[nodiscard]] bool isFixedFrameExplicit() const noexcept { return chosen_frame_.has_value(); }
  /// The frame in use; "" while the dataset has no frame and none was chosen.
  [[nodiscard]] std::string fixedFrame() const;

  /// Adds a layer for a topic of the store, or a built-in by its type's name. Refuses what no type consumes.
  std::expected<LayerSlot*, Status> addLayer(std::string_view topic);
  /// Adds the built-ins and a layer for every drawable topic not yet there (new topics of a growing dataset too).
  void addDefaultLayers();
  void removeLayer(std::string_view topic);
  [[nodiscard]] LayerSlot* findLayer(std::string_view topic);
  [[nodiscard]] const std::vector<std::unique_ptr<LayerSlot>>& layers() const noexcept { return layers_; }

  /// Poses frames and updates layers for `time`. Returns whether the picture may have changed.
  bool update(tf::TimePoint time);
  [[nodiscard]] tf::TimePoint time() const noexcept { return time_; }
  [[nodiscard]] bool isPending() const;
  /// Box of all visible layers in the fixed frame; the axes count, the reference grid does not.
  [[nodiscard]] osg::BoundingBoxd boundsInFixed() const;

 private:
  std::shared_ptr<Dataset> dataset_;
  std::span<const LayerType> types_;
  FrameGraph frames_;
  LayerContext context_;
  std::vector<std::unique_ptr<LayerSlot>> layers_;
  std::optional<std::string> chosen_frame_;
  tf::TimePoint time_;
};

/// The frame a new view takes when nobody chose one: the first of map, world, earth, odom, base_link, base_footprint
/// that exists, else the root of the largest tree (ties: first seen); "" without frames.
[[nodiscard]] std::string automaticFixedFrame(const tf::TransformBuffer& buffer);

}  // namespace stillframe::scenegraph
