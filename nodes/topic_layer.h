#pragma once

#include <expected>
#include <optional>
#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/ref_ptr>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/layer.h"

namespace stillframe::nodes {

/// The life of a layer that draws what one topic says, beneath the node of one frame: attached, brought to a tick,
/// placed, judged, hidden, detached. What derives from it says what it loads, draws and counts (SampleLayer: for topics
/// whose messages stand alone).
///
/// While attached and visible, update() calls load(), hangs node() beneath the frame that load() names, calls draw()
/// and judges: of the sources' status, the placement and the remark the first that matters is the layer's. GUI thread.
class TopicLayer : public scenegraph::Layer {
 public:
  void attach(const scenegraph::LayerContext& context) final;
  void update(const scenegraph::Tick& tick) final;
  void detach() final;
  [[nodiscard]] bool isVisible() const final { return visible_; }
  [[nodiscard]] const scenegraph::Status& status() const final { return status_; }
  [[nodiscard]] std::string sourceFrame() const final { return held_frame_.value_or(""); }
  [[nodiscard]] bool isPending() const final { return visible_ && context_ && isWorking(); }
  [[nodiscard]] osg::BoundingBoxd boundsInFixed() const final { return bounds_; }
  [[nodiscard]] std::vector<scenegraph::Box> bulkInFixed() const final;
  [[nodiscard]] std::optional<scenegraph::Picked> describe(const scenegraph::PickHit& hit) const final;
  void collectNodes(std::vector<osg::Node*>& nodes) const final;

 protected:
  void changeVisible(bool visible) final;
  /// fixed_from_data at the tick.
  using Placement = std::expected<tf::RigidTransform, tf::LookupFailure>;
  /// Where the data lies.
  struct Anchor {
    std::string frame;  ///< leading slashes do not count
    tf::RigidTransform frame_from_data;
  };

  explicit TopicLayer(std::string_view topic) : topic_(topic) {}

  /// Makes what lives while attached; node() is there, and empty.
  virtual void open(const scenegraph::LayerContext& context) = 0;
  /// Lets go of it, after clear().
  virtual void close() = 0;
  /// Draws nothing, wants nothing: hidden, or about to be detached.
  virtual void clear() = 0;
  /// Brings what is shown to the tick; nullopt when that is nothing.
  [[nodiscard]] virtual std::optional<Anchor> load(const scenegraph::Tick& tick) = 0;
  /// Brings the picture to settings and placement; after a load() that showed something.
  virtual void draw(const Placement& fixed_from_data) = 0;
  /// Of what is drawn, in the data's own frame; invalid for nothing.
  [[nodiscard]] virtual osg::BoundingBoxd box() const = 0;
  /// The same without stray points far off; only called when box() is valid.
  [[nodiscard]] virtual osg::BoundingBoxd bulk() const { return box(); }
  /// What has been hit beneath node(); nullopt when that is not of the data shown.
  [[nodiscard]] virtual std::optional<scenegraph::Picked> describeData(const scenegraph::PickHit& /*hit*/) const {
    return std::nullopt;
  }
  /// Ok, or why load() did not bring what is wanted.
  [[nodiscard]] virtual const scenegraph::Status& sourceStatus() const = 0;
  /// What there is to say of data that is loaded and placed.
  [[nodiscard]] virtual scenegraph::Status remark() const { return {}; }
  /// Whether work is under way; while attached.
  [[nodiscard]] virtual bool isWorking() const = 0;

  [[nodiscard]] const std::string& topic() const noexcept { return topic_; }
  /// While attached.
  [[nodiscard]] const scenegraph::LayerContext& context() const { return context_.value(); }
  [[nodiscard]] osg::MatrixTransform& node() const { return *node_; }
  /// Puts `state` on node() and an empty geometry beneath it.
  [[nodiscard]] osg::ref_ptr<osg::Geometry> addGeometry(osg::StateSet* state) const;
  /// "'TOPIC' at TIME: ", which a message about one sample begins with.
  [[nodiscard]] std::string sampleText(const scenegraph::Entry& entry) const;

 private:
  void leave();
  void hold(const std::optional<std::string>& frame);
  [[nodiscard]] scenegraph::Status judge(bool has_data, const Placement& placement) const;

  std::string topic_;
  bool visible_ = true;
  scenegraph::Status status_;
  osg::BoundingBoxd bounds_;
  tf::RigidTransform fixed_from_data_;  // while bounds_ are valid
  std::optional<scenegraph::LayerContext> context_;
  std::optional<std::string> held_frame_;
  osg::ref_ptr<osg::MatrixTransform> node_;
};

}  // namespace stillframe::nodes
