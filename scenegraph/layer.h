#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <osg/BoundingBox>
#include <osg/Node>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenegraph/camera/box.h"
#include "scenegraph/camera/picking.h"
#include "scenegraph/color_legend.h"
#include "scenegraph/executor.h"
#include "scenegraph/frame_graph.h"
#include "scenegraph/osg_box.h"
#include "scenegraph/pick/pick_hit.h"
#include "scenegraph/pick/picked.h"
#include "scenegraph/settings.h"
#include "scenegraph/status.h"
#include "scenegraph/store/dataset.h"

namespace stillframe::scenegraph {

/// What a layer works with, for its whole attached life. All references outlive the layer.
struct LayerContext {
  Dataset& dataset;
  FrameGraph& frames;
  Executor& executor;
  /// Asks the view for another update; safe from any thread, called when background work has finished.
  std::function<void()> request_update;
};

/// What drivers of today take or more, for scenes that no context draws.
inline constexpr std::uint64_t kUsualBufferTexels = std::uint64_t{1} << 27U;

/// One moment of a view.
struct Tick {
  tf::TimePoint time;
  /// Place of the layer among those of its type in the view, and their number: flat things in one plane are drawn in
  /// this order, whatever the distance.
  std::uint32_t order = 0;
  std::uint32_t of_type = 1;
  /// Texels that the driver takes in one texture buffer.
  std::uint64_t buffer_texels = kUsualBufferTexels;
};

/// Numbers a layer reports, by name ("points", "dropped"), in a fixed order.
using LayerCounts = std::vector<std::pair<std::string, std::uint64_t>>;

/// Draws one topic (or one built-in thing: axes, grid) beneath its source frame.
///
/// Life: construct, attach(), any number of update(), detach(); all on the GUI thread. update() never blocks. After the
/// executor has drained and update() was called once more, everything that can be observed here is a pure function of
/// (dataset, tick, fixed frame, settings): the layer contract test walks random paths to hold every type to that.
/// Layers own stock osg nodes and hang them beneath FrameGraph::acquire(source frame); they subclass none.
class Layer {
 public:
  virtual ~Layer() = default;

  virtual void attach(const LayerContext& context) = 0;
  /// Brings nodes, status and counts to `tick`; cheap when nothing it depends on has changed.
  virtual void update(const Tick& tick) = 0;
  /// The picture that is about to be drawn, after update(): for what is arranged in it, such as names that must not
  /// cover each other. Most layers have nothing to do.
  virtual void setView(const CameraView& /*view*/, const PictureSize& /*size*/) {}
  /// Leaves the graph as if never attached. May be attached again.
  virtual void detach() = 0;

  /// Hidden layers hold no visible node, submit no work, and keep their settings.
  void setVisible(bool visible) {
    changeVisible(visible);
    ++settings_revision_;
  }
  [[nodiscard]] virtual bool isVisible() const = 0;

  [[nodiscard]] virtual const Status& status() const = 0;
  [[nodiscard]] virtual LayerCounts counts() const = 0;
  /// Frame of the data shown, "" when there is none.
  [[nodiscard]] virtual std::string sourceFrame() const = 0;
  /// Whether background work is under way that will change the picture.
  [[nodiscard]] virtual bool isPending() const = 0;
  /// Box of what is drawn, in the fixed frame, double; invalid when nothing is, or when it is mere reference (a grid).
  [[nodiscard]] virtual osg::BoundingBoxd boundsInFixed() const = 0;
  /// The same without stray points far off, in the pieces that may be strays themselves beside those of other layers:
  /// what a first view should hold is chosen among them. May take milliseconds.
  [[nodiscard]] virtual std::vector<Box> bulkInFixed() const { return {toBox(boundsInFixed())}; }
  /// What the id pass has hit, with all its fields; nullopt when that is none of what this layer draws.
  [[nodiscard]] virtual std::optional<Picked> describe(const PickHit& /*hit*/) const { return std::nullopt; }

  /// What the colours mean, where values have colours; nullopt when nothing is shown or it has colours of its own.
  [[nodiscard]] virtual std::optional<ColorLegend> legend() const { return std::nullopt; }
  /// Work that counts the values behind legend(), milliseconds per million: for any thread, and free of this layer.
  /// Empty when there is nothing to count.
  [[nodiscard]] virtual std::function<ValueHistogram()> histogramWork() const { return nullptr; }
  /// The nodes it has put into the graph now, each on top of all that is the layer's beneath it: to see what they cost.
  virtual void collectNodes(std::vector<osg::Node*>& /*nodes*/) const {}

  /// Settings and what they may be now (a colour field's choices come from the data).
  [[nodiscard]] virtual std::vector<SettingSpec> settingSpecs() const = 0;
  [[nodiscard]] virtual SettingTexts settings() const = 0;
  /// Changes what `texts` names at the next update(); on error nothing is changed.
  std::expected<void, SettingError> applySettings(const SettingTexts& texts) {
    auto applied = changeSettings(texts);
    settings_revision_ += applied ? 1 : 0;
    return applied;
  }
  /// Equal numbers mean equal settings() and isVisible(): who asks every tick asks for no texts. Only ever grows.
  [[nodiscard]] std::uint64_t settingsRevision() const noexcept { return settings_revision_; }

 protected:
  virtual void changeVisible(bool visible) = 0;
  virtual std::expected<void, SettingError> changeSettings(const SettingTexts& texts) = 0;
  /// Of a layer that has settings for what is in its data (namespaces, links), when there are others than before.
  void noteOtherSettings() noexcept { ++settings_revision_; }

 private:
  std::uint64_t settings_revision_ = 0;
};

/// One row of the registry (nodes/registry.cpp): everything a view needs to offer a kind of layer.
struct LayerType {
  std::string_view name;   ///< "point_cloud"; built-ins are named on the command line by it ("tf", "grid")
  std::string_view label;  ///< for people
  ObjectType consumes;     ///< None for a built-in without a topic
  std::unique_ptr<Layer> (*create)(std::string_view topic);
  /// Whether it is for this topic of another type too, say to tell why that is not drawn; nullptr: for none.
  bool (*takes)(const ObjectStore& store, const TopicInfo& topic) = nullptr;
};

}  // namespace stillframe::scenegraph
