#pragma once

#include <memory>
#include <optional>
#include <osg/Geometry>
#include <osg/ref_ptr>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/layer.h"
#include "scenegraph/sample_loader.h"

namespace stillframe::test {

/// A layer as small as the contract allows: the points of a cloud of three floats, white.
class FakeLayer final : public scenegraph::Layer {
 public:
  struct Settings {
    double size_px = 1.0;
    bool is_flat = false;  ///< draws z = 0
  };
  /// What it makes of a message.
  struct Points {
    std::string frame_id;
    std::vector<osg::Vec3f> positions;
    [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + positions.size() * sizeof(osg::Vec3f); }
  };

  explicit FakeLayer(std::string_view topic);
  void attach(const scenegraph::LayerContext& context) override;
  void update(const scenegraph::Tick& tick) override;
  void detach() override;
  [[nodiscard]] bool isVisible() const override { return is_visible_; }
  [[nodiscard]] const scenegraph::Status& status() const override { return status_; }
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  [[nodiscard]] std::string sourceFrame() const override { return held_frame_.value_or(""); }
  [[nodiscard]] bool isPending() const override { return loader_ && loader_->isPending(); }
  [[nodiscard]] osg::BoundingBoxd boundsInFixed() const override;
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] scenegraph::SettingTexts settings() const override;

 private:
  void changeVisible(bool visible) override;
  std::expected<void, scenegraph::SettingError> changeSettings(const scenegraph::SettingTexts& texts) override;
  void showPoints();
  void hangIn(const std::optional<std::string>& frame);

  std::string topic_;
  Settings settings_;
  bool has_new_settings_ = true;
  bool is_visible_ = true;
  scenegraph::Status status_;
  std::optional<scenegraph::LayerContext> context_;
  std::optional<scenegraph::SampleLoader<Points>> loader_;
  std::optional<std::string> held_frame_;
  osg::ref_ptr<osg::Geometry> geometry_;
};

/// The types of the test program: clouds by FakeLayer.
[[nodiscard]] std::span<const scenegraph::LayerType> fakeTypes();

}  // namespace stillframe::test
