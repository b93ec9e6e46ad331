// The camera of SceneWidget: what it looks at, what it follows, where it glides.
#include <algorithm>
#include <utility>

#include "scenegraph/osg_box.h"
#include "viewer/pick/hover_label.h"
#include "viewer/pick/view_picker.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {
namespace {

constexpr double kSmallestFramedRadiusM = 1.0;  // a single frame is not looked at from inside its axes
constexpr double kLongestStepS = 0.1;           // of a walk: a stall is no leap

/// Whether a layer of a topic, not only a built-in, draws something.
bool hasDataInSight(const scenegraph::Scene& scene) {
  return std::ranges::any_of(scene.layers(), [](const auto& slot) {
    return slot->type->consumes != scenegraph::ObjectType::None && slot->layer->isVisible() &&
           slot->layer->boundsInFixed().valid();
  });
}

QString noPlaceText(const std::string& frame, const scenegraph::Scene& scene) {
  return SceneWidget::tr("%1 has no place in %2 at this time")
      .arg(QString::fromStdString(frame), QString::fromStdString(scene.fixedFrame()));
}

}  // namespace

scenegraph::Follow::Pose SceneWidget::displayPose() const {
  if (scene_ == nullptr) {
    return std::nullopt;
  }
  if (!camera_.displayFrame()) {
    return tf::RigidTransform{};
  }
  const auto pose = scene_->frames().fixedFromFrame(*camera_.displayFrame());
  return pose ? scenegraph::Follow::Pose(*pose) : std::nullopt;
}

/// The camera goes along with the tick that the scene has just taken. Returns whether it moved.
bool SceneWidget::followTick() {
  const std::string& fixed_frame = scene_->frames().fixedFrame();
  bool has_moved = false;
  if (fixed_frame != camera_frame_) {
    const auto new_from_old =
        scene_->dataset().transforms()->tryLookupTransform(fixed_frame, camera_frame_, scene_->frames().time());
    if (restored_) {
      camera_.setState(*restored_);
    } else if (!is_camera_touched_) {
      wants_framing_ = true;
    } else if (new_from_old) {
      camera_.changeFixedFrame(*new_from_old, displayPose());
    }
    camera_frame_ = fixed_frame;
    has_moved = true;
  }
  return camera_.track(displayPose()) || has_moved;
}

void SceneWidget::setViewpoint(const scenegraph::ViewpointState& state) {
  camera_.setState(state);
  if (scene_ != nullptr) {
    camera_frame_ = scene_->fixedFrame();
    camera_.track(displayPose());
  }
  onCameraMoved();
}

void SceneWidget::restoreViewpoint(const scenegraph::ViewpointState& state, bool is_touched) {
  if (scene_ != nullptr) {
    scene_->update(time_);  // the followed frame is there where the restored fixed frame has it
  }
  setViewpoint(state);
  is_camera_touched_ = is_touched;
  has_framed_data_ = true;
  restored_ = state;
}

bool SceneWidget::endRestoring() {
  if (!restored_) {
    return false;
  }
  if (scene_ != nullptr) {
    scene_->update(time_);  // the last data may have brought another fixed frame: not one to look anew for
    followTick();
    update();
  }
  restored_.reset();
  return true;
}

void SceneWidget::setCameraKind(scenegraph::CameraKind kind) {
  camera_.setKind(kind, now());
  picker_->label().hide();
  update();
  Q_EMIT cameraChanged();
}

void SceneWidget::setFollow(scenegraph::FollowMode mode) {
  camera_.setFollow(mode, displayPose(), now());
  update();
  Q_EMIT cameraChanged();
}

void SceneWidget::setDisplayFrame(const std::optional<std::string>& frame) {
  std::optional<std::string> wanted =
      frame ? std::optional(std::string(tf::stripLeadingSlashes(*frame))) : std::nullopt;
  if (wanted && wanted->empty()) {
    wanted.reset();
  }
  scenegraph::Follow::Pose pose = tf::RigidTransform{};
  if (wanted) {
    const auto fixed_from_frame =
        scene_ == nullptr ? std::unexpected(tf::LookupFailure{}) : scene_->frames().fixedFromFrame(*wanted);
    pose = fixed_from_frame ? scenegraph::Follow::Pose(*fixed_from_frame) : std::nullopt;
  }
  camera_.setDisplayFrame(std::move(wanted), pose, now());
  update();
  Q_EMIT cameraChanged();
}

void SceneWidget::home() {
  resetView();
  glides_home_ = true;
}

void SceneWidget::resetView() {
  is_camera_touched_ = false;
  restored_.reset();
  wants_framing_ = true;
  glides_home_ = false;
  if (scene_ != nullptr) {
    requestTick();
  }
}

void SceneWidget::frameAll() {
  const osg::BoundingBoxd box = scene_ == nullptr ? osg::BoundingBoxd() : scene_->boundsInFixed();
  if (box.valid()) {
    camera_.beginMove(now(), has_smooth_moves_);
    camera_.frame(scenegraph::atLeast(scenegraph::toBox(box), kSmallestFramedRadiusM), aspect());
    onCameraMoved();
  }
}

void SceneWidget::frameSelection() {
  if (selection_ && scene_ != nullptr) {
    if (const auto fixed_from_frame = scene_->frames().fixedFromFrame(selection_->frame)) {
      scenegraph::Box box;
      box.add(tf::transformPoint(*fixed_from_frame, selection_->point_in_frame));
      camera_.beginMove(now(), has_smooth_moves_);
      camera_.frame(scenegraph::atLeast(box, std::max(selection_->radius_m, 1e-6)), aspect());
      onCameraMoved();
      return;
    }
  }
  frameAll();
}

void SceneWidget::recenter() {
  if (const auto pose = displayPose()) {
    camera_.beginMove(now(), has_smooth_moves_);
    camera_.recenter(pose);
    onCameraMoved();
  } else if (camera_.displayFrame()) {
    Q_EMIT refused(noPlaceText(*camera_.displayFrame(), *scene_));
  }
}

void SceneWidget::lookFrom(const glm::dvec3& side) {
  const scenegraph::Sight sight = camera_.sight();
  camera_.beginMove(now(), has_smooth_moves_);
  camera_.look(scenegraph::lookingFrom(sight.focal_point + sight.radius_m * side, sight.focal_point, sight));
  onCameraMoved();
}

void SceneWidget::frameOrigin(const std::string& frame) {
  if (scene_ == nullptr) {
    return;
  }
  if (const auto fixed_from_frame = scene_->frames().fixedFromFrame(frame)) {
    camera_.beginMove(now(), has_smooth_moves_);
    camera_.lookAtPoint(fixed_from_frame->translation);
    onCameraMoved();
  } else {
    Q_EMIT refused(noPlaceText(frame, *scene_));
  }
}

void SceneWidget::frameIfWanted() {
  // Recordings often begin before their first cloud: the default view waits for what there is to see.
  if (!is_camera_touched_ && !has_framed_data_ && hasDataInSight(*scene_)) {
    wants_framing_ = true;
  }
  if (!wants_framing_ || scene_->isPending()) {
    return;
  }
  const scenegraph::Box box = scene_->bulkInFixed();
  if (!box.isValid()) {
    return;
  }
  wants_framing_ = false;
  has_framed_data_ = hasDataInSight(*scene_);
  camera_.beginMove(now(), has_smooth_moves_ && std::exchange(glides_home_, false));
  camera_.reset(displayPose());
  camera_.frame(scenegraph::atLeast(box, kSmallestFramedRadiusM), aspect());
  update();
  Q_EMIT cameraChanged();
}

void SceneWidget::walk() {
  const double step_s = std::min(now() - std::exchange(walked_s_, now()), kLongestStepS);
  if (keys_.isWalking()) {
    camera_.grasp(now()).walk(keys_.direction(), step_s);
    is_camera_touched_ = true;
    restored_.reset();
    wants_framing_ = false;
  }
}

double SceneWidget::aspect() const {
  return width() > 0 && height() > 0 ? static_cast<double>(width()) / height() : 1.0;
}

void SceneWidget::onCameraMoved() {
  is_camera_touched_ = true;
  wants_framing_ = false;
  picker_->label().hide();
  update();
  Q_EMIT cameraChanged();
}

void SceneWidget::setSavedViews(std::vector<scenegraph::SavedView> views) {
  saved_views_ = std::move(views);
  Q_EMIT savedViewsChanged();
}

void SceneWidget::saveView(const QString& name) {
  const auto named = [this](const std::string& wanted) {
    return std::ranges::find(saved_views_, wanted, &scenegraph::SavedView::name);
  };
  std::string wanted = name.trimmed().toStdString();
  for (int number = 1; wanted.empty(); ++number) {
    const std::string free = tr("View %1").arg(number).toStdString();
    wanted = named(free) == saved_views_.end() ? free : std::string();
  }
  if (const auto found = named(wanted); found != saved_views_.end()) {
    found->viewpoint = camera_.state();
  } else {
    saved_views_.push_back({wanted, camera_.state()});
  }
  Q_EMIT savedViewsChanged();
}

bool SceneWidget::showSavedView(const QString& name) {
  const auto found = std::ranges::find(saved_views_, name.toStdString(), &scenegraph::SavedView::name);
  if (found == saved_views_.end()) {
    return false;
  }
  // Smooth only where both live in the same frame in the same way; else there is no way in between.
  const scenegraph::ViewpointState now_shown = camera_.state();
  const bool is_alike = now_shown.camera.kind == found->viewpoint.camera.kind &&
                        now_shown.follow == found->viewpoint.follow &&
                        now_shown.display_frame == found->viewpoint.display_frame;
  const scenegraph::Sight from = camera_.sight();
  setViewpoint(found->viewpoint);
  if (is_alike && has_smooth_moves_) {
    camera_.glideFrom(from, now());
  }
  return true;
}

}  // namespace stillframe::viewer
