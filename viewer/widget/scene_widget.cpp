#include "viewer/widget/scene_widget.h"

#include <QLabel>
#include <QOpenGLContext>
#include <QResizeEvent>
#include <limits>
#include <utility>

#include "nodes/registry.h"
#include "scenegraph/pipeline/draw_times.h"
#include "scenegraph/pipeline/gl_context_info.h"
#include "viewer/pick/view_picker.h"
#include "viewer/widget/gl_format.h"
#include "viewer/widget/help_overlay.h"
#include "viewer/widget/picture_job.h"

namespace stillframe::viewer {
namespace {

constexpr int kProgressMargin = 6;

QLabel* makeOverlay(QWidget* parent) {
  auto* label = new QLabel(parent);
  label->setAttribute(Qt::WA_TransparentForMouseEvents);
  label->setVisible(false);
  return label;
}

}  // namespace

SceneWidget::SceneWidget(QWidget* parent)
    : GlView(parent),
      gate_([this] { applyTick(); }),
      wake_gate_([this] { turn_.ask(); }),
      message_(makeOverlay(this)),
      progress_label_(makeOverlay(this)),
      help_(new HelpOverlay(this)),
      picker_(new ViewPicker(*this)),
      turn_([this] { return stepFrame(); }, [this] { return underMouse() || hasFocus(); }) {
  clock_.start();
  connect(this, &SceneWidget::cameraChanged, this, [this] { restored_.reset(); });
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setMinimumSize(0, 0);
  message_->setAlignment(Qt::AlignCenter);
  message_->setWordWrap(true);
  message_->setMargin(24);
  message_->setStyleSheet(QStringLiteral("color: #e8e8e8; background: #202226;"));
  progress_label_->setStyleSheet(
      QStringLiteral("color: white; background: rgba(20, 22, 26, 200); border-radius: 3px; padding: 2px 5px;"));
}

SceneWidget::~SceneWidget() {
  disconnect(context_watch_);
  dropPipeline();
  if (is_context_usable_) {
    makeCurrent();
    debug_log_.uninstall();  // what GlView lets go of may have something to say
    doneCurrent();
  }
}

void SceneWidget::setDataset(std::shared_ptr<scenegraph::Dataset> dataset, scenegraph::Executor& executor) {
  dropPipeline();
  scene_.reset();
  if (dataset != nullptr) {
    scene_ = std::make_unique<scenegraph::Scene>(std::move(dataset), nodes::layerTypes(), executor, gate_.requester());
    scene_->setBufferTexels(buffer_texels_);
  }
  is_camera_touched_ = false;
  restored_.reset();
  wants_framing_ = true;
  has_framed_data_ = false;
  camera_frame_.clear();
  selection_.reset();
  picker_->clear();
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
  scene_->setFixedFrame(frame);
  restored_.reset();
  requestTick();
  update();
}

bool SceneWidget::applyTick() {
  if (scene_ == nullptr || !isVisible() || isLent()) {
    return false;  // showEvent() and takeBack() ask again
  }
  if (steps_.at != FrameSteps::At::Rest || picker_->holdsView()) {
    steps_.has_put_tick = true;  // endFrame() and goOn() ask again
    return false;
  }
  bool is_changed = scene_->update(time_);
  is_changed = followTick() || is_changed;  // after the scene, so that camera and data are of one tick
  frameIfWanted();
  if (is_changed) {
    update();
  }
  Q_EMIT sceneUpdated();
  return is_changed;
}

void SceneWidget::setBackground(const scenegraph::Color& background) {
  if (!(background == background_)) {
    background_ = background;
    update();
  }
}

void SceneWidget::setEffects(const scenegraph::ViewEffects& effects) {
  if (effects == effects_) {
    return;
  }
  effects_ = effects;
  if (pipeline_ != nullptr && !isLent()) {
    pipeline_->setPostChain(effects_.chain());
  }
  update();
}

QString SceneWidget::problem() const { return message_->isHidden() ? QString() : message_->text(); }

void SceneWidget::initializeGL() {
  disconnect(context_watch_);
  if (context() != nullptr) {
    context_watch_ =
        connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &SceneWidget::releaseGl, Qt::DirectConnection);
  }
  const auto info = scenegraph::inspectCurrentContext();
  is_context_usable_ = info.has_value();
  steps_ = {};
  is_software_ = info && info->is_software;
  if (!info) {
    qCWarning(glLog).noquote() << QString::fromStdString(info.error().message);
    showProblem(tr("The 3D view cannot be drawn.\n\n%1").arg(QString::fromStdString(info.error().message)));
    return;
  }
  buffer_texels_ = info->max_buffer_texels;
  if (scene_ != nullptr && scene_->setBufferTexels(buffer_texels_)) {
    requestTick();
  }
  showProblem({});
  debug_log_.install();
}

void SceneWidget::setPointWay(scenegraph::PointWay way, std::optional<double> budget_ms) {
  point_way_ = way;
  point_budget_ms_ = budget_ms;
  update();
}

double SceneWidget::pointShare() const {
  return pipeline_ != nullptr && pipeline_->pointProgress() ? pipeline_->pointProgress()->share : 1.0;
}

void SceneWidget::showProgress() {
  const double share = pointShare();
  sayProgress(share < 1.0 ? tr("%1 % of the points, refining").arg(100.0 * share, 0, 'g', 2) : QString());
}

void SceneWidget::sayProgress(const QString& text) {
  progress_label_->setVisible(!text.isEmpty());
  if (!text.isEmpty()) {
    progress_label_->setText(text);
    progress_label_->adjustSize();
    progress_label_->move(kProgressMargin, height() - progress_label_->height() - kProgressMargin);
  }
}

void SceneWidget::releaseGl() {
  steps_ = {};
  picker_->dropClicks();
  picture_.reset();
  draw_times_.reset();
  if (!is_context_usable_) {
    return;
  }
  makeCurrent();
  kept_.release();
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
  const bool is_blank = std::exchange(steps_, {}).is_blank;
  steps_.is_blank = is_blank;
  picture_.reset();
  draw_times_.reset();
  if (pipeline_ == nullptr) {
    return;
  }
  // Without a usable context everything was released when the last one went.
  if (is_context_usable_) {
    makeCurrent();
    kept_.release();
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
