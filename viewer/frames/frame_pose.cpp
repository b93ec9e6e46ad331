#include "viewer/frames/frame_pose.h"

#include <QClipboard>
#include <QGridLayout>
#include <QGuiApplication>
#include <QLabel>
#include <QToolButton>
#include <utility>

#include "scenegraph/scene.h"
#include "viewer/frames/frame_picker.h"
#include "viewer/frames/pose_text.h"

namespace stillframe::viewer {
namespace {

constexpr int kLeastPickerWidth = 40;

}  // namespace

FramePose::FramePose(QWidget* parent)
    : QWidget(parent),
      source_(new FramePicker(tr("Pose of"), tr("the frame whose pose is shown"), this)),
      target_(new FramePicker(tr("In"), tr("the frame it is expressed in"), this)),
      label_(new QLabel(this)),
      copy_(new QToolButton(this)) {
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(4, 2, 4, 2);
  layout->setSpacing(2);
  label_->setObjectName(QStringLiteral("pose"));
  label_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  label_->setWordWrap(true);
  copy_->setObjectName(QStringLiteral("copyPose"));
  copy_->setText(tr("Copy"));
  copy_->setToolTip(tr("Copy the pose as JSON, with all 17 digits"));
  layout->addWidget(new QLabel(tr("Pose of"), this), 0, 0);
  layout->addWidget(source_, 0, 1);
  layout->addWidget(new QLabel(tr("in"), this), 0, 2);
  layout->addWidget(target_, 0, 3, 1, 2);
  layout->addWidget(label_, 1, 0, 1, 4);
  layout->addWidget(copy_, 1, 4, Qt::AlignTop);
  layout->setColumnStretch(1, 1);
  layout->setColumnStretch(3, 1);
  for (FramePicker* picker : {source_, target_}) {
    picker->setMinimumContentsLength(6);
    picker->setMinimumWidth(kLeastPickerWidth);
  }
  connect(source_, &FramePicker::picked, this, [this](const std::optional<std::string>& frame) {
    source_name_ = frame;
    showAt(time_);
  });
  connect(target_, &FramePicker::picked, this, [this](const std::optional<std::string>& frame) {
    target_name_ = frame;
    showAt(time_);
  });
  connect(copy_, &QToolButton::clicked, this, [this] { QGuiApplication::clipboard()->setText(json_); });
}

void FramePose::setDataset(std::shared_ptr<const scenegraph::Dataset> dataset) {
  dataset_ = std::move(dataset);
  source_name_.reset();
  target_name_.reset();
}

void FramePose::choose(const std::optional<std::string>& target, const std::optional<std::string>& source) {
  target_name_ = target ? target : target_name_;
  source_name_ = source ? source : source_name_;
  showAt(time_);
}

QString FramePose::text() const { return label_->text(); }

void FramePose::showAt(tf::TimePoint time) {
  time_ = time;
  if (dataset_ == nullptr) {
    return;
  }
  const tf::TransformBuffer& buffer = *dataset_->transforms();
  const std::string automatic = scenegraph::automaticFixedFrame(buffer);
  const std::vector<std::string> frames = buffer.frames();
  for (FramePicker* picker : {source_, target_}) {
    picker->setFrames(frames);
    picker->setCurrent(picker == source_ ? source_name_ : target_name_, automatic);
  }
  const std::string source = source_name_.value_or(automatic);
  const std::string target = target_name_.value_or(automatic);
  const auto target_from_source = buffer.tryLookupTransform(target, source, time_);
  json_ = target_from_source ? poseJson(target, source, *target_from_source) : QString();
  QString text;
  if (target_from_source) {
    text = poseText(*target_from_source);
  } else if (!frames.empty()) {
    text = QString::fromStdString(buffer.describe(target_from_source.error()));
  }
  if (label_->text() != text) {
    label_->setText(text);
  }
  copy_->setEnabled(!json_.isEmpty());
}

}  // namespace stillframe::viewer
