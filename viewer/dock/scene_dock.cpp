#include "viewer/dock/scene_dock.h"

#include <QComboBox>
#include <QShortcut>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <thread>
#include <utility>

#include "viewer/dock/dom.h"
#include "viewer/pick/view_picks.h"
#include "viewer/time/time_bar.h"
#include "viewer/view/view_panel.h"
#include "viewer/widget/scene_widget.h"
#include "viewer/window/keyboard_guard.h"
#include "viewer/window/message_bar.h"

namespace stillframe::viewer {

DockContext::DockContext(unsigned workers)
    : executor_(scenegraph::makeThreadPoolExecutor(
          workers > 0 ? workers : std::max(2U, std::thread::hardware_concurrency()) - 1U)) {}

SceneDock::SceneDock(DockContext& context, QWidget* parent) : QWidget(parent), context_(context) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  // NOLINTNEXTLINE(cppcoreguidelines-prefer-member-initializer): after what it stands on
  messages_ = new MessageBar(this);
  layout->addWidget(messages_);
  // NOLINTNEXTLINE(cppcoreguidelines-prefer-member-initializer): after what it stands on
  choice_ = new QComboBox(this);
  choice_->setObjectName(QStringLiteral("dataset"));
  choice_->setToolTip(tr("The recording or stream that this view shows"));
  choice_->hide();
  layout->addWidget(choice_);
  // NOLINTNEXTLINE(cppcoreguidelines-prefer-member-initializer): after what it stands on
  panel_ = new ViewPanel(this);
  panel_->setFrameMemory(context_.frameMemory());
  panel_->setArrangeable(false);
  layout->addWidget(panel_, 1);

  connect(choice_, &QComboBox::activated, this, [this](int index) {
    showDataset(datasets_.at(static_cast<std::size_t>(index)));
    Q_EMIT datasetChosen(shown_);
  });
  connect(panel_, &ViewPanel::refused, this,
          [this](const QString& message) { messages_->showMessage(scenegraph::StatusLevel::Warn, message); });
  connect(&panel_->view().picks(), &ViewPicks::picked, this,
          [this] { Q_EMIT picked(*panel_->view().picks().selected()); });
  const auto bind = [this](Qt::Key key, auto action) {
    connect(new QShortcut(key, &panel_->view(), nullptr, nullptr, Qt::WidgetShortcut), &QShortcut::activated, this,
            action);
  };
  bind(Qt::Key_Left, [this] { step(-1); });
  bind(Qt::Key_Right, [this] { step(1); });
  bind(Qt::Key_Space, [this] { Q_EMIT playRequested(); });
  makeReachable(*this);
}

SceneDock::~SceneDock() = default;

void SceneDock::setDatasets(std::vector<std::shared_ptr<scenegraph::Dataset>> datasets) {
  datasets_ = std::move(datasets);
  {
    const QSignalBlocker blocker(choice_);
    choice_->clear();
    for (const auto& dataset : datasets_) {
      choice_->addItem(QString::fromStdString(dataset->name()));
    }
  }
  choice_->setVisible(datasets_.size() > 1);
  auto wanted = std::ranges::find(datasets_, shown_);
  if (wanted == datasets_.end()) {
    const std::string name = panel_->layout().dataset;
    wanted = std::ranges::find_if(datasets_, [&](const auto& of) { return of->name() == name; });
  }
  if (wanted == datasets_.end()) {
    wanted = datasets_.begin();
  }
  showDataset(wanted == datasets_.end() ? nullptr : *wanted);
}

void SceneDock::showDataset(const std::shared_ptr<scenegraph::Dataset>& dataset) {
  const auto found = std::ranges::find(datasets_, dataset);
  choice_->setCurrentIndex(found == datasets_.end() ? -1 : static_cast<int>(found - datasets_.begin()));
  if (dataset == shown_) {
    return;
  }
  const scenegraph::ViewLayout layout = panel_->layout();
  shown_ = dataset;
  panel_->setDataset(dataset, context_.executor(), {});
  panel_->restore(layout);
  panel_->view().setTime(time_);
  tellNotRestored();
}

void SceneDock::setTime(tf::TimePoint time) {
  time_ = time;
  panel_->view().setTime(time);
}

void SceneDock::takeGrowth() {
  panel_->takeGrowth();
  tellNotRestored();
}

QDomElement SceneDock::saveState(QDomDocument& document) const { return toDom(toXml(panel_->layout()), document); }

bool SceneDock::restoreState(const QDomElement& element) {
  const auto xml = fromDom(element);
  const auto layout = xml ? scenegraph::viewLayoutOf(*xml)
                          : std::expected<scenegraph::ViewLayout, scenegraph::Status>(std::unexpected(xml.error()));
  if (!layout) {
    messages_->showMessage(scenegraph::StatusLevel::Error, QString::fromStdString(layout.error().message));
    return false;
  }
  panel_->restore(*layout);
  const auto named =
      std::ranges::find_if(datasets_, [&](const auto& of) { return of != shown_ && of->name() == layout->dataset; });
  if (named != datasets_.end()) {
    showDataset(*named);
  }
  messages_->hide();
  tellNotRestored();
  return true;
}

QString SceneDock::message() const { return messages_->text(); }

void SceneDock::step(int direction) {
  const auto next = shown_ == nullptr ? std::nullopt : neighbouringMessage(shown_->store(), time_, direction);
  if (next) {
    Q_EMIT seekRequested(*next);
  }
}

/// Once: the list gets shorter as data comes, and is then shown again.
void SceneDock::tellNotRestored() {
  std::vector<std::string> lines = panel_->notRestored();
  if (lines == told_) {
    return;
  }
  told_ = std::move(lines);
  QStringList text;
  for (const std::string& line : told_) {
    text += QString::fromStdString(line);
  }
  if (text.isEmpty()) {
    messages_->hide();
  } else {
    messages_->showMessage(scenegraph::StatusLevel::Warn, text.join(QLatin1Char('\n')));
  }
}

}  // namespace stillframe::viewer
