#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <osg/BoundingBox>
#include <osg/Group>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenegraph/layer.h"
#include "scenegraph/work_meter.h"

namespace stillframe::scenegraph {

/// A layer in a view, with the names it goes by.
struct LayerSlot {
  std::string id;     ///< in its scene: the topic; "TOPIC#2", "TOPIC#3", ... of its duplicates
  std::string topic;  ///< or the type's name for a built-in
  std::string title;  ///< for people: the id until somebody gives it another
  const LayerType* type = nullptr;
  std::unique_ptr<WorkMeter> meter;  ///< of the layer's background work
  std::unique_ptr<Layer> layer;      // after the meter, which it uses
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
  [[nodiscard]] const FrameGraph& frames() const noexcept { return frames_; }
  /// Where background work for what is shown may run.
  [[nodiscard]] Executor& executor() noexcept { return context_.executor; }

  /// Frame chosen by hand, or nullopt to choose by itself: map, world, odom, ... else the root with the most frames.
  void setFixedFrame(std::optional<std::string> frame);
  /// The frame that automatic choice takes before any other, while it exists: what was last chosen by hand elsewhere.
  void setPreferredFrame(std::optional<std::string> frame);
  /// What automatic choice gives, whether it is in use or not; "" without transforms.
  [[nodiscard]] const std::string& automaticFrame() const;
  [[nodiscard]] bool isFixedFrameExplicit() const noexcept { return chosen_frame_.has_value(); }
  /// The frame in use. In a dataset without transforms the frame of the first visible layer's data, so that the data
  /// can be seen alone; "" when there is none either.
  [[nodiscard]] std::string fixedFrame() const;

  /// What the context that draws the scene takes in one texture buffer (GlContextInfo); the next update() heeds it.
  /// Returns whether it is another than before.
  bool setBufferTexels(std::uint64_t texels);

  /// Adds a layer for a topic of the store, or a built-in by its type's name, and another for the same by "TOPIC#2",
  /// ...; the one that is there when it is. Refuses what no type consumes.
  std::expected<LayerSlot*, Status> addLayer(std::string_view id);
  /// What there can be layers of: the built-ins, then the topics that some type consumes.
  [[nodiscard]] std::vector<std::string> drawableTopics() const;
  /// Adds the built-ins and a layer for every drawable topic not yet there (new topics of a growing dataset too), but
  /// for what was removed.
  void addDefaultLayers();
  /// A second layer of the same topic, with the same settings, right behind `original`. What it decodes is shared.
  LayerSlot& duplicateLayer(const LayerSlot& original);
  void removeLayer(std::string_view id);
  /// Puts the layers of these ids in front, in this order, and leaves the others as they are; unknown ids do nothing.
  /// Of flat things in one plane the later layer covers the earlier; of what has the very same depth the earlier is
  /// seen.
  void arrangeLayers(std::span<const std::string> ids);
  [[nodiscard]] LayerSlot* findLayer(std::string_view id);
  [[nodiscard]] const std::vector<std::unique_ptr<LayerSlot>>& layers() const noexcept { return layers_; }
  /// Topics and built-ins that addDefaultLayers() leaves out since their layer was removed; addLayer() takes one off.
  [[nodiscard]] const std::set<std::string>& removedTopics() const noexcept { return removed_topics_; }
  void setRemovedTopics(std::set<std::string> topics) { removed_topics_ = std::move(topics); }

  /// Poses frames and updates layers for `time`. Returns whether the picture may have changed: not when time, fixed
  /// frame, data, layers and their settings are what they were and no background work has finished. Then nothing is
  /// touched, and it costs some nanoseconds a layer.
  bool update(tf::TimePoint time);
  /// How often update() has brought its layers to a tick: for tests and benchmarks.
  [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }
  [[nodiscard]] tf::TimePoint time() const noexcept { return time_; }
  [[nodiscard]] bool isPending() const;
  /// Another number whenever update() has found settings, visibility, order or number of layers changed.
  [[nodiscard]] std::uint64_t settingsRevision() const noexcept { return settings_revision_; }
  /// What the next picture is drawn from, for the layers that arrange something in it; after update().
  void setView(const CameraView& view, const PictureSize& size);
  /// Box of all visible layers in the fixed frame; the axes count, the reference grid does not.
  [[nodiscard]] osg::BoundingBoxd boundsInFixed() const;
  /// The same without strays far off, of points or of whole layers and frames: what a first view should hold.
  [[nodiscard]] Box bulkInFixed() const;

 private:
  /// All that the picture depends on.
  struct Inputs {
    tf::TimePoint time;
    std::string fixed_frame;
    std::uint64_t transforms_revision = 0;
    std::uint64_t store_revision = 0;
    std::uint64_t layers_revision = 0;
    std::uint64_t layer_settings = 0;  // sum of their revisions
    friend bool operator==(const Inputs&, const Inputs&) = default;
  };
  [[nodiscard]] const LayerType* findType(std::string_view topic) const;
  [[nodiscard]] Status refusal(std::string_view topic) const;
  [[nodiscard]] std::string freeId(const std::string& topic) const;
  [[nodiscard]] std::string firstSourceFrame() const;
  [[nodiscard]] std::uint64_t layerSettings() const;
  void updateLayers(tf::TimePoint time);
  void arrangeNodes();
  bool noteSettings();

  std::shared_ptr<Dataset> dataset_;
  std::span<const LayerType> types_;
  FrameGraph frames_;
  std::shared_ptr<std::atomic<bool>> has_new_work_;  // set from any thread when background work has finished
  LayerContext context_;
  std::vector<std::unique_ptr<LayerSlot>> layers_;
  std::set<std::string> removed_topics_;
  std::uint64_t layers_revision_ = 0;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> arranged_;  // hangRevision() and layers_revision_ of then
  std::uint64_t buffer_texels_ = kUsualBufferTexels;
  std::optional<std::string> chosen_frame_;
  std::optional<std::string> preferred_frame_;
  mutable std::string automatic_frame_;
  mutable std::optional<std::uint64_t> automatic_frame_revision_;
  tf::TimePoint time_;
  std::optional<Inputs> shown_;
  /// Of a layer, as the last update found them.
  struct ShownSettings {
    const Layer* layer = nullptr;
    std::uint64_t revision = 0;
    bool is_visible = false;
    SettingTexts texts;
  };
  std::vector<ShownSettings> shown_settings_;
  std::uint64_t ticks_ = 0;
  std::uint64_t settings_revision_ = 0;
};

/// The frame a new view takes when nobody chose one: the first of map, world, earth, odom, base_link, base_footprint
/// that exists, else the root of the largest tree (ties: first seen); "" without frames.
[[nodiscard]] std::string automaticFixedFrame(const tf::TransformBuffer& buffer);

}  // namespace stillframe::scenegraph
