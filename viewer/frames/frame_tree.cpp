#include "viewer/frames/frame_tree.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QRegularExpression>
#include <QScopedValueRollback>
#include <QSplitter>
#include <QTimer>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <cmath>
#include <utility>

#include "viewer/frames/frame_pose.h"
#include "viewer/frames/problem_list.h"

namespace stillframe::viewer {
namespace {

constexpr int kFrame = 0;  // columns
constexpr int kAge = 1;
constexpr int kSamples = 2;
constexpr int kRate = 3;
constexpr int kSpan = 4;
constexpr int kColumns = 5;
constexpr int kRefreshMs = 100;

void setTextIfNew(QTreeWidgetItem& item, int column, const QString& text) {
  if (item.text(column) != text) {
    item.setText(column, text);
  }
}

std::string nameOf(const QTreeWidgetItem& row) { return row.data(kFrame, Qt::UserRole).toString().toStdString(); }

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

FrameTree::FrameTree(QWidget* parent)
    : QWidget(parent),
      refusal_(new QLabel(this)),
      pose_(new FramePose(this)),
      more_(new QLabel(this)),
      timer_(new QTimer(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(makeFilterRow());
  refusal_->setObjectName(QStringLiteral("filterRefusal"));
  refusal_->setWordWrap(true);
  refusal_->setContentsMargins(5, 0, 5, 2);
  refusal_->hide();
  layout->addWidget(refusal_);
  auto* splitter = new QSplitter(Qt::Vertical, this);
  layout->addWidget(splitter, 1);
  makeTree(splitter);
  problems_ = new ProblemList(splitter);
  splitter->setStretchFactor(0, 4);
  splitter->setStretchFactor(1, 1);
  more_->setVisible(false);
  layout->addWidget(more_);
  layout->addWidget(pose_);

  connect(problems_, &ProblemList::timeRequested, this, &FrameTree::timeRequested);
  timer_->setSingleShot(true);
  timer_->setInterval(kRefreshMs);
  connect(timer_, &QTimer::timeout, this, &FrameTree::refreshNow);
}

QWidget* FrameTree::makeFilterRow() {
  auto* row = new QWidget(this);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(4, 2, 4, 2);
  layout->setSpacing(2);
  filter_ = new QLineEdit(row);
  filter_->setObjectName(QStringLiteral("frameFilter"));
  filter_->setPlaceholderText(tr("Filter (regular expression)"));
  filter_->setClearButtonEnabled(true);
  layout->addWidget(filter_, 1);
  connect(filter_, &QLineEdit::textChanged, this, &FrameTree::applyFilter);
  for (const bool visible : {true, false}) {
    auto* button = new QToolButton(row);
    button->setObjectName(visible ? QStringLiteral("showListed") : QStringLiteral("hideListed"));
    button->setText(visible ? tr("All on") : tr("All off"));
    button->setToolTip(visible ? tr("Draw every frame that is listed") : tr("Draw no frame that is listed"));
    layout->addWidget(button);
    connect(button, &QToolButton::clicked, this, [this, visible] { setAllListed(visible); });
  }
  return row;
}

void FrameTree::makeTree(QWidget* parent) {
  tree_ = new QTreeWidget(parent);
  tree_->setObjectName(QStringLiteral("frames"));
  tree_->setColumnCount(kColumns);
  tree_->setHeaderLabels({tr("Frame"), tr("Age"), tr("Count"), tr("Hz"), tr("Span")});
  tree_->setUniformRowHeights(true);
  tree_->setIndentation(10);
  tree_->setFrameShape(QFrame::NoFrame);
  tree_->header()->setStretchLastSection(false);
  tree_->header()->setSectionResizeMode(kFrame, QHeaderView::Stretch);
  for (int column = kAge; column < kColumns; ++column) {
    tree_->header()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
  }
  connect(tree_, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* row) { onBox(row); });
  connect(tree_, &QTreeWidget::itemPressed, this, [this] { has_toggled_ = false; });
  connect(tree_, &QTreeWidget::itemClicked, this, [this](QTreeWidgetItem* row) {
    if (!std::exchange(has_toggled_, false)) {
      pose_->choose(std::nullopt, nameOf(*row));
      Q_EMIT framePicked(QString::fromStdString(nameOf(*row)));
    }
  });
  connect(tree_, &QTreeWidget::itemActivated, this, [this](QTreeWidgetItem* row) {
    pose_->choose(std::nullopt, nameOf(*row));  // by Enter, no click has
    Q_EMIT frameActivated(QString::fromStdString(nameOf(*row)));
  });
}

void FrameTree::setDataset(std::shared_ptr<const scenegraph::Dataset> dataset) {
  dataset_ = std::move(dataset);
  tree_->clear();
  items_.clear();
  parents_.clear();
  problems_->setDataset(dataset_);
  pose_->setDataset(dataset_);
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
  problems_->refresh();
  pose_->showAt(time_);
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
  const QScopedValueRollback filling(is_filling_, true);
  Names collapsed;  // what is live brings frames all the time: rows stay as they were left
  for (const QTreeWidgetItem* const row : items_) {
    if (!row->isExpanded() && row->childCount() > 0) {
      collapsed.insert(nameOf(*row));
    }
  }
  const std::string current = tree_->currentItem() == nullptr ? std::string() : nameOf(*tree_->currentItem());
  tree_->clear();
  items_.assign(count, nullptr);
  for (std::size_t id = 0; id < count; ++id) {
    items_[id] = new QTreeWidgetItem;
    const QString name = QString::fromStdString(names[id]);
    items_[id]->setText(kFrame, name);
    items_[id]->setData(kFrame, Qt::UserRole, name);
    items_[id]->setCheckState(kFrame, hidden_.contains(names[id]) ? Qt::Unchecked : Qt::Checked);
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
  for (QTreeWidgetItem* const row : items_) {
    if (const std::string name = nameOf(*row); collapsed.contains(name) || name == current) {
      row->setExpanded(!collapsed.contains(name));
      tree_->setCurrentItem(name == current ? row : tree_->currentItem());
    }
  }
  parents_ = std::move(parents);
  more_->setVisible(names.size() > count);
  more_->setText(tr("and %1 more frames").arg(names.size() - count));
  applyFilter();
}

void FrameTree::showSamples() {
  const QScopedValueRollback filling(is_filling_, true);
  for (std::size_t id = 0; id < items_.size(); ++id) {
    const auto edge = dataset_->transforms()->edge(static_cast<tf::FrameId>(id));
    if (edge && edge->samples > 0) {
      showSample(id, *edge);
    } else {
      items_[id]->setForeground(kFrame, matches_[id] ? QBrush() : palette().brush(QPalette::Disabled, QPalette::Text));
      items_[id]->setToolTip(kFrame, tr("%1 is a root: it has no parent").arg(items_[id]->text(kFrame)));
    }
  }
}

void FrameTree::showSample(std::size_t id, const tf::EdgeInfo& edge) {
  const tf::TransformBuffer& buffer = *dataset_->transforms();
  QTreeWidgetItem& row = *items_[id];
  const auto in_force = buffer.stampInForce(static_cast<tf::FrameId>(id), time_);
  setTextIfNew(row, kAge,
               in_force         ? (edge.is_static ? tr("static") : durationText(tf::secondsBetween(*in_force, time_)))
               : edge.is_static ? tr("static, later")
                                : tr("none yet"));
  setTextIfNew(row, kSamples, QLocale().toString(static_cast<qulonglong>(edge.samples)));
  const double span_s = tf::secondsBetween(edge.first, edge.last);
  const bool has_span = edge.samples > 1 && span_s > 0.0;
  setTextIfNew(row, kRate,
               has_span ? QString::number(static_cast<double>(edge.samples - 1) / span_s, 'f', 1) : QString());
  setTextIfNew(row, kSpan, has_span ? durationText(span_s) : QString());
  const bool is_dimmed = (!in_force && !buffer.isStaticForAllTime()) || !matches_[id];
  row.setForeground(kFrame, is_dimmed ? palette().brush(QPalette::Disabled, QPalette::Text) : QBrush());
  row.setToolTip(kFrame, tr("%1 in %2, samples from %3 to %4 ns")
                             .arg(QString::fromStdString(edge.child), QString::fromStdString(edge.parent))
                             .arg(edge.first.ns)
                             .arg(edge.last.ns));
}

/// Rows that match, and those above them, so that one sees where they hang.
void FrameTree::applyFilter() {
  const QRegularExpression pattern(filter_->text(), QRegularExpression::CaseInsensitiveOption);
  QPalette colors;
  if (!pattern.isValid()) {
    colors.setColor(QPalette::Text, QColor(0xe5, 0x53, 0x4b));
  }
  filter_->setPalette(colors);
  filter_->setToolTip(pattern.isValid() ? QString() : pattern.errorString());
  refusal_->setVisible(!pattern.isValid());
  refusal_->setText(tr("No regular expression, at character %1: %2. Every frame is listed.")
                        .arg(pattern.patternErrorOffset())
                        .arg(pattern.errorString()));
  matches_.assign(items_.size(), true);
  std::vector<bool> listed(items_.size(), true);
  if (pattern.isValid() && !filter_->text().isEmpty()) {
    listed.assign(items_.size(), false);
    for (std::size_t id = 0; id < items_.size(); ++id) {
      matches_[id] = pattern.match(items_[id]->text(kFrame)).hasMatch();
      for (std::size_t above = id; matches_[id] && above < items_.size() && !listed[above]; above = parents_[above]) {
        listed[above] = true;
      }
    }
  }
  for (std::size_t id = 0; id < items_.size(); ++id) {
    items_[id]->setHidden(!listed[id]);
  }
  if (dataset_ != nullptr) {
    showSamples();
  }
}

void FrameTree::setHiddenFrames(const Names& hidden) {
  if (hidden == hidden_) {
    return;
  }
  hidden_ = hidden;
  const QScopedValueRollback filling(is_filling_, true);
  for (QTreeWidgetItem* row : items_) {
    const Qt::CheckState state = hidden_.contains(nameOf(*row)) ? Qt::Unchecked : Qt::Checked;
    if (row->checkState(kFrame) != state) {
      row->setCheckState(kFrame, state);
    }
  }
}

void FrameTree::onBox(QTreeWidgetItem* row) {
  if (is_filling_) {
    return;
  }
  has_toggled_ = true;
  if (row->checkState(kFrame) == Qt::Checked) {
    hidden_.erase(nameOf(*row));
  } else {
    hidden_.insert(nameOf(*row));
  }
  Q_EMIT hiddenFramesEdited(hidden_);
}

void FrameTree::setAllListed(bool visible) {
  Names hidden = hidden_;
  for (std::size_t id = 0; id < items_.size(); ++id) {
    if (!matches_[id]) {
      continue;
    }
    if (visible) {
      hidden.erase(nameOf(*items_[id]));
    } else {
      hidden.insert(nameOf(*items_[id]));
    }
  }
  setHiddenFrames(hidden);
  Q_EMIT hiddenFramesEdited(hidden_);
}

}  // namespace stillframe::viewer
