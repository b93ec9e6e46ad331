#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <osg/Geometry>
#include <osg/Uniform>
#include <osg/ref_ptr>
#include <string>
#include <string_view>

#include "scenegraph/layer.h"

namespace stillframe::nodes {

/// The reference grid (REQUIREMENTS C12): lines on a plane through the origin of the fixed frame.
///
/// Hangs beneath the node of the fixed frame, or beneath the root while there is no frame at all. Costs nothing per
/// tick; a change of size, count or plane rewrites some dozens of vertices, the colour is a uniform. Of what lies in
/// its plane, lines are drawn over it and all else beneath it (flat_order.h). GUI thread.
class GridLayer final : public scenegraph::Layer {
 public:
  struct Settings {
    double cell_size_m = 1.0;
    std::int64_t cells = 10;
    std::string plane = "xy";
    scenegraph::Color color{.r = 92 / 255.0F, .g = 97 / 255.0F, .b = 105 / 255.0F, .a = 1.0F};

    friend bool operator==(const Settings&, const Settings&) = default;
  };

  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);

  GridLayer();
  void attach(const scenegraph::LayerContext& context) override;
  void update(const scenegraph::Tick& tick) override;
  void detach() override;
  [[nodiscard]] bool isVisible() const override { return visible_; }
  [[nodiscard]] const scenegraph::Status& status() const override { return status_; }
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  [[nodiscard]] std::string sourceFrame() const override { return held_frame_.value_or(""); }
  [[nodiscard]] bool isPending() const override { return false; }
  [[nodiscard]] osg::BoundingBoxd boundsInFixed() const override { return {}; }
  void collectNodes(std::vector<osg::Node*>& nodes) const override;
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] scenegraph::SettingTexts settings() const override;

 private:
  void changeVisible(bool visible) override;
  std::expected<void, scenegraph::SettingError> changeSettings(const scenegraph::SettingTexts& texts) override;
  void hang();
  void unhang();
  [[nodiscard]] std::optional<std::string_view> heldNode() const;  // nullopt: the root
  void applyChanges();

  Settings settings_;
  std::optional<Settings> applied_;
  bool visible_ = true;
  scenegraph::Status status_;
  std::optional<scenegraph::LayerContext> context_;
  std::optional<std::string> held_frame_;  // of the node acquired; "" while hanging beneath the root
  osg::ref_ptr<osg::Geometry> geometry_;
  osg::ref_ptr<osg::Uniform> color_;
  osg::ref_ptr<osg::Uniform> normal_;  // of the plane
};

}  // namespace stillframe::nodes
