#include "host_window.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDomDocument>
#include <QFile>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QMenuBar>
#include <QStatusBar>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>

#include "plot.h"
#include "viewer/view/view_panel.h"
#include "viewer/widget/scene_widget.h"

namespace host_example {

using stillframe::tf::TimePoint;
using stillframe::viewer::SceneDock;

namespace {

constexpr int kTick_ms = 50;
constexpr int kDockHeight_px = 430;
const QString kDock = QStringLiteral("Scene3DDock");

}  // namespace

HostWindow::HostWindow(QWidget* parent) : QMainWindow(parent) {
  setWindowTitle(QStringLiteral("Host example"));
  resize(1200, 760);
  auto* central = new QWidget(this);
  auto* layout = new QVBoxLayout(central);
  auto* row = new QHBoxLayout;
  values_ = new QComboBox(central);
  live_ = new QCheckBox(QStringLiteral("Live"), central);
  live_->setChecked(true);
  row->addWidget(values_, 1);
  row->addWidget(live_);
  layout->addLayout(row);
  plot_ = new Plot(central);
  layout->addWidget(plot_, 1);
  setCentralWidget(central);

  robot_.growTo(TimePoint{0});
  for (const Value& value : robot_.values()) {
    values_->addItem(value.name);
  }
  addDock(QStringLiteral("World"), "map");
  addDock(QStringLiteral("Robot"), "base_link");
  buildMenu();
  connect(values_, &QComboBox::currentIndexChanged, this, &HostWindow::chooseValue);
  connect(plot_, &Plot::seekRequested, this, &HostWindow::seek);
  chooseValue();
  timer_ = new QTimer(this);
  connect(timer_, &QTimer::timeout, this, &HostWindow::tick);
  clock_.start();
  timer_->start(kTick_ms);
}

HostWindow::~HostWindow() {
  for (SceneDock* const dock : docks_) {
    delete dock;  // before the context
  }
}

void HostWindow::addDock(const QString& title, const std::string& fixed_frame) {
  auto* frame = new QDockWidget(title, this);
  frame->setObjectName(title);
  auto* dock = new SceneDock(context_, frame);
  dock->setDatasets({robot_.dataset()});
  dock->panel().view().setFixedFrame(fixed_frame);
  frame->setWidget(dock);
  addDockWidget(Qt::TopDockWidgetArea, frame);
  resizeDocks({frame}, {kDockHeight_px}, Qt::Vertical);
  connect(dock, &SceneDock::seekRequested, this, &HostWindow::seek);
  connect(dock, &SceneDock::playRequested, this, [this] { setLive(!isLive()); });
  connect(dock, &SceneDock::picked, this, &HostWindow::tellPick);
  docks_.push_back(dock);
}

void HostWindow::buildMenu() {
  QMenu* menu = menuBar()->addMenu(QStringLiteral("&Layout"));
  menu->addAction(QStringLiteral("&Save..."), this, [this] { saveLayoutTo(QFileDialog::getSaveFileName(this)); });
  menu->addAction(QStringLiteral("&Open..."), this, [this] { openLayout(QFileDialog::getOpenFileName(this)); });
}

/// Nothing for "", which a dialog gives that was left.
void HostWindow::saveLayoutTo(const QString& name) {
  QFile file(name);
  if (name.isEmpty()) {
    return;
  }
  const bool is_written = file.open(QIODevice::WriteOnly) && file.write(layoutText().toUtf8()) >= 0 && file.flush();
  tell(is_written ? QStringLiteral("Saved ") + name : name + QStringLiteral(": ") + file.errorString());
}

void HostWindow::openLayout(const QString& name) {
  QFile file(name);
  if (name.isEmpty()) {
    return;
  }
  if (!file.open(QIODevice::ReadOnly)) {
    tell(name + QStringLiteral(": ") + file.errorString());
  } else if (!restoreLayout(QString::fromUtf8(file.readAll()))) {
    tell(name + QStringLiteral(": no layout, or a dock refuses its part"));
  }
}

void HostWindow::tell(const QString& line) { statusBar()->showMessage(line); }

void HostWindow::tellPick(const stillframe::scenegraph::PickResult& result) {
  const glm::dvec3& at = result.point_in_fixed;
  tell(QStringLiteral("%1 %2 %3 at %4, %5, %6")
           .arg(QString::fromStdString(result.topic), QString::fromStdString(result.picked.kind),
                QString::fromStdString(result.picked.id))
           .arg(at.x)
           .arg(at.y)
           .arg(at.z));
}

void HostWindow::setGrowing(bool growing) { growing ? timer_->start(kTick_ms) : timer_->stop(); }

void HostWindow::tick() {
  robot_.growTo(TimePoint{clock_.nsecsElapsed()});
  for (SceneDock* const dock : docks_) {
    dock->takeGrowth();
  }
  plot_->setRange(TimePoint{0}, robot_.newest());
  if (isLive()) {
    setTime(robot_.newest());
  }
}

void HostWindow::setTime(TimePoint time) {
  time_ = time;
  plot_->setTime(time);
  for (SceneDock* const dock : docks_) {
    dock->setTime(time);
  }
}

void HostWindow::seek(TimePoint time) {
  setLive(false);
  setTime(time);
}

void HostWindow::setLive(bool live) { live_->setChecked(live); }

bool HostWindow::isLive() const { return live_->isChecked(); }

void HostWindow::chooseValue() {
  const std::vector<Value> values = robot_.values();
  const auto index = static_cast<std::size_t>(std::max(values_->currentIndex(), 0));
  plot_->setValue(index < values.size() ? std::optional(values[index]) : std::nullopt);
}

QString HostWindow::layoutText() const {
  QDomDocument document;
  QDomElement root = document.createElement(QStringLiteral("HostLayout"));
  root.setAttribute(QStringLiteral("value"), values_->currentText());
  document.appendChild(root);
  for (const SceneDock* const dock : docks_) {
    root.appendChild(dock->saveState(document));
  }
  return document.toString(2);
}

bool HostWindow::restoreLayout(const QString& text) {
  QDomDocument document;
  if (!document.setContent(text)) {
    return false;
  }
  const QDomElement root = document.documentElement();
  values_->setCurrentText(root.attribute(QStringLiteral("value")));
  bool is_restored = true;
  QDomElement element = root.firstChildElement(kDock);
  for (SceneDock* const dock : docks_) {
    is_restored = dock->restoreState(element) && is_restored;
    element = element.nextSiblingElement(kDock);
  }
  return is_restored;
}

}  // namespace host_example
