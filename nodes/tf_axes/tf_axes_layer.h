#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/ref_ptr>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/line_state.h"
#include "nodes/tf_axes/frame_labels.h"
#include "scenegraph/layer.h"

namespace stillframe::nodes {

/// A triad at every frame and a line from each frame to its parent (REQUIREMENTS C1).
///
/// All triads are one geometry and all lines another; a tick writes matrices only, of what moved. Each line lies in its
/// child's frame and is scaled in double, so that frames on the far side of the earth cost no precision. A frame whose
/// own sample is older than `stale_after` is dimmed, and its name tells the age. A tick costs the search for the sample
/// in force of each shown frame, and a line where that is another than before; nothing when time, fixed frame,
/// transforms and settings are as before. GUI thread.
class TfAxesLayer final : public scenegraph::Layer {
 public:
  struct Settings {
    double axis_length_m = 0.3;
    bool show_axes = true;
    bool show_parent_lines = true;
    bool show_labels = false;
    double label_height_px = 16.0;
    std::string frame_filter;
    std::string hidden_frames;
    double stale_after_s = 5.0;        ///< age of a dynamic frame's sample beyond which it is dimmed; 0: never
    std::int64_t max_frames = 10'000;  ///< a node each, and two draw calls: more would stall the window
    scenegraph::Color line_color{.r = 1.0F, .g = 0.0F, .b = 1.0F, .a = 1.0F};
    scenegraph::Color label_color{.r = 242 / 255.0F, .g = 242 / 255.0F, .b = 242 / 255.0F, .a = 1.0F};

    friend bool operator==(const Settings&, const Settings&) = default;
  };

  [[nodiscard]] static std::unique_ptr<scenegraph::Layer> create(std::string_view topic);

  TfAxesLayer();
  ~TfAxesLayer() override;
  void attach(const scenegraph::LayerContext& context) override;
  void update(const scenegraph::Tick& tick) override;
  void detach() override;
  [[nodiscard]] bool isVisible() const override { return visible_; }
  [[nodiscard]] const scenegraph::Status& status() const override { return status_; }
  /// Arranges the names, so that none covers another: of frames at one place they become one, line by line; of others
  /// the nearer one is shown.
  void setView(const scenegraph::CameraView& view, const scenegraph::PictureSize& size) override;
  /// "frames" shown, "stale" ones among them, "unresolved" ones among them that cannot be expressed at the tick,
  /// "left_out" when there are frames beyond max_frames.
  [[nodiscard]] scenegraph::LayerCounts counts() const override;
  [[nodiscard]] std::string sourceFrame() const override { return ""; }
  [[nodiscard]] bool isPending() const override { return false; }
  [[nodiscard]] osg::BoundingBoxd boundsInFixed() const override { return bounds_; }
  /// Each frame by itself: the origin of a map projection may lie far from everything.
  [[nodiscard]] std::vector<scenegraph::Box> bulkInFixed() const override;
  /// A frame, by its axes, its name or the line to its parent.
  [[nodiscard]] std::optional<scenegraph::Picked> describe(const scenegraph::PickHit& hit) const override;
  void collectNodes(std::vector<osg::Node*>& nodes) const override;
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override;
  [[nodiscard]] scenegraph::SettingTexts settings() const override;
  /// Refuses a frame_filter that is no regular expression.

 private:
  void changeVisible(bool visible) override;
  std::expected<void, scenegraph::SettingError> changeSettings(const scenegraph::SettingTexts& texts) override;
  /// What hangs beneath one frame's node.
  struct Shown {
    tf::FrameId id = tf::kNoFrame;
    std::string name;
    tf::FrameId parent = tf::kNoFrame;
    osg::ref_ptr<osg::Group> group;
    osg::ref_ptr<osg::MatrixTransform> line;  // null for a root
    osg::ref_ptr<osg::Node> label;            // null without names
    std::optional<tf::TimePoint> stamp;       // of the sample that the line was laid by
    bool is_posed = false;                    // since the transforms changed
    bool is_static = true;
    bool is_stale = false;
    std::string text;  // the name, with the age of a stale frame
  };
  /// What the last update saw; equal means nothing to do.
  struct Inputs {
    tf::TimePoint time;
    std::string fixed_frame;
    std::uint64_t revision = 0;
    Settings settings;

    friend bool operator==(const Inputs&, const Inputs&) = default;
  };

  void rebuild();
  [[nodiscard]] std::string leftOutText() const;
  void hang(Shown& shown);
  void clear();
  void poseLine(Shown& shown, tf::TimePoint time);
  void judgeAge(Shown& shown, std::optional<tf::TimePoint> stamp, tf::TimePoint time);
  void writeLabel(const Shown& shown, const std::string& text) const;
  void judge();

  Settings settings_;
  std::optional<Inputs> applied_;
  bool visible_ = true;
  scenegraph::Status status_;
  std::optional<scenegraph::LayerContext> context_;
  std::vector<Shown> shown_;
  std::uint64_t resolved_ = 0;
  std::uint64_t left_out_ = 0;  // frames beyond max_frames
  osg::BoundingBoxd bounds_;
  osg::ref_ptr<osg::Geometry> triad_;
  osg::ref_ptr<osg::Geometry> dim_triad_;
  osg::ref_ptr<osg::Geometry> unit_line_;
  LineState line_state_;
  FrameLabels labels_;
};

}  // namespace stillframe::nodes
