#include "viewer/scene_widget.h"

#include <QLabel>
#include <QOpenGLContext>
#include <QResizeEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/registry.h"
#include "scenegraph/pipeline/gl_context_info.h"
#include "viewer/gl_format.h"

namespace stillframe::viewer {
namespace {

constexpr double kSmallestFramedRadiusM = 1.0;  // a single frame is not looked at from inside its axes

/// Rotation of `transform` about Z: how far its X axis turns in the plane.
double heading(const tf::RigidTransform& transform) {
  const glm::dvec3 x = transform.rotation * glm::dvec3(1.0, 0.0, 0.0);
  return std::hypot(x.x, x.y) < 1e-6 ? 0.0 : std::atan2(x.y, x.x);
}

osg::BoundingBoxd atLeast(osg::BoundingBoxd box, double radius_m) {
  const osg::Vec3d centre = box.center();
  box.expandBy(centre - osg::Vec3d(radius_m, radius_m, radius_m));
  box.expandBy(centre + osg::Vec3d(radius_m, radius_m, radius_m));
  return box;
}

/// Whether a layer of a topic, not only a built-in, draws something.
bool hasDataInSight(const scenegraph::Scene& scene) {
  return std::ranges::any_of(scene.layers(), [](const auto& slot) {
    return slot->type->consumes != scenegraph::ObjectType::None && slot->layer->isVisible() &&
           slot->layer->boundsInFixed().valid();
  });
}

QLabel* makeOverlay(QWidget* parent) {
  auto* label = new QLabel(parent);
  label->setAttribute(Qt::WA_TransparentForMouseEvents);
  label->setVisible(false);
  return label;
}

}  // namespace

SceneWidget::SceneWidget(QWidget* parent)
    : QOpenGLWidget(parent),
      gate_([this] { applyTick(); }),
      message_(makeOverlay(this)),
      hover_label_(makeOverlay(this)) {
  setFormat(glFormat());
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(0, 0);
  message_->setAlignment(Qt::AlignCenter);
  message_->setWordWrap(true);
  message_->setMargin(24);
  message_->setStyleSheet(QStringLiteral("color: #e8e8e8; background: #202226;"));
  hover_label_->setStyleSheet(
      QStringLiteral("color: white; background: rgba(20, 22, 26, 200); border-radius: 3px; padding: 2px 5px;"));
}

SceneWidget::~SceneWidget() {
  disconnect(context_watch_);
  dropPipeline();
}

void SceneWidget::setDataset(std::shared_ptr<scenegraph::Dataset> dataset, scenegraph::Executor& executor) {
  dropPipeline();
  scene_.reset();
  if (dataset != nullptr) {
    scene_ = std::make_unique<scenegraph::Scene>(std::move(dataset), nodes::layerTypes(), executor, gate_.requester());
  }
  is_camera_touched_ = false;
  wants_framing_ = true;
  has_framed_data_ = false;
  requestTick();
  update();
}

void SceneWidget::setTime(tf::TimePoint time) {
  if (time != time_) {
    time_ = time;
    requestTick();
  }
}

void SceneWidget::setFixedFrame(const std::optional<std::string>& frame) {
  if (scene_ == nullptr) {
    return;
  }
  const std::string before = scene_->fixedFrame();
  scene_->setFixedFrame(frame);
  const std::string after = scene_->fixedFrame();
  if (is_camera_touched_) {
    if (const auto after_from_before = scene_->dataset().transforms()->tryLookupTransform(after, before, time_)) {
      auto state = camera_.state();
      state.focal_point = tf::transformPoint(*after_from_before, state.focal_point);
      state.yaw_rad += heading(*after_from_before);
      camera_.setState(state);
    }
  } else {
    wants_framing_ = true;
  }
  requestTick();
  update();
}

bool SceneWidget::applyTick() {
  if (scene_ == nullptr || !isVisible()) {
    return false;  // showEvent() asks again
  }
  const bool is_changed = scene_->update(time_);
  frameIfWanted();
  if (is_changed) {
    update();
  }
  Q_EMIT sceneUpdated();
  return is_changed;
}

void SceneWidget::setCameraState(const scenegraph::OrbitCamera::State& state) {
  camera_.setState(state);
  onCameraMoved();
}

void SceneWidget::setBackground(const scenegraph::Color& background) {
  if (!(background == background_)) {
    background_ = background;
    update();
  }
}

QString SceneWidget::problem() const { return message_->isHidden() ? QString() : message_->text(); }

void SceneWidget::home() {
  is_camera_touched_ = false;
  wants_framing_ = true;
  if (scene_ != nullptr) {
    requestTick();
  }
}

void SceneWidget::frameAll() {
  const osg::BoundingBoxd box = scene_ == nullptr ? osg::BoundingBoxd() : scene_->boundsInFixed();
  if (box.valid()) {
    camera_.frame(atLeast(box, kSmallestFramedRadiusM), aspect());
    onCameraMoved();
  }
}

void SceneWidget::frameOrigin(const std::string& frame) {
  if (scene_ == nullptr) {
    return;
  }
  if (const auto fixed_from_frame = scene_->frames().fixedFromFrame(frame)) {
    auto state = camera_.state();
    state.focal_point = fixed_from_frame->translation;
    setCameraState(state);
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
  const osg::BoundingBoxd box = scene_->boundsInFixed();
  if (!box.valid()) {
    return;
  }
  wants_framing_ = false;
  has_framed_data_ = hasDataInSight(*scene_);
  camera_.setState({});
  camera_.frame(atLeast(box, kSmallestFramedRadiusM), aspect());
  update();
  Q_EMIT cameraChanged();
}

double SceneWidget::aspect() const {
  return width() > 0 && height() > 0 ? static_cast<double>(width()) / height() : 1.0;
}

void SceneWidget::onCameraMoved() {
  is_camera_touched_ = true;
  wants_framing_ = false;
  hover_label_->hide();
  update();
  Q_EMIT cameraChanged();
}

void SceneWidget::initializeGL() {
  disconnect(context_watch_);
  context_watch_ =
      connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &SceneWidget::releaseGl, Qt::DirectConnection);
  const auto info = scenegraph::inspectCurrentContext();
  is_context_usable_ = info.has_value();
  if (!info) {
    qCWarning(glLog).noquote() << QString::fromStdString(info.error().message);
    showProblem(tr("The 3D view cannot be drawn.\n\n%1").arg(QString::fromStdString(info.error().message)));
    return;
  }
  showProblem({});
  debug_log_.install();
}

void SceneWidget::paintGL() {
  if (!is_context_usable_) {
    return;
  }
  if (pipeline_ == nullptr) {
    pipeline_ = std::make_unique<scenegraph::ViewPipeline>(
        scene_ == nullptr ? osg::ref_ptr<osg::Group>(new osg::Group) : osg::ref_ptr<osg::Group>(&scene_->root()));
  }
  const QSizeF size_px = QSizeF(size()) * devicePixelRatioF();
  pipeline_->setView(camera_.view());
  pipeline_->setBackground(background_);
  const auto drawn = pipeline_->render(defaultFramebufferObject(), qRound(size_px.width()), qRound(size_px.height()));
  showProblem(drawn ? QString()
                    : tr("The 3D view cannot be drawn.\n\n%1").arg(QString::fromStdString(drawn.error().message)));
  ++frames_drawn_;
  for (; logged_messages_ < debug_log_.messages().size(); ++logged_messages_) {
    qCWarning(glLog).noquote() << QString::fromStdString(debug_log_.messages()[logged_messages_]);
  }
}

void SceneWidget::releaseGl() {
  if (!is_context_usable_) {
    return;
  }
  makeCurrent();
  if (pipeline_ != nullptr) {
    pipeline_->releaseGl();
  }
  debug_log_.uninstall();
  doneCurrent();
  gl_messages_ += debug_log_.count();
  debug_log_.clear();
  logged_messages_ = 0;
  is_context_usable_ = false;
}

void SceneWidget::dropPipeline() {
  if (pipeline_ == nullptr) {
    return;
  }
  // Without a usable context everything was released when the last one went.
  if (is_context_usable_) {
    makeCurrent();
    pipeline_.reset();
    doneCurrent();
  } else {
    pipeline_.reset();
  }
}

void SceneWidget::showProblem(const QString& text) {
  if (message_->text() == text && message_->isHidden() == text.isEmpty()) {
    return;
  }
  message_->setText(text);
  message_->setGeometry(rect());
  message_->setVisible(!text.isEmpty());
}

}  // namespace stillframe::viewer
