#include "viewer/frames/frame_picker.h"

#include <QCompleter>
#include <QFocusEvent>
#include <QLineEdit>
#include <QListView>
#include <QSignalBlocker>
#include <QStringList>
#include <utility>

namespace stillframe::viewer {

FramePicker::FramePicker(QString what, QString meaning, QWidget* parent)
    : QComboBox(parent), what_(std::move(what)), meaning_(std::move(meaning)) {
  setEditable(true);
  setInsertPolicy(QComboBox::NoInsert);
  setMaxVisibleItems(25);
  setMinimumContentsLength(14);
  setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  completer()->setCompletionMode(QCompleter::PopupCompletion);
  completer()->setFilterMode(Qt::MatchContains);
  completer()->setCaseSensitivity(Qt::CaseInsensitive);
  if (auto* list = qobject_cast<QListView*>(view())) {
    list->setUniformItemSizes(true);
  }
  addItem(tr("auto"));
  connect(this, &QComboBox::activated, this, [this](int index) {
    Q_EMIT picked(index <= 0 ? std::nullopt : std::optional(itemText(index).toStdString()));
  });
  connect(lineEdit(), &QLineEdit::returnPressed, this, &FramePicker::pickText);
  showCurrent();
}

void FramePicker::setFrames(const std::vector<std::string>& frames) {
  const auto last = static_cast<std::size_t>(frameCount());
  if (last == frames.size() && (last == 0 || itemText(frameCount()) == QString::fromStdString(frames.back()))) {
    return;
  }
  const QSignalBlocker blocker(this);
  const QString typed = lineEdit()->text();
  const bool is_typing = lineEdit()->isModified();
  // The buffer only ever appends; when it was cleared (another TF clock), the names start anew.
  if (last > frames.size() || (last > 0 && itemText(frameCount()) != QString::fromStdString(frames[last - 1]))) {
    while (frameCount() > 0) {
      removeItem(count() - 1);
    }
  }
  QStringList added;
  for (std::size_t i = static_cast<std::size_t>(frameCount()); i < frames.size(); ++i) {
    added << QString::fromStdString(frames[i]);
  }
  addItems(added);
  showCurrent();
  if (is_typing) {
    lineEdit()->setText(typed);
    lineEdit()->setModified(true);
  }
}

void FramePicker::setCurrent(const std::optional<std::string>& chosen, const std::string& automatic) {
  if (chosen == chosen_ && automatic == automatic_) {
    return;
  }
  chosen_ = chosen;
  automatic_ = automatic;
  showCurrent();
}

void FramePicker::showCurrent() {
  const QSignalBlocker blocker(this);
  setItemText(0, automatic_.empty() ? tr("auto") : tr("auto (%1)").arg(QString::fromStdString(automatic_)));
  int index = 0;
  is_missing_ = false;
  if (chosen_) {
    index = -1;
    const QString wanted = QString::fromStdString(*chosen_);
    for (int i = 1; i < count() && index < 0; ++i) {
      index = itemText(i) == wanted ? i : -1;
    }
    is_missing_ = index < 0;
  }
  setCurrentIndex(index);
  setEditText(is_missing_ ? QString::fromStdString(*chosen_) : itemText(index));
  lineEdit()->setModified(false);
  lineEdit()->setCursorPosition(0);
  QPalette colors;
  if (is_missing_) {
    colors.setColor(QPalette::Text, QColor(0xe5, 0x53, 0x4b));
  } else if (!is_placed_) {
    colors.setColor(QPalette::Text, palette().color(QPalette::Disabled, QPalette::Text));
  }
  lineEdit()->setPalette(colors);
  if (is_missing_) {
    setToolTip(tr("%1 \"%2\" does not exist in this recording").arg(what_, QString::fromStdString(*chosen_)));
  } else if (!is_placed_) {
    setToolTip(tr("%1 \"%2\" has no place at this time").arg(what_, currentText()));
  } else {
    setToolTip(tr("%1: %2. Type to search.").arg(what_, meaning_));
  }
}

void FramePicker::setPlaced(bool placed) {
  if (placed != is_placed_) {
    is_placed_ = placed;
    if (!lineEdit()->isModified()) {
      showCurrent();
    }
  }
}

/// Left half typed, it would name a frame that is not the one in use.
void FramePicker::focusOutEvent(QFocusEvent* event) {
  QComboBox::focusOutEvent(event);
  if (lineEdit()->isModified() && event->reason() != Qt::PopupFocusReason) {
    showCurrent();
  }
}

/// A part of one frame's name means that frame; what is in none, or in several, a frame that may come yet.
void FramePicker::pickText() {
  QString text = lineEdit()->text().trimmed();
  if (text.isEmpty() || text == itemText(0)) {
    Q_EMIT picked(std::nullopt);
    return;
  }
  QStringList found;
  const bool is_whole = findText(text) >= 0;
  for (int i = 1; i < count() && !is_whole; ++i) {
    if (itemText(i).contains(text, Qt::CaseInsensitive)) {
      found << itemText(i);
    }
  }
  if (found.size() == 1) {
    text = found.front();
    setEditText(text);
  }
  Q_EMIT picked(text.toStdString());
}

}  // namespace stillframe::viewer
