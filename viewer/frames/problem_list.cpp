#include "viewer/frames/problem_list.h"

#include <QHeaderView>
#include <QThreadPool>
#include <QTimer>
#include <atomic>
#include <utility>

#include "scenegraph/store/edge_problems.h"

namespace stillframe::viewer {
namespace {

constexpr int kText = 0;  // columns
constexpr int kAt = 1;
constexpr int kCheckEveryMs = 2000;

}  // namespace

/// What the worker finds; it writes once, then sets is_done.
struct ProblemList::Check {
  std::uint64_t revision = 0;
  std::vector<scenegraph::Problem> found;
  std::atomic<bool> is_done = false;
};

ProblemList::ProblemList(QWidget* parent) : QTreeWidget(parent), gate_([this] { refresh(); }) {
  setObjectName(QStringLiteral("problems"));
  setColumnCount(2);
  setHeaderLabels({tr("Problems"), tr("At")});
  setRootIsDecorated(false);
  setWordWrap(true);
  setFrameShape(QFrame::NoFrame);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(kText, QHeaderView::Stretch);
  header()->setSectionResizeMode(kAt, QHeaderView::ResizeToContents);
  setVisible(false);
  connect(this, &QTreeWidget::itemClicked, this, [this](QTreeWidgetItem* row) { onRow(row); });
  connect(this, &QTreeWidget::itemActivated, this, [this](QTreeWidgetItem* row) { onRow(row); });
}

void ProblemList::setDataset(std::shared_ptr<const scenegraph::Dataset> dataset) {
  dataset_ = std::move(dataset);
  check_.reset();  // what it finds is of the last recording
  checked_revision_.reset();
  of_edges_.clear();
  since_check_.invalidate();
  refresh();
}

void ProblemList::setLoading(bool is_loading) {
  if (std::exchange(is_loading_, is_loading) && !is_loading) {
    since_check_.invalidate();
    refresh();
  }
}

bool ProblemList::isChecked() const {
  return dataset_ == nullptr || checked_revision_ == dataset_->transforms()->revision();
}

void ProblemList::refresh() {
  if (dataset_ == nullptr) {
    return;
  }
  const bool is_done = check_ != nullptr && check_->is_done;
  if (is_done) {
    of_edges_ = std::move(check_->found);
    checked_revision_ = check_->revision;
    check_.reset();
  }
  if (check_ == nullptr && !is_loading_ && !isChecked()) {
    startCheck();
  }
  showProblems();
  if (is_done) {
    Q_EMIT checked();
  }
}

void ProblemList::startCheck() {
  if (since_check_.isValid() && since_check_.elapsed() < kCheckEveryMs) {
    QTimer::singleShot(kCheckEveryMs, this, &ProblemList::refresh);
    return;
  }
  since_check_.start();
  check_ = std::make_shared<Check>();
  check_->revision = dataset_->transforms()->revision();
  QThreadPool::globalInstance()->start([dataset = dataset_, check = check_, tell = gate_.requester()] {
    if (const auto range = dataset->timeRange()) {
      check->found = scenegraph::edgeProblems(*dataset->transforms(), range->second);
    }
    check->is_done = true;
    tell();
  });
}

void ProblemList::showProblems() {
  shown_ = dataset_->problems();
  shown_.insert(shown_.end(), of_edges_.begin(), of_edges_.end());
  setVisible(!shown_.empty());
  headerItem()->setText(kText, tr("Problems (%1)").arg(shown_.size()));
  const auto range = dataset_->timeRange();
  const auto setTextIfNew = [](QTreeWidgetItem& row, int column, const QString& text) {
    if (row.text(column) != text) {
      row.setText(column, text);
    }
  };
  while (static_cast<std::size_t>(topLevelItemCount()) > shown_.size()) {
    delete takeTopLevelItem(topLevelItemCount() - 1);
  }
  for (int i = 0; i < static_cast<int>(shown_.size()); ++i) {
    const scenegraph::Problem& problem = shown_[static_cast<std::size_t>(i)];
    if (i == topLevelItemCount()) {
      addTopLevelItem(new QTreeWidgetItem);
    }
    const QString times = problem.count > 1 ? tr(" (%1 times)").arg(problem.count) : QString();
    const QString text = QString::fromStdString(problem.code + ": " + problem.message) + times;
    QTreeWidgetItem& row = *topLevelItem(i);
    setTextIfNew(row, kText, text);
    row.setToolTip(kText, problem.time ? tr("%1\nClick to go there.").arg(text) : text);
    setTextIfNew(row, kAt,
                 problem.time && range
                     ? QStringLiteral("+%1 s").arg(tf::secondsBetween(range->first, *problem.time), 0, 'f', 3)
                     : QString());
  }
}

void ProblemList::onRow(QTreeWidgetItem* row) {
  const int index = indexOfTopLevelItem(row);
  if (index >= 0 && static_cast<std::size_t>(index) < shown_.size()) {
    if (const auto& time = shown_[static_cast<std::size_t>(index)].time) {
      Q_EMIT timeRequested(*time);
    }
  }
}

}  // namespace stillframe::viewer
