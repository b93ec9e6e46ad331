#include "viewer/window/inspector_window.h"

#include <QApplication>
#include <QDebug>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QMimeData>
#include <QProgressBar>
#include <QScreen>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <thread>

#include "viewer/frames/frame_tree.h"
#include "viewer/frames/problem_list.h"
#include "viewer/pick/inspect_dock.h"
#include "viewer/time/opening_time.h"
#include "viewer/time/time_bar.h"
#include "viewer/widget/scene_widget.h"
#include "viewer/window/keyboard_guard.h"
#include "viewer/window/message_bar.h"
#include "viewer/window/set_later.h"
#include "viewer/window/view_window.h"

namespace stillframe::viewer {
namespace {

constexpr int kProgressSteps = 1000;
constexpr int kFrameTreeWidth = 370;

std::vector<std::filesystem::path> localFiles(const QMimeData& data) {
  std::vector<std::filesystem::path> files;
  for (const QUrl& url : data.urls()) {
    if (url.isLocalFile()) {
      files.emplace_back(url.toLocalFile().toStdString());
    }
  }
  return files;
}

}  // namespace

InspectorWindow::InspectorWindow(RecordingOpener opener, InspectorOptions options, QWidget* parent)
    : QMainWindow(parent),
      options_(std::move(options)),
      executor_(scenegraph::makeThreadPoolExecutor(std::max(2U, std::thread::hardware_concurrency()) - 1U)),
      progress_(new QProgressBar(this)) {
  setWindowTitle(QStringLiteral("Stillframe"));
  setAcceptDrops(true);
  resize(QSize(options_.width, options_.height).boundedTo(screen()->availableSize()));

  auto* central = new QWidget(this);
  auto* layout = new QVBoxLayout(central);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  messages_ = new MessageBar(central);
  layout->addWidget(messages_);
  auto* area = new ViewArea(central);
  layout->addWidget(area, 1);
  views_ = new ViewSet(*area, frame_memory_, this);
  setCentralWidget(central);

  auto* time_tool_bar = new QToolBar(tr("Time"), this);  // a tool bar, so that it is as wide as the window
  time_tool_bar->setObjectName(QStringLiteral("timeToolBar"));
  time_tool_bar->setMovable(false);
  time_tool_bar->toggleViewAction()->setEnabled(false);
  time_bar_ = new TimeBar(time_tool_bar);
  time_tool_bar->addWidget(time_bar_);
  addToolBar(Qt::BottomToolBarArea, time_tool_bar);

  auto* dock = new QDockWidget(tr("Frames"), this);
  dock->setObjectName(QStringLiteral("framesDock"));
  frame_tree_ = new FrameTree(dock);
  dock->setWidget(frame_tree_);
  addDockWidget(Qt::RightDockWidgetArea, dock);
  resizeDocks({dock}, {std::min(kFrameTreeWidth, width() / 3)}, Qt::Horizontal);

  // NOLINTNEXTLINE(cppcoreguidelines-prefer-member-initializer): after what it stands on
  inspect_ = new InspectDock(*this);

  progress_->setObjectName(QStringLiteral("progress"));
  progress_->setRange(0, kProgressSteps);
  progress_->setMaximumWidth(220);
  progress_->setMaximumHeight(14);
  progress_->hide();
  statusBar()->addPermanentWidget(progress_);

  connect(time_bar_, &TimeBar::timeChanged, this, [this](tf::TimePoint time) {
    for (ViewPanel* panel : views()) {
      panel->view().setTime(time);
    }
    frame_tree_->setTime(time);
    is_time_untouched_ = false;
  });
  connect(time_bar_, &TimeBar::refused, messages_, &MessageBar::warn);
  connectFrames();

  loader_ = new DatasetLoader(std::move(opener), this);
  connect(loader_, &DatasetLoader::opened, this, &InspectorWindow::onOpened);
  connect(loader_, &DatasetLoader::progressed, this, &InspectorWindow::onProgress);
  connect(loader_, &DatasetLoader::loaded, this, &InspectorWindow::onLoaded);
  connect(loader_, &DatasetLoader::failed, this, &InspectorWindow::onFailed);

  buildMenus();
  qApp->installEventFilter(new KeyboardGuard(this));
  buildShortcuts(*this);
  connect(views_, &ViewSet::added, this, [this](ViewPanel* panel) { connectView(*panel); });
  connect(views_, &ViewSet::windowAdded, this, [this](ViewWindow* window) { buildShortcuts(*window); });
  connect(views_, &ViewSet::refused, messages_, &MessageBar::warn);
  connect(views_, &ViewSet::arranged, this, &InspectorWindow::onArranged);
  if (options_.layout) {
    restore(*options_.layout);
  } else {
    addViews(std::max(1, options_.views));
  }
  makeReachable(*this);
  activeView().view().setFocus();  // its keys work from the first moment
  if (options_.files.empty()) {
    statusBar()->showMessage(tr("Drop recordings here, or choose File > Open"));
  } else {
    openFiles(options_.files);
  }
}

void InspectorWindow::connectFrames() {
  connect(frame_tree_, &FrameTree::framePicked, this, [this](const QString& frame) {
    SceneWidget& view = activeView().view();
    view.setSelection(Selection{frame.toStdString()});
    view.frameOrigin(frame.toStdString());
  });
  connect(frame_tree_, &FrameTree::frameActivated, this, [this](const QString& frame) {
    SceneWidget& view = activeView().view();
    view.setSelection(Selection{frame.toStdString()});
    view.frameSelection();
  });
  connect(frame_tree_, &FrameTree::hiddenFramesEdited, this,
          [this](const FrameTree::Names& hidden) { activeView().setHiddenFrames(hidden); });
  connect(frame_tree_, &FrameTree::timeRequested, time_bar_, &TimeBar::setTime);
  connect(&frame_tree_->problems(), &ProblemList::checked, this, &InspectorWindow::takeScreenshotWhenComplete,
          Qt::QueuedConnection);
  connect(views_, &ViewSet::activeChanged, this, [this] {
    frame_tree_->setHiddenFrames(activeView().hiddenFrames());
    inspect_->setView(activeView().view());
  });
}

InspectorWindow::~InspectorWindow() {
  delete loader_;   // joins the worker, which reads the recording
  views_->clear();  // before the executor, which their layers use
}

void InspectorWindow::openFiles(std::vector<std::filesystem::path> files) {
  statusBar()->showMessage(
      files.empty() ? QString() : tr("Opening %1").arg(QString::fromStdString(files.front().filename().string())));
  setLoading(true);
  progress_->setRange(0, 0);
  progress_->show();
  loader_->open(std::move(files));
}

void InspectorWindow::connectView(ViewPanel& panel) {
  connect(&panel.view(), &SceneWidget::sceneUpdated, this, [this, &panel] {
    if (&panel == &activeView()) {
      frame_tree_->setHiddenFrames(panel.hiddenFrames());
    }
  });
  connect(&panel, &ViewPanel::splitRequested, this,
          [this, &panel](Qt::Orientation orientation) { addView(&panel, orientation); });
  connect(&panel, &ViewPanel::refused, messages_, &MessageBar::warn);
  connect(&panel.view(), &SceneWidget::frameHovered, this,
          [this](const QString& frame) { statusBar()->showMessage(frame); });
  inspect_->watch(panel.view());
  fillView(panel);
}

/// Columns as near to as many as rows as can be, so that a picture is neither narrow nor flat.
void InspectorWindow::addViews(int count) {
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  for (int i = 0; i < count; ++i) {
    if (i < columns) {
      addView();
    } else {
      addView(views()[static_cast<std::size_t>(i - columns)], Qt::Vertical);
    }
  }
}

ViewPanel& InspectorWindow::addView(ViewPanel* like, Qt::Orientation orientation) {
  ViewPanel& panel = views_->add(like, orientation == Qt::Horizontal ? Side::Right : Side::Below);
  scenegraph::ViewLayout layout = like == nullptr ? panel.layout() : like->layout();
  if (like == nullptr) {
    layout.dataset.clear();  // it looks at everything
    layout.effects = options_.effects.toTexts();
  }
  layout.shows_layers = views().size() == 1 && options_.views <= 1;  // side by side, the picture needs the room
  layout.shows_effects = layout.shows_effects && layout.shows_layers;
  panel.restore(layout);
  return panel;
}

void InspectorWindow::closeView(ViewPanel& panel) { views_->close(panel); }

void InspectorWindow::fillView(ViewPanel& panel) {
  if (dataset_ == nullptr) {
    return;
  }
  panel.setDataset(dataset_, *executor_, options_.layers);
  if (options_.fixed_frame) {
    panel.view().setFixedFrame(options_.fixed_frame);
  }
  panel.view().setTime(time_bar_->time());
  if (options_.camera) {
    panel.view().setCameraKind(*options_.camera);
  }
  panel.view().setPointWay(options_.points, options_.point_budget_ms);
  if (options_.display_frame) {
    panel.view().setDisplayFrame(options_.display_frame);
    panel.view().setFollow(options_.follow);
  }
}

void InspectorWindow::setLoading(bool is_loading) {
  is_loading_ = is_loading;
  frame_tree_->problems().setLoading(is_loading);
}

void InspectorWindow::onOpened(const std::shared_ptr<scenegraph::Dataset>& dataset) {
  dataset_ = dataset;
  setLoading(true);
  progress_->show();
  messages_->hide();
  setWindowTitle(QString::fromStdString(dataset->name()) + QStringLiteral(" - Stillframe"));
  statusBar()->showMessage(tr("Loading %1").arg(QString::fromStdString(dataset->name())));
  progress_->setRange(0, kProgressSteps);
  time_bar_->setDataset(dataset);
  is_time_untouched_ = true;
  takeRange();
  for (ViewPanel* panel : views()) {
    fillView(*panel);
  }
  frame_tree_->setDataset(dataset);
  views_->nameWindows();
}

void InspectorWindow::onArranged() {
  makeReachable(*this);
  for (ViewWindow* const window : views_->windows()) {
    makeReachable(*window);
  }
}

void InspectorWindow::takeRange() {
  const auto range = dataset_->timeRange();
  if (!range) {
    return;
  }
  const TimeRange times{range->first, range->second};
  time_bar_->setRange(times);
  if (is_time_untouched_) {
    const auto wanted = options_.time ? parseTime(QString::fromStdString(*options_.time), times) : std::nullopt;
    if (options_.time && !wanted) {
      messages_->warn(tr("\"%1\" is not a time: write nanoseconds, +SECONDS, start or end")
                          .arg(QString::fromStdString(*options_.time)));
    }
    time_bar_->setTime(wanted.value_or(options_.time ? times.first : openingTime(dataset_->store(), times)));
    is_time_untouched_ = true;
  }
}

void InspectorWindow::onProgress(double fraction) {
  setLater(*progress_, static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kProgressSteps));
  takeRange();
  for (ViewPanel* panel : views()) {
    panel->takeGrowth();
  }
  frame_tree_->refreshLater();
}

void InspectorWindow::onLoaded() {
  setLoading(false);
  progress_->hide();
  statusBar()->clearMessage();
  onProgress(1.0);
  if (is_time_untouched_ && !options_.time && time_bar_->time() > time_bar_->range().first) {
    statusBar()->showMessage(tr("Opened at %1 s, when the first messages of its topics are there")
                                 .arg(secondsText(time_bar_->time(), time_bar_->range(), 3)));
  }
  for (ViewPanel* panel : views()) {
    panel->homeUnlessTouched();
  }
  frame_tree_->refreshNow();
  tellNotRestored();
  Q_EMIT loaded();
  takeScreenshotWhenComplete();
}

void InspectorWindow::onFailed(const scenegraph::Status& status) {
  messages_->showMessage(scenegraph::StatusLevel::Error, QString::fromStdString(status.message));
  statusBar()->clearMessage();
  if (options_.screenshot) {
    failUnattended(QString::fromStdString(status.message));
  }
  setLoading(loader_->isBusy());
  if (!is_loading_) {
    progress_->hide();
  } else {
    progress_->setRange(0, kProgressSteps);
  }
}

bool InspectorWindow::isComplete() const {
  return dataset_ != nullptr && !is_loading_ && std::ranges::all_of(views(), [](ViewPanel* panel) {
           return panel->view().framesDrawn() > 0 && panel->view().scene() != nullptr &&
                  !panel->view().scene()->isPending() && panel->view().pointShare() >= 1.0;
         });
}

void InspectorWindow::takeScreenshotWhenComplete() {
  if (!options_.screenshot) {
    return;
  }
  for (ViewPanel* panel : views()) {
    panel->view().applyTick();
    connect(&panel->view(), &SceneWidget::painted, this, &InspectorWindow::takeScreenshotWhenComplete,
            static_cast<Qt::ConnectionType>(Qt::QueuedConnection | Qt::UniqueConnection));
  }
  const bool is_drawn = std::ranges::all_of(views(), [](ViewPanel* panel) { return panel->view().isUpToDate(); });
  if (!isComplete() || !is_drawn || !frame_tree_->problems().isChecked()) {
    return;
  }
  const QPixmap picture = grab();  // draws the views once more
  if (isComplete()) {              // else that was the first frame of what has just come
    const auto file = *std::exchange(options_.screenshot, std::nullopt);
    if (picture.save(QString::fromStdString(file.string()))) {
      close();
    } else {
      failUnattended(tr("cannot write %1").arg(QString::fromStdString(file.string())));
    }
  }
}

void InspectorWindow::failUnattended(const QString& message) {
  qCritical().noquote() << message;
  QCoreApplication::exit(1);
}

void InspectorWindow::closeEvent(QCloseEvent* event) {
  for (ViewWindow* const window : views_->windows()) {
    window->hide();  // else the program would go on for them
  }
  QMainWindow::closeEvent(event);
}

void InspectorWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (!localFiles(*event->mimeData()).empty()) {
    event->acceptProposedAction();
  }
}

void InspectorWindow::dropEvent(QDropEvent* event) {
  auto files = localFiles(*event->mimeData());
  if (!files.empty()) {
    event->acceptProposedAction();
    openFiles(std::move(files));
  }
}

}  // namespace stillframe::viewer
