#pragma once

#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <osgViewer/GraphicsWindow>
#include <osgViewer/Viewer>

#include "scenegraph/pipeline/first_uses.h"
#include "scenegraph/pipeline/gl_fence.h"
#include "scenegraph/pipeline/gl_output.h"
#include "scenegraph/pipeline/gl_target.h"
#include "scenegraph/pipeline/id_pass.h"
#include "scenegraph/pipeline/point_collection.h"
#include "scenegraph/pipeline/stages.h"
#include "scenegraph/pipeline/view_pipeline.h"
#include "scenegraph/thread_priority.h"

namespace stillframe::scenegraph {

/// A stage that OpenGL has been asked for.
struct StageUnderWay {
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();
  Precedence precedence{Precedence::Of::Window};
  std::optional<gl::Fence> fence;  // none: there is nothing to wait for
};

/// A picture that is being drawn in steps.
struct SteppedPicture {
  int sub_frame = 0;
  std::size_t stage = 0;       // of it, that is drawn next
  bool awaits_points = false;  // they are being drawn by another thread
  bool has_points = false;     // those that are not drawn with the scene
  bool is_begun = false;       // the scene's targets are cleared
  double rest_ms = 0.0;        // that all but the points of this sub-frame has taken
  std::unique_ptr<StageUnderWay> under_way;
};

/// What a PointStage is to draw.
struct PointWork {
  PointCollection points;
  PointLimits limits;
};

/// What a ViewPipeline is made of; for its sources alone.
struct ViewPipeline::Impl {
  osg::ref_ptr<osg::Group> root;
  CameraView view;
  Color background;
  PostChain chain;
  glm::dmat4 projection_matrix{1.0};
  std::vector<std::string> passes;

  osg::ref_ptr<osgViewer::Viewer> viewer;
  osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> window;
  // Remade when the size, the structure of the chain or the kind of output change.
  std::optional<Stages> stages;
  int width_px = 0;
  int height_px = 0;
  bool presents = false;
  BlendLimits blend;
  PointWay point_way = PointWay::Auto;
  PointLimits point_limits;
  std::function<void()> wake;
  std::unique_ptr<gl::Output> aside;  // what is presented, until it is whole, where step() waits for nobody
  std::optional<double> rest_ms;  // of a (sub-)frame beside its points, once measured where there is a budget for both
  bool is_software = false;
  osg::ref_ptr<osg::Group> content;         // the root, and the picture of the points
  std::unique_ptr<PointStage> point_stage;  // none before there are points for it
  PointWay stage_way = PointWay::OpenGl;    // whose it is
  std::optional<PointProgress> point_progress;
  std::unique_ptr<IdPass> id_pass;  // none before something is picked
  bool is_chain_new = false;        // setPostChain() needs no context, the next draw() has one
  std::optional<SteppedPicture> stepped;
  std::shared_ptr<FirstUses> first_uses = std::make_shared<FirstUses>();
  int used_samples = 1;          // that they were made for
  std::size_t drawn_stages = 0;  // of these stages, at least once

  [[nodiscard]] unsigned contextId() const { return window->getState()->getContextID(); }
  void makeViewer();
  void setSceneData(osg::Node* scene);
  std::expected<void, Status> makeStages();
  void dropStages();
  void adoptGlState();
  void takeOver();
  [[nodiscard]] PointWay wayOf(const PointCollection& points) const;
  [[nodiscard]] std::optional<PointWork> findPoints(double sub_frame_budget_ms);
  void notePoints(std::optional<PointProgress> progress);
  void drawPoints(std::optional<PointWork> work);
  PictureStep stepPoints(double budget_ms);
  [[nodiscard]] bool drawsAside() const { return is_software && wake; }
  [[nodiscard]] bool isDrawn() const { return stepped->stage + (drawsAside() ? 0 : 1) >= stages->count(); }
  [[nodiscard]] bool canPresent() const { return stages && stepped && stepped->under_way == nullptr && isDrawn(); }
  void beginStage(double budget_ms);
  [[nodiscard]] bool isStageDrawn(double wait_ms) const;
  [[nodiscard]] bool endStage();
  void startAside(std::uint32_t output_fbo);
  void dropPoints();
  void drawFrame();
  void noteRest(double took_ms);
  [[nodiscard]] bool isPaced() const { return is_software && std::isfinite(point_limits.budget_ms); }
  [[nodiscard]] GLuint targetId(const std::string& target) const;
  [[nodiscard]] auto read(decltype(gl::readColor)* reader, const std::string& target, int first, int rows) const {
    const bool has_rows = stages && first >= 0 && rows > 0 && rows <= height_px - first;
    return has_rows ? reader(targetId(target), {width_px, first, rows}) : std::vector<float>{};
  }
  [[nodiscard]] osg::RenderInfo startPick();
  [[nodiscard]] IdPass::View idView(int x_px, int y_px, int reach_px) const;
  std::expected<void, Status> checkTargets() const;
  std::expected<bool, Status> makeReady(int width, int height, bool present);
  void startPicture(std::uint32_t output_fbo);
  void namePasses();
  std::expected<void, Status> draw(std::uint32_t output_fbo, int width, int height, bool present);
};

}  // namespace stillframe::scenegraph
