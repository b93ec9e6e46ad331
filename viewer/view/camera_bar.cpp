#include "viewer/view/camera_bar.h"

#include <QAction>
#include <QComboBox>
#include <QInputDialog>
#include <QMenu>
#include <QSignalBlocker>
#include <QToolButton>
#include <algorithm>

#include "viewer/frames/frame_picker.h"
#include "viewer/view/narrow_bar.h"
#include "viewer/widget/scene_widget.h"
#include "viewer/window/icons.h"

namespace stillframe::viewer {
namespace {

constexpr int kLeastWidth = 24;  // of the button for what does not fit

QComboBox* makeCombo(QToolBar& bar, const QString& name, const QString& tip, const QStringList& items) {
  auto* combo = new QComboBox(&bar);
  combo->setObjectName(name);
  combo->setToolTip(tip);
  combo->addItems(items);
  combo->setFocusPolicy(Qt::StrongFocus);
  bar.addWidget(combo);
  return combo;
}

/// The entries of a list that is cut off: choosing one is as choosing it in the list.
void addEntries(QComboBox& list, const QString& title, QMenu& menu) {
  QMenu* const entries = menu.addMenu(title);
  entries->setStyleSheet(QStringLiteral("QMenu { menu-scrollable: 1; }"));  // there may be hundreds of frames
  for (int i = 0; i < list.count(); ++i) {
    QAction* const entry = entries->addAction(list.itemText(i).replace('&', QStringLiteral("&&")));
    entry->setCheckable(true);
    entry->setChecked(i == list.currentIndex());
    QObject::connect(entry, &QAction::triggered, &list, [&list, i] { Q_EMIT list.activated(i); });
  }
}

QString nameOf(const scenegraph::SavedView& view) { return QString::fromStdString(view.name); }

}  // namespace

CameraBar::CameraBar(SceneWidget& view, QWidget* parent) : QToolBar(parent), view_(view) {
  setObjectName(QStringLiteral("cameraBar"));
  setIconSize({16, 16});
  setMinimumWidth(kLeastWidth);
  kinds_ = makeCombo(*this, QStringLiteral("cameraKind"), tr("Camera (keys 1 to 4 in the view)"),
                     {tr("Orbit"), tr("XY orbit"), tr("Top down"), tr("Fly")});
  follows_ = makeCombo(*this, QStringLiteral("follow"),
                       tr("What the camera takes from the display frame as that moves (key T in the view)"),
                       {tr("Follow off"), tr("Position"), tr("Heading"), tr("Pose")});
  display_frame_ = new FramePicker(tr("Display frame"), tr("the frame that the camera lives in and follows"), this);
  display_frame_->setObjectName(QStringLiteral("displayFrame"));
  addWidget(display_frame_);
  recenter_ = addAction(transportIcon(TransportIcon::Target), tr("Bring the display frame to the middle, upright (R)"));
  recenter_->setObjectName(QStringLiteral("recenterFrame"));
  views_ = new QMenu(tr("Views"), this);
  views_->menuAction()->setToolTip(tr("Saved views, smooth moves, help"));
  addAction(views_->menuAction());  // no widget: Qt disables an extension that has nothing but widgets
  auto* const button = qobject_cast<QToolButton*>(widgetForAction(views_->menuAction()));
  button->setObjectName(QStringLiteral("views"));
  button->setPopupMode(QToolButton::InstantPopup);
  // The style's own is black in any theme.
  if (auto* const more = findChild<QToolButton*>(QStringLiteral("qt_toolbar_ext_button"))) {
    more->setIcon(transportIcon(TransportIcon::More));
    more->setToolTip(tr("More of the camera: follow, display frame, saved views"));
  }

  connect(kinds_, &QComboBox::activated, this, [this](int index) {
    view_.setCameraKind(scenegraph::kCameraKinds[index]);
    view_.setFocus();
  });
  connect(follows_, &QComboBox::activated, this, [this](int index) {
    view_.setFollow(scenegraph::kFollowModes[index]);
    view_.setFocus();
  });
  connect(display_frame_, &FramePicker::picked, this, [this](const std::optional<std::string>& frame) {
    view_.setDisplayFrame(frame);
    refresh();
    view_.setFocus();
  });
  connect(recenter_, &QAction::triggered, &view_, &SceneWidget::recenter);
  connect(views_, &QMenu::aboutToShow, this, &CameraBar::fillViews);
  connect(&view_, &SceneWidget::cameraChanged, this, &CameraBar::showCamera);
  fillViews();
  showCamera();
}

void CameraBar::showCamera() {
  const QSignalBlocker of_kinds(kinds_);
  const QSignalBlocker of_follows(follows_);
  kinds_->setCurrentIndex(static_cast<int>(view_.camera().rig().kind()));
  follows_->setCurrentIndex(static_cast<int>(view_.camera().follow().mode()));
  const bool is_waiting = view_.camera().follow().state().is_waiting;
  follows_->setToolTip(is_waiting
                           ? tr("The display frame has no place at this time: the camera waits for it")
                           : tr("What the camera takes from the display frame as that moves (key T in the view)"));
  refresh();
}

void CameraBar::refresh() {
  scenegraph::Scene* scene = view_.scene();
  if (scene == nullptr) {
    return;
  }
  const tf::TransformBuffer& buffer = *scene->dataset().transforms();
  if (buffer.frameCount() != static_cast<std::size_t>(display_frame_->frameCount())) {
    display_frame_->setFrames(buffer.frames());
  }
  const std::optional<std::string>& frame = view_.camera().displayFrame();
  display_frame_->setCurrent(frame, scene->fixedFrame());
  display_frame_->setPlaced(!frame || scene->frames().fixedFromFrame(*frame).has_value());
}

/// Qt moves no widget into the extension's menu.
void CameraBar::resizeEvent(QResizeEvent* event) {
  QToolBar::resizeEvent(event);
  auto* const extension = findChild<QToolButton*>(QStringLiteral("qt_toolbar_ext_button"));
  if (extension != nullptr && (more_ == nullptr || extension->menu() != more_)) {
    delete more_;
    more_ = new QMenu(this);
    connect(more_, &QMenu::aboutToShow, this, &CameraBar::fillMore);
    extension->setMenu(more_);
  }
}

void CameraBar::fillMore() {
  for (QMenu* const entries : more_->findChildren<QMenu*>(Qt::FindDirectChildrenOnly)) {
    delete entries;
  }
  more_->clear();
  for (QAction* const action : actions()) {
    QWidget* const widget = widgetForAction(action);
    if (widget->isVisible()) {
      continue;
    }
    auto* const list = qobject_cast<QComboBox*>(widget);
    if (list == nullptr) {
      more_->addAction(action);
    } else {
      addEntries(*list,
                 list == kinds_     ? tr("&Camera")
                 : list == follows_ ? tr("&Follow")
                                    : tr("&Display frame"),
                 *more_);
    }
  }
  if (bar_ == nullptr || bar_->sparedNow().empty()) {
    return;
  }
  more_->addSeparator();
  for (QToolButton* const button : bar_->sparedNow()) {
    QAction* const entry = more_->addAction(button->icon(), button->toolTip().section(':', 0, 0));
    entry->setCheckable(button->isCheckable());
    entry->setChecked(button->isChecked());
    connect(entry, &QAction::triggered, button, &QToolButton::click);
  }
}

void CameraBar::fillViews() {
  views_->clear();
  connect(views_->addAction(tr("&Save this view...")), &QAction::triggered, this, &CameraBar::askForName);
  const auto& saved = view_.savedViews();
  views_->addSeparator();
  for (std::size_t i = 0; i < saved.size(); ++i) {
    const QString name = nameOf(saved[i]);
    QAction* action = views_->addAction(i < 9 ? tr("%1\tCtrl+%2").arg(name).arg(i + 1) : name);
    connect(action, &QAction::triggered, &view_, [this, name] { view_.showSavedView(name); });
  }
  if (!saved.empty()) {
    QMenu* remove = views_->addMenu(tr("&Delete"));
    for (const scenegraph::SavedView& view : saved) {
      connect(remove->addAction(nameOf(view)), &QAction::triggered, &view_, [this, name = view.name] {
        auto views = view_.savedViews();
        std::erase_if(views, [&](const scenegraph::SavedView& one) { return one.name == name; });
        view_.setSavedViews(std::move(views));
      });
    }
    views_->addSeparator();
  }
  connect(views_->addAction(tr("&Home")), &QAction::triggered, &view_, &SceneWidget::home);
  connect(views_->addAction(tr("&Frame everything")), &QAction::triggered, &view_, &SceneWidget::frameAll);
  QAction* smooth = views_->addAction(tr("S&mooth moves"));
  smooth->setCheckable(true);
  smooth->setChecked(view_.hasSmoothMoves());
  connect(smooth, &QAction::toggled, &view_, &SceneWidget::setSmoothMoves);
  connect(views_->addAction(tr("&Keys and gestures\t?")), &QAction::triggered, &view_, &SceneWidget::toggleHelp);
}

void CameraBar::askForName() {
  bool is_accepted = false;
  const QString name = QInputDialog::getText(this, tr("Save this view"), tr("Name:"), QLineEdit::Normal,
                                             tr("View %1").arg(view_.savedViews().size() + 1), &is_accepted);
  if (is_accepted) {
    view_.saveView(name);
  }
}

}  // namespace stillframe::viewer
