#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/ref_ptr>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/mesh_drawing/mesh_arrays.h"
#include "nodes/robot_model/joint_feed.h"
#include "nodes/robot_model/robot_model_settings.h"
#include "nodes/robot_model/robot_scene.h"
#include "nodes/robots/link_places.h"
#include "scenegraph/layer.h"
#include "scenegraph/sample_loader.h"

namespace stillframe::nodes {

/// A robot from its description (REQUIREMENTS C9).
///
/// Every link is a MatrixTransform with its shapes beneath. It hangs beneath the frame of the link's name; where there
/// is no such frame, beneath that of the nearest link that has one, with the matrix that forward kinematics gives.
/// Description and meshes are read on a worker; a mesh that cannot be shown leaves a box and a status with link and
/// path. Costs a lookup a link each tick, and matrices of the joints where kinematics places links. GUI thread.
class RobotModelLayer final : public scenegraph::Layer {
 public:
  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);

  explicit RobotModelLayer(std::string_view topic) : topic_(topic) {}
  ~RobotModelLayer() override;
  void attach(const scenegraph::LayerContext& context) override;
  void update(const scenegraph::Tick& tick) override;
  void detach() override;
  [[nodiscard]] bool isVisible() const override { return visible_; }
  [[nodiscard]] const scenegraph::Status& status() const override { return status_; }
  /// "links", "placed" of them, "by_kinematics" of these, "meshes" of files, "missing_meshes", "triangles" drawn.
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  /// That of the root link.
  [[nodiscard]] std::string sourceFrame() const override;
  [[nodiscard]] bool isPending() const override;
  [[nodiscard]] osg::BoundingBoxd boundsInFixed() const override { return bounds_; }
  /// A link, where its surface is hit.
  [[nodiscard]] std::optional<scenegraph::Picked> describe(const scenegraph::PickHit& hit) const override;
  void collectNodes(std::vector<osg::Node*>& nodes) const override;
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] scenegraph::SettingTexts settings() const override;

 private:
  void changeVisible(bool visible) override;
  std::expected<void, scenegraph::SettingError> changeSettings(const scenegraph::SettingTexts& texts) override;
  /// A link in the graph.
  struct LinkNode {
    osg::ref_ptr<osg::MatrixTransform> node;
    MeshState state;
    std::string frame;                  ///< of the link itself
    std::optional<std::string> anchor;  ///< frame whose node it hangs beneath
    std::size_t triangles = 0;
    bool is_visible = true;
  };
  using Loader = scenegraph::SampleLoader<RobotScene>;

  void openLoader();
  void clear();
  void show(std::shared_ptr<const RobotScene> scene);
  void paint();
  void place(const scenegraph::Tick& tick);
  [[nodiscard]] JointPoses jointPoses(const scenegraph::Tick& tick);
  [[nodiscard]] std::vector<LinkByTf> lookUp();
  void hang(LinkNode& link, const std::optional<std::string>& anchor);
  [[nodiscard]] std::string frameOf(const std::string& link) const;
  [[nodiscard]] scenegraph::Status judge() const;
  [[nodiscard]] std::string faultText() const;
  [[nodiscard]] std::string kinematicsText() const;
  [[nodiscard]] std::string unplacedText(std::size_t link) const;

  std::string topic_;
  RobotModelSettings settings_;
  bool visible_ = true;
  scenegraph::Status status_;
  osg::BoundingBoxd bounds_;
  std::optional<scenegraph::LayerContext> context_;
  std::string loader_tag_;
  std::optional<Loader> loader_;
  std::optional<JointFeed> feed_;
  std::shared_ptr<const RobotScene> scene_;       // shown
  std::optional<RobotModelSettings> painted_;     // settings that the nodes have
  std::vector<LinkNode> nodes_;                   // one a link of scene_
  std::vector<std::optional<LinkPlace>> places_;  // likewise
  /// Of the present tick.
  struct Tally {
    std::size_t placed = 0;
    std::size_t by_kinematics = 0;
    std::size_t clamped = 0;
    bool is_at_zero = false;
    std::optional<std::size_t> first_unplaced;
    std::optional<tf::LookupFailure> failure;  ///< of the first unplaced link, by its own frame
  } tally_;
};

}  // namespace stillframe::nodes
