// Layouts of the inspector: opened, saved, restored.
#include <QFile>
#include <QFileDialog>
#include <QMenu>
#include <QSaveFile>
#include <QStatusBar>
#include <algorithm>

#include "viewer/time/time_bar.h"
#include "viewer/widget/scene_widget.h"
#include "viewer/window/inspector_window.h"
#include "viewer/window/message_bar.h"
#include "viewer/window/window_place.h"

namespace stillframe::viewer {
namespace {

constexpr std::size_t kMostLines = 8;  // of a message

QString fileFilter() { return InspectorWindow::tr("Layouts (*.xml);;All files (*)"); }

QString named(const std::filesystem::path& file) { return QString::fromStdString(file.string()); }

}  // namespace

void InspectorWindow::buildLayoutMenu(QMenu& file) {
  file.addSeparator();
  QAction* open = file.addAction(tr("Open &layout..."));
  open->setShortcut(QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_O));
  connect(open, &QAction::triggered, this, [this] {
    if (const QString name = QFileDialog::getOpenFileName(this, tr("Open a layout"), {}, fileFilter());
        !name.isEmpty()) {
      openLayout(name.toStdString());
    }
  });
  const auto save_as = [this] {
    const QString name = QFileDialog::getSaveFileName(
        this, tr("Save the layout"), options_.layout_file ? named(*options_.layout_file) : QStringLiteral("layout.xml"),
        fileFilter());
    if (!name.isEmpty()) {
      saveLayout(name.toStdString());
    }
  };
  QAction* save = file.addAction(tr("&Save layout"));
  save->setShortcut(QKeySequence::Save);
  connect(save, &QAction::triggered, this, [this, save_as] {
    if (options_.layout_file) {
      saveLayout(std::filesystem::path(*options_.layout_file));
    } else {
      save_as();
    }
  });
  QAction* other = file.addAction(tr("Save layout &as..."));
  other->setShortcut(QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_S));
  connect(other, &QAction::triggered, this, save_as);
  file.addSeparator();
}

scenegraph::Layout InspectorWindow::layout() const {
  scenegraph::Layout layout = views_->layout();
  scenegraph::WindowLayout& main = layout.windows.front();
  takePlace(*this, main);
  main.docks = saveState().toBase64().toStdString();
  return layout;
}

void InspectorWindow::restore(const scenegraph::Layout& layout) {
  const scenegraph::WindowLayout& main = layout.windows.front();
  if (!main.docks.empty()) {  // else it is one of a host, or written by hand
    bringToPlace(main, *this);
    restoreState(QByteArray::fromBase64(QByteArray::fromStdString(main.docks)));
  }
  views_->arrange(layout);
  if (!is_loading_) {
    tellNotRestored();
  }
}

bool InspectorWindow::openLayout(const std::filesystem::path& file) {
  const auto layout = scenegraph::readLayout(file);
  if (!layout) {
    messages_->showMessage(scenegraph::StatusLevel::Error, QString::fromStdString(layout.error().message));
    return false;
  }
  messages_->hide();
  restore(*layout);
  options_.layout_file = file;
  return true;
}

bool InspectorWindow::saveLayout(const std::filesystem::path& file) {
  const std::string text = scenegraph::writeXml(toXml(layout()));
  QSaveFile target(named(file));
  if (!target.open(QIODevice::WriteOnly) || target.write(text.data(), static_cast<qint64>(text.size())) < 0 ||
      !target.commit()) {
    messages_->showMessage(scenegraph::StatusLevel::Error,
                           tr("%1 cannot be written: %2").arg(named(file), target.errorString()));
    return false;
  }
  options_.layout_file = file;
  statusBar()->showMessage(tr("Saved %1").arg(named(file)));
  return true;
}

/// Why there is nothing to see, or not at the time that was asked for.
QStringList InspectorWindow::openingRemarks() const {
  if (dataset_ == nullptr) {
    return {};
  }
  const QString name = QString::fromStdString(dataset_->name());
  const auto range = dataset_->timeRange();
  if (!range) {
    return {tr("%1 holds no messages").arg(name)};
  }
  QStringList lines;
  const auto has_data = [](ViewPanel* panel) {
    const scenegraph::Scene* const scene = panel->view().scene();
    return scene != nullptr && std::ranges::any_of(scene->layers(), [](const auto& slot) {
             return slot->type->consumes != scenegraph::ObjectType::None;
           });
  };
  if (dataset_->transforms()->frameCount() == 0 && std::ranges::none_of(views(), has_data)) {
    lines += tr("Nothing of %1 can be drawn: 'stillframe info' says why, topic by topic").arg(name);
  }
  const TimeRange times{range->first, range->second};
  const auto asked =
      options_.time && is_time_untouched_ ? parseTime(QString::fromStdString(*options_.time), times) : std::nullopt;
  if (asked && (*asked < times.first || *asked > times.last)) {
    lines += tr("Time %1 is outside the recording, which spans +0 to %2")
                 .arg(QString::fromStdString(*options_.time), secondsText(times.last, times, 3));
  }
  return lines;
}

/// What the views' layouts name and the recording does not have; what several views miss is one line.
void InspectorWindow::tellNotRestored() {
  struct Missing {
    QString line;
    QStringList views;
  };
  std::vector<Missing> missing;
  for (std::size_t i = 0; i < views().size(); ++i) {
    for (const std::string& line : views()[i]->notRestored()) {
      const QString text = QString::fromStdString(line);
      const auto known = std::ranges::find(missing, text, &Missing::line);
      Missing& one = known == missing.end() ? missing.emplace_back(Missing{.line = text, .views = {}}) : *known;
      one.views += QString::number(i + 1);
    }
  }
  QStringList lines = openingRemarks();
  for (const auto& [line, of] : missing) {
    const bool is_of_all = static_cast<std::size_t>(of.size()) == views().size();
    lines += is_of_all
                 ? line
                 : (of.size() == 1 ? tr("view %1: %2") : tr("views %1: %2")).arg(of.join(QStringLiteral(", ")), line);
  }
  if (const auto count = static_cast<std::size_t>(lines.size()); count > kMostLines) {
    lines.resize(kMostLines);
    lines += tr("and %1 more").arg(count - kMostLines);
  }
  if (!lines.isEmpty()) {
    messages_->showMessage(scenegraph::StatusLevel::Warn, lines.join(QLatin1Char('\n')));
  }
}

}  // namespace stillframe::viewer
