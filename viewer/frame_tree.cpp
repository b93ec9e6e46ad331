#include "viewer/frame_tree.h"

#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QSplitter>
#include <QTimer>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <cmath>

namespace stillframe::viewer {
namespace {

constexpr int kFrame = 0;  // columns
constexpr int kAge = 1;
constexpr int kSamples = 2;
constexpr int kRate = 3;
constexpr int kColumns = 4;
constexpr int kRefreshMs = 100;

void setTextIfNew(QTreeWidgetItem& item, int column, const QString& text) {
  if (item.text(column) != text) {
    item.setText(column, text);
  }
}

}  // namespace

QString durationText(double seconds) {
  const double size = std::abs(seconds);
  if (size < 1e-3) {
    return QString::number(seconds * 1e6, 'f', 0) + QStringLiteral(" µs");
  }
  if (size < 1.0) {
    return QString::number(seconds * 1e3, 'f', size < 0.01 ? 1 : 0) + QStringLiteral(" ms");
  }
  if (size < 1e4) {
    return QString::number(seconds, 'f', size < 100.0 ? 2 : 0) + QStringLiteral(" s");
  }
  return QString::number(seconds / 3600.0, 'g', 4) + QStringLiteral(" h");
}

FrameTree::FrameTree(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* splitter = new QSplitter(Qt::Vertical, this);
  layout->addWidget(splitter);

  tree_ = new QTreeWidget(splitter);
  tree_->setObjectName(QStringLiteral("frames"));
  tree_->setColumnCount(kColumns);
  tree_->setHeaderLabels({tr("Frame"), tr("Age"), tr("Count"), tr("Hz")});
  tree_->setUniformRowHeights(true);
  tree_->setIndentation(10);
  tree_->setFrameShape(QFrame::NoFrame);
  tree_->header()->setStretchLastSection(false);
  tree_->header()->setSectionResizeMode(kFrame, QHeaderView::Stretch);
  for (int column = kAge; column < kColumns; ++column) {
    tree_->header()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
  }
  connect(tree_, &QTreeWidget::itemClicked, this,
          [this](QTreeWidgetItem* item) { Q_EMIT framePicked(item->text(kFrame)); });

  problems_ = new QTreeWidget(splitter);
  problems_->setObjectName(QStringLiteral("problems"));
  problems_->setColumnCount(1);
  problems_->setHeaderLabels({tr("Problems")});
  problems_->setRootIsDecorated(false);
  problems_->setWordWrap(true);
  problems_->setFrameShape(QFrame::NoFrame);
  problems_->setVisible(false);
  splitter->setStretchFactor(0, 4);
  splitter->setStretchFactor(1, 1);

  more_ = new QLabel(this);
  more_->setVisible(false);
  layout->addWidget(more_);

  timer_ = new QTimer(this);
  timer_->setSingleShot(true);
  timer_->setInterval(kRefreshMs);
  connect(timer_, &QTimer::timeout, this, &FrameTree::refreshNow);
}

void FrameTree::setDataset(std::shared_ptr<const scenegraph::Dataset> dataset) {
  dataset_ = std::move(dataset);
  tree_->clear();
  problems_->clear();
  items_.clear();
  parents_.clear();
  refreshNow();
}

void FrameTree::setTime(tf::TimePoint time) {
  if (time != time_) {
    time_ = time;
    refreshLater();
  }
}

void FrameTree::refreshLater() {
  if (!timer_->isActive() && isVisible()) {
    timer_->start();
  }
}

void FrameTree::refreshNow() {
  if (dataset_ == nullptr) {
    return;
  }
  rebuild();
  showSamples();
  showProblems();
}

void FrameTree::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refreshNow();
}

QTreeWidgetItem* FrameTree::item(const std::string& frame) const {
  const auto id = dataset_ == nullptr ? std::nullopt : dataset_->transforms()->findFrame(frame);
  return id && *id < items_.size() ? items_[*id] : nullptr;
}

void FrameTree::rebuild() {
  const tf::TransformBuffer& buffer = *dataset_->transforms();
  const std::vector<std::string> names = buffer.frames();
  const std::size_t count = std::min(names.size(), kMaxRows);
  std::vector<tf::FrameId> parents(count);
  for (std::size_t id = 0; id < count; ++id) {
    parents[id] = buffer.parent(static_cast<tf::FrameId>(id));
  }
  bool is_same = parents == parents_ && items_.size() == count;
  for (std::size_t id = 0; is_same && id < count; ++id) {
    is_same = items_[id]->data(kFrame, Qt::UserRole).toString() == QString::fromStdString(names[id]);
  }
  if (is_same) {
    return;
  }
  tree_->clear();
  items_.assign(count, nullptr);
  for (std::size_t id = 0; id < count; ++id) {
    items_[id] = new QTreeWidgetItem;
    const QString name = QString::fromStdString(names[id]);
    items_[id]->setText(kFrame, name);
    items_[id]->setData(kFrame, Qt::UserRole, name);
    for (int column = kAge; column < kColumns; ++column) {
      items_[id]->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    }
  }
  for (std::size_t id = 0; id < count; ++id) {
    if (parents[id] < count) {
      items_[parents[id]]->addChild(items_[id]);
    } else {
      tree_->addTopLevelItem(items_[id]);
    }
  }
  tree_->expandAll();
  parents_ = std::move(parents);
  more_->setVisible(names.size() > count);
  more_->setText(tr("and %1 more frames").arg(names.size() - count));
}

void FrameTree::showSamples() {
  const tf::TransformBuffer& buffer = *dataset_->transforms();
  for (std::size_t id = 0; id < items_.size(); ++id) {
    QTreeWidgetItem& row = *items_[id];
    const auto frame = static_cast<tf::FrameId>(id);
    const auto edge = buffer.edge(frame);
    if (!edge || edge->samples == 0) {
      continue;
    }
    const auto in_force = buffer.stampInForce(frame, time_);
    setTextIfNew(row, kAge,
                 in_force ? (edge->is_static ? tr("static") : durationText(tf::secondsBetween(*in_force, time_)))
                 : edge->is_static ? tr("static, later")
                                   : tr("none yet"));
    setTextIfNew(row, kSamples, QLocale().toString(static_cast<qulonglong>(edge->samples)));
    const double span_s = tf::secondsBetween(edge->first, edge->last);
    setTextIfNew(row, kRate,
                 edge->samples > 1 && span_s > 0.0
                     ? QString::number(static_cast<double>(edge->samples - 1) / span_s, 'f', 1)
                     : QString());
    const bool is_disabled = !in_force && !buffer.isStaticForAllTime();
    row.setForeground(kFrame, is_disabled ? palette().brush(QPalette::Disabled, QPalette::Text) : QBrush());
    row.setToolTip(kFrame, tr("%1 in %2, samples from %3 to %4 ns")
                               .arg(QString::fromStdString(edge->child), QString::fromStdString(edge->parent))
                               .arg(edge->first.ns)
                               .arg(edge->last.ns));
  }
}

void FrameTree::showProblems() {
  const auto problems = dataset_->problems();
  problems_->setVisible(!problems.empty());
  problems_->setHeaderLabels({tr("Problems (%1)").arg(problems.size())});
  for (int i = 0; i < static_cast<int>(problems.size()); ++i) {
    const scenegraph::Problem& problem = problems[static_cast<std::size_t>(i)];
    if (i == problems_->topLevelItemCount()) {
      problems_->addTopLevelItem(new QTreeWidgetItem);
    }
    const QString times = problem.count > 1 ? tr(" (%1 times)").arg(problem.count) : QString();
    const QString text = QString::fromStdString(problem.code + ": " + problem.message) + times;
    setTextIfNew(*problems_->topLevelItem(i), 0, text);
    problems_->topLevelItem(i)->setToolTip(0, text);
  }
}

}  // namespace stillframe::viewer
