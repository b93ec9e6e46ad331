#pragma once

#include <QElapsedTimer>
#include <QString>
#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/camera/view_camera.h"
#include "scenegraph/passes/view_effects.h"
#include "scenegraph/pick/scene_pick.h"
#include "scenegraph/pipeline/draw_times.h"
#include "scenegraph/pipeline/gl_debug.h"
#include "scenegraph/pipeline/kept_picture.h"
#include "scenegraph/pipeline/picture.h"
#include "scenegraph/scene.h"
#include "viewer/widget/camera_gestures.h"
#include "viewer/widget/camera_keys.h"
#include "viewer/widget/frame_steps.h"
#include "viewer/widget/frame_turn.h"
#include "viewer/widget/gl_view.h"
#include "viewer/widget/selection.h"
#include "viewer/widget/update_gate.h"

class QLabel;
namespace stillframe::viewer {
class HelpOverlay;
class PictureJob;
class ViewPicker;
class ViewPicks;
struct PictureRequest;

/// The 3D view: one Scene, one camera, one pipeline in the widget's own context. GUI thread.
///
/// Draws on demand only: a tick, a camera, a setting or a finished background job asks for it, several requests make
/// one update from the event loop, and an update that changes nothing draws nothing. Survives losing its context
/// (moving to another window) and frees what it holds in it. What cannot be drawn is said over the view.
class SceneWidget : public GlView {
  Q_OBJECT

 public:
  explicit SceneWidget(QWidget* parent = nullptr);
  ~SceneWidget() override;
  /// Shows `dataset` from now on, with no layers yet. `executor` must outlive the widget. nullptr shows nothing.
  void setDataset(std::shared_ptr<scenegraph::Dataset> dataset, scenegraph::Executor& executor);
  /// nullptr before the first dataset. Call requestTick() after changing its layers.
  [[nodiscard]] scenegraph::Scene* scene() noexcept { return scene_.get(); }
  void setTime(tf::TimePoint time);
  [[nodiscard]] tf::TimePoint time() const noexcept { return time_; }
  /// At the next tick; the camera is carried over, so that it goes on looking at the same place.
  void setFixedFrame(const std::optional<std::string>& frame);
  /// The scene may have changed: poses frames and updates layers soon. Any thread.
  void requestTick() { gate_.request(); }
  bool applyTick();  ///< does now what is requested, and returns whether a repaint follows
  [[nodiscard]] const scenegraph::ViewCamera& camera() const noexcept { return camera_; }
  /// What the next frame is drawn from: at the tick that was applied last, at this moment of a smooth move.
  [[nodiscard]] scenegraph::CameraView shownView() const { return camera_.view(now()); }
  void setViewpoint(const scenegraph::ViewpointState& state);
  /// The same with a saved one. Until the camera is moved or endRestoring(), it counts in whatever fixed frame
  /// automatic choice comes to while data arrives, and neither is carried over nor framed anew. `is_touched`: as saved.
  void restoreViewpoint(const scenegraph::ViewpointState& state, bool is_touched);
  bool endRestoring();  ///< all frames are known; returns whether a viewpoint was being restored
  /// Whether a gesture or setViewpoint() has moved the camera since home().
  [[nodiscard]] bool isCameraTouched() const noexcept { return is_camera_touched_; }
  /// Whether the camera has not yet been where it belongs: there is nothing to see so far.
  [[nodiscard]] bool wantsFraming() const noexcept { return wants_framing_; }
  void setCameraKind(scenegraph::CameraKind kind);
  void setFollow(scenegraph::FollowMode mode);
  /// The frame that the camera lives in and may follow; nullopt: the fixed frame.
  void setDisplayFrame(const std::optional<std::string>& frame);
  /// Whether Home, F, saved views and clicks in the frame tree glide there. On at first.
  void setSmoothMoves(bool enabled) { has_smooth_moves_ = enabled; }
  [[nodiscard]] bool hasSmoothMoves() const noexcept { return has_smooth_moves_; }
  void setSelection(const std::optional<Selection>& selection) { selection_ = selection; }
  [[nodiscard]] const std::optional<Selection>& selection() const noexcept { return selection_; }
  /// What the last frame shows at a place of the widget, and near it. Draws no frame.
  std::expected<scenegraph::PickResult, scenegraph::PickError> pick(QPointF position);
  /// What clicks have picked and measured; what is picked is the selection.
  [[nodiscard]] ViewPicks& picks() noexcept;
  bool warmPick();  ///< ViewPipeline::warmPick(), where OpenGL is software
  void goOn();      ///< with ticks and frames that clicks have held: none waits any more
  [[nodiscard]] const std::vector<scenegraph::SavedView>& savedViews() const noexcept { return saved_views_; }
  void setSavedViews(std::vector<scenegraph::SavedView> views);
  /// Saves what is shown; a view of that name is replaced, without a name it becomes "View 1", "View 2", ...
  void saveView(const QString& name = {});
  bool showSavedView(const QString& name);
  void setBackground(const scenegraph::Color& background);
  void setEffects(const scenegraph::ViewEffects& effects);
  [[nodiscard]] const scenegraph::ViewEffects& effects() const noexcept { return effects_; }
  void setPointWay(scenegraph::PointWay way, std::optional<double> budget_ms = {});  ///< none: what suits the OpenGL
  /// A picture of what is shown, whole; blocks. "NotDrawn" before the first frame, and what checkPicture() refuses.
  [[nodiscard]] std::expected<scenegraph::Picture, scenegraph::Status> takePicture(const PictureRequest& request);
  /// The same in steps, the view standing still meanwhile: drawing is one, reading back takes some of milliseconds.
  [[nodiscard]] std::expected<void, scenegraph::Status> beginPicture(const PictureRequest& request);
  /// The share that is done, 1 at last. "NotDrawn" when the view has lost its context, or has another recording.
  [[nodiscard]] std::expected<double, scenegraph::Status> continuePicture();
  /// What there is of it; the view goes on.
  scenegraph::Picture endPicture();
  /// Share of the points that the last frame has drawn; below 1 the view goes on by itself until all are.
  [[nodiscard]] double pointShare() const;
  /// Measures what each layer takes to draw by itself, a frame an event: drawTimesMeasured() follows, unless the scene
  /// changes meanwhile. The view stands still as long. Does nothing before the first frame.
  void measureDrawTimes();
  [[nodiscard]] std::uint64_t framesDrawn() const noexcept { return frames_drawn_; }
  [[nodiscard]] bool isUpToDate() const noexcept { return steps_.isUpToDate(); }  ///< no frame is on its way
  void update();                           ///< a frame soon, drawn in steps from the event loop
  [[nodiscard]] QImage grabFramebuffer();  ///< what there is to see at this moment, drawn whole; blocks
  [[nodiscard]] std::size_t glMessages() const noexcept { return gl_messages_ + debug_log_.count(); }
  [[nodiscard]] QString problem() const;  ///< what is shown instead of the scene, "" when the scene is

 public Q_SLOTS:
  /// The default direction, all data in sight; again when a topic's first data comes, unless moved by hand before.
  void home();
  void resetView();
  void toggleHelp();
  void frameAll();
  /// The selection in sight, or all data when nothing is selected or it has no place now.
  void frameSelection();
  /// The display frame to the middle of the picture, upright, from the same side and as far away. refused(): no place.
  void recenter();
  /// From that side of what is looked at, e.g. (0, 0, 1): from above.
  void lookFrom(const glm::dvec3& side);
  /// The origin of `frame` becomes the focal point. refused() when it has no place at this time.
  void frameOrigin(const std::string& frame);

 Q_SIGNALS:
  /// Layers have been updated: statuses, counts and choices may be new.
  void sceneUpdated();
  void cameraChanged();
  void savedViewsChanged();
  /// Milliseconds of each layer, in the scene's order; none of a layer that shows nothing.
  void drawTimesMeasured(const std::vector<std::optional<double>>& times);
  /// Name of the frame whose origin is near the cursor, "" when none is.
  void frameHovered(const QString& frame);
  void refused(const QString& message);

 protected:
  void initializeGL() override;
  bool paintGL() override;
  [[nodiscard]] bool mayPaint() const override { return !is_resizing_ && !isLent(); }
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override, keyReleaseEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  void releaseGl(), dropPipeline(), takeBack(), stepDrawTimes(), onCameraMoved(), walk(), frameIfWanted();
  [[nodiscard]] bool isLent() const noexcept { return picture_ != nullptr || draw_times_ != nullptr; }
  void beginFrame(), continueFrame(), endFrame(), askForFrame(), keepPicture(), startBlank();
  FrameTurn::Step stepFrame();
  bool fillBlank(), followTick(), obey(CameraCommand command), steer(CameraCommand command);
  [[nodiscard]] scenegraph::Follow::Pose displayPose() const;
  [[nodiscard]] double now() const { return static_cast<double>(clock_.nsecsElapsed()) * 1e-9; }
  void showProgress(), sayProgress(const QString& text), showProblem(const QString& text);
  [[nodiscard]] double aspect() const;
  UpdateGate gate_, wake_gate_;  // of ticks; of what a frame waits for
  scenegraph::GlDebugLog debug_log_;
  std::size_t gl_messages_ = 0, logged_messages_ = 0;  // of contexts that are gone; of debug_log_ that went to glLog
  std::unique_ptr<scenegraph::Scene> scene_;
  std::unique_ptr<scenegraph::ViewPipeline> pipeline_;
  std::unique_ptr<PictureJob> picture_;                // that is being taken
  std::unique_ptr<scenegraph::DrawTimes> draw_times_;  // that are being measured
  FrameSteps steps_;
  scenegraph::gl::KeptPicture kept_;  // from before a resize, until the first whole one after it
  scenegraph::ViewCamera camera_;
  std::string camera_frame_;  // the fixed frame that camera_ counts in
  std::vector<scenegraph::SavedView> saved_views_;
  std::optional<Selection> selection_;
  CameraGestures gestures_;
  CameraKeys keys_;
  QElapsedTimer clock_;
  scenegraph::Color background_{.r = 0.12F, .g = 0.13F, .b = 0.15F, .a = 1.0F};
  scenegraph::ViewEffects effects_;
  scenegraph::PointWay point_way_ = scenegraph::PointWay::Auto;
  std::optional<double> point_budget_ms_;
  double walked_s_ = 0.0;  // moment of the last step
  tf::TimePoint time_;
  bool wants_framing_ = true, has_framed_data_ = false, is_camera_touched_ = false;
  bool has_smooth_moves_ = true, glides_home_ = false;
  bool is_software_ = false, is_context_usable_ = false, is_resizing_ = false;  // software: the OpenGL that draws
  std::optional<scenegraph::ViewpointState> restored_;                          // what restoreViewpoint() holds on to
  std::uint64_t buffer_texels_ = scenegraph::kUsualBufferTexels, frames_drawn_ = 0;
  QMetaObject::Connection context_watch_;
  QLabel *message_ = nullptr, *progress_label_ = nullptr;
  HelpOverlay* help_ = nullptr;
  ViewPicker* picker_ = nullptr;
  FrameTurn turn_;
};

}  // namespace stillframe::viewer
