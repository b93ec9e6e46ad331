#include "viewer/pick/inspect_panel.h"

#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <utility>

#include "scenegraph/settings.h"
#include "viewer/pick/view_picks.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {
namespace {

QTreeWidget* makeTable(QWidget* parent, const QString& name, const QStringList& columns) {
  auto* table = new QTreeWidget(parent);
  table->setObjectName(name);
  table->setHeaderLabels(columns);
  table->setRootIsDecorated(false);
  table->setSelectionMode(QAbstractItemView::ExtendedSelection);
  table->setUniformRowHeights(true);
  table->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  return table;
}

/// Rows are changed in place: what is chosen stays chosen while time goes on.
void setRow(QTreeWidget& table, int index, const QStringList& texts) {
  if (index == table.topLevelItemCount()) {
    table.addTopLevelItem(new QTreeWidgetItem);
  }
  QTreeWidgetItem& row = *table.topLevelItem(index);
  for (int column = 0; column < texts.size(); ++column) {
    if (row.text(column) != texts[column]) {
      row.setText(column, texts[column]);
      row.setToolTip(column, texts[column]);
    }
  }
}

/// For the clipboard, with all its digits.
QString copyTextOf(const scenegraph::Measurement& of) {
  const glm::dvec3& delta = of.delta_in_fixed;
  QStringList parts;
  for (const auto& [name, metres] : {std::pair("distance", of.length_m), std::pair("dx", delta.x),
                                     std::pair("dy", delta.y), std::pair("dz", delta.z)}) {
    parts << QLatin1String(name) << QString::fromStdString(scenegraph::settingText(metres));
  }
  return parts.join(QLatin1Char('\t'));
}

void dropRowsFrom(QTreeWidget& table, int count) {
  while (table.topLevelItemCount() > count) {
    delete table.takeTopLevelItem(table.topLevelItemCount() - 1);
  }
}

}  // namespace

InspectPanel::InspectPanel(QWidget* parent)
    : QWidget(parent),
      hint_(new QLabel(tr("Click something in the view, or press P for what is in its middle. With Shift, a second "
                          "point to measure to."),
                       this)),
      rows_(makeTable(this, QStringLiteral("pickRows"), {tr("Name"), tr("Value")})),
      measurements_(makeTable(this, QStringLiteral("measurements"), {tr("Distance"), tr("From"), tr("To")})),
      copy_(new QToolButton(this)),
      remove_(new QToolButton(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  hint_->setWordWrap(true);
  layout->addWidget(hint_);
  layout->addWidget(rows_, 3);
  copy_->setText(tr("Copy"));
  copy_->setObjectName(QStringLiteral("copyPick"));
  copy_->setToolTip(tr("Copies the lines chosen, or all, with all their digits (Ctrl+C)"));
  layout->addWidget(copy_);
  layout->addWidget(measurements_, 1);
  remove_->setText(tr("Remove"));
  remove_->setObjectName(QStringLiteral("removeMeasurement"));
  remove_->setToolTip(tr("Removes the distances chosen, or all (Delete)"));
  layout->addWidget(remove_);
  for (QTreeWidget* const table : {rows_, measurements_}) {
    table->installEventFilter(this);
  }
  // What is chosen in one table is what is meant: not a row of the other, too.
  for (const auto& [one, other] : {std::pair(rows_, measurements_), std::pair(measurements_, rows_)}) {
    connect(one, &QTreeWidget::itemSelectionChanged, other, [one, other] {
      if (!one->selectedItems().isEmpty()) {
        other->clearSelection();
      }
    });
  }
  connect(copy_, &QToolButton::clicked, this, &InspectPanel::copy);
  connect(remove_, &QToolButton::clicked, this, &InspectPanel::removeMeasurements);
  refresh();
}

void InspectPanel::setView(SceneWidget* view) {
  if (view_ == view) {
    return;
  }
  if (view_ != nullptr) {
    view_->disconnect(this);
    view_->picks().disconnect(this);
  }
  view_ = view;
  if (view_ != nullptr) {
    connect(view_, &SceneWidget::sceneUpdated, this, &InspectPanel::refresh);
    connect(view_, &SceneWidget::cameraChanged, this, &InspectPanel::onCamera);
    connect(&view_->picks(), &ViewPicks::changed, this, &InspectPanel::refresh);
  }
  refresh();
}

/// Told of every move; only another display frame changes what is shown.
void InspectPanel::onCamera() {
  if (view_->camera().displayFrame().value_or(std::string()) != display_frame_) {
    refresh();
  }
}

void InspectPanel::refresh() {
  const scenegraph::Scene* const scene = view_ != nullptr ? view_->scene() : nullptr;
  const auto* const picked = scene != nullptr && view_->picks().selected() ? &*view_->picks().selected() : nullptr;
  display_frame_ = scene != nullptr ? view_->camera().displayFrame().value_or(std::string()) : std::string();
  int count = 0;
  if (picked != nullptr) {
    const std::string display = view_->camera().displayFrame().value_or(scene->frames().fixedFrame());
    for (const auto& [name, text] : scenegraph::pickRows(*scene, *picked, display)) {
      setRow(*rows_, count++, {QString::fromStdString(name), QString::fromStdString(text)});
    }
  }
  dropRowsFrom(*rows_, count);
  hint_->setVisible(picked == nullptr);
  refreshMeasurements();
  copy_->setEnabled(picked != nullptr || measurements_->topLevelItemCount() > 0);
}

void InspectPanel::refreshMeasurements() {
  const scenegraph::Scene* const scene = view_ != nullptr ? view_->scene() : nullptr;
  int count = 0;
  if (scene != nullptr) {
    measurements_->headerItem()->setText(0, tr("Distance in %1").arg(QString::fromStdString(scene->fixedFrame())));
    for (const scenegraph::PickMarks::Pair& pair : view_->picks().measured()) {
      const auto length = scenegraph::measureNow(*scene, pair);
      const auto nameOf = [](const scenegraph::PickResult& end) {
        return QString::fromStdString(end.topic + " " + end.picked.kind + " " + end.picked.id);
      };
      setRow(*measurements_, count,
             {length ? QString::fromStdString(scenegraph::measurementText(*length)) : tr("no place now"),
              nameOf(pair.first), nameOf(pair.second)});
      QTreeWidgetItem& row = *measurements_->topLevelItem(count++);
      row.setData(0, Qt::UserRole, length ? copyTextOf(*length) : row.text(0));
    }
  }
  dropRowsFrom(*measurements_, count);
  measurements_->setVisible(count > 0);
  remove_->setVisible(count > 0);
}

QString InspectPanel::copyText() const {
  QStringList lines;
  const bool has_chosen = !rows_->selectedItems().isEmpty() || !measurements_->selectedItems().isEmpty();
  const auto add = [&](const QTreeWidget& table, auto text_of) {
    for (int i = 0; i < table.topLevelItemCount(); ++i) {
      const QTreeWidgetItem& row = *table.topLevelItem(i);
      if (row.isSelected() || !has_chosen) {
        lines << text_of(row);
      }
    }
  };
  add(*rows_, [](const QTreeWidgetItem& row) { return row.text(0) + QLatin1Char('\t') + row.text(1); });
  add(*measurements_, [](const QTreeWidgetItem& row) {
    return QStringList{row.data(0, Qt::UserRole).toString(), row.text(1), row.text(2)}.join(QLatin1Char('\t'));
  });
  return lines.join(QLatin1Char('\n'));
}

void InspectPanel::copy() { QApplication::clipboard()->setText(copyText()); }

void InspectPanel::removeMeasurements() {
  if (view_ == nullptr) {
    return;
  }
  const bool has_chosen = !measurements_->selectedItems().isEmpty();
  std::vector<std::size_t> gone;
  for (int i = measurements_->topLevelItemCount() - 1; i >= 0; --i) {
    if (!has_chosen || measurements_->topLevelItem(i)->isSelected()) {
      gone.push_back(static_cast<std::size_t>(i));
    }
  }
  measurements_->clearSelection();
  for (const std::size_t index : gone) {  // from the end
    view_->picks().removeMeasurement(index);
  }
}

/// Of the tables: Qt's own would copy one cell.
bool InspectPanel::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::KeyPress && static_cast<QKeyEvent*>(event)->matches(QKeySequence::Copy)) {
    copy();
    return true;
  }
  return QWidget::eventFilter(watched, event);
}

void InspectPanel::keyPressEvent(QKeyEvent* event) {
  if (event->matches(QKeySequence::Copy)) {
    copy();
  } else if (event->key() == Qt::Key_Delete) {
    removeMeasurements();
  } else {
    QWidget::keyPressEvent(event);
  }
}

}  // namespace stillframe::viewer
