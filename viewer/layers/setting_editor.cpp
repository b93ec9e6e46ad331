#include "viewer/layers/setting_editor.h"

#include <QAbstractSpinBox>
#include <QCheckBox>
#include <QColorDialog>
#include <QComboBox>
#include <QCompleter>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <QTreeWidget>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <variant>

#include "viewer/layers/number_box.h"

namespace stillframe::viewer {
namespace {

using scenegraph::SettingKind;
using scenegraph::SettingSpec;

constexpr int kSliderSteps = 1000;
constexpr double kLongestSliderRange = 100.0;
constexpr std::size_t kFewChoices = 7;
constexpr double kLowestInt = std::numeric_limits<int>::min();
constexpr double kHighestInt = std::numeric_limits<int>::max();

bool isBounded(const SettingSpec& spec) { return spec.minimum < spec.maximum; }

template <typename T>
T valueOr(const SettingSpec& spec, const std::string& text, T fallback) {
  const auto value = scenegraph::parseSetting(spec, text);
  const T* typed = value ? std::get_if<T>(&*value) : nullptr;
  return typed == nullptr ? fallback : *typed;
}

QTreeWidget* treeAround(const QWidget& part) {
  for (QWidget* above = part.parentWidget(); above != nullptr && !above->isWindow(); above = above->parentWidget()) {
    if (auto* const tree = qobject_cast<QTreeWidget*>(above)) {
      return tree;
    }
  }
  return nullptr;
}

QColor toQColor(const scenegraph::Color& color) { return QColor::fromRgbF(color.r, color.g, color.b, color.a); }

}  // namespace

EditorFilter::EditorFilter(QWidget& editor) : QObject(&editor) {
  for (QWidget* const part : editor.findChildren<QWidget*>()) {
    if (part->focusPolicy() == Qt::WheelFocus) {
      part->setFocusPolicy(Qt::StrongFocus);
    }
    part->installEventFilter(this);
  }
}

bool EditorFilter::eventFilter(QObject* watched, QEvent* event) {
  const auto* widget = qobject_cast<QWidget*>(watched);
  if (event->type() == QEvent::Wheel && !widget->hasFocus()) {
    event->ignore();
    return true;
  }
  const auto* line = qobject_cast<QLineEdit*>(watched);
  if (qobject_cast<QAbstractSpinBox*>(watched) != nullptr) {
    line = watched->findChild<QLineEdit*>();  // which the box hands its events to by itself
  }
  const auto* const pressed = event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride
                                  ? static_cast<QKeyEvent*>(event)
                                  : nullptr;
  if (QTreeWidget* const tree = treeAround(*widget); tree != nullptr && pressed != nullptr &&
                                                     pressed->key() == Qt::Key_Escape &&
                                                     pressed->modifiers() == Qt::NoModifier) {
    if (event->type() == QEvent::KeyPress) {
      Q_EMIT cancelled();
      tree->setFocus(Qt::OtherFocusReason);
    }
    event->accept();
    return true;
  }
  if (event->type() == QEvent::ShortcutOverride && line != nullptr && !line->isModified()) {
    auto* key = static_cast<QKeyEvent*>(event);
    if (key->matches(QKeySequence::Undo) || key->matches(QKeySequence::Redo)) {
      event->ignore();
      return true;
    }
  }
  return QObject::eventFilter(watched, event);
}

SettingEditor::SettingEditor(const SettingSpec& spec, const std::string& text, QWidget* parent)
    : QWidget(parent), spec_(spec), text_(text) {
  QWidget* editor = nullptr;
  switch (spec_.kind) {
    case SettingKind::Bool:
      editor = makeBool();
      break;
    case SettingKind::Int:
      editor = makeInt();
      break;
    case SettingKind::Double:
      editor = makeDouble();
      break;
    case SettingKind::Text:
      editor = spec_.choices.empty() ? makeText() : makeChoice();
      break;
    case SettingKind::Color:
      editor = makeColor();
      break;
  }
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 1, 4, 1);
  layout->addWidget(editor, 1);
  setToolTip(QString::fromStdString(spec_.help));
  connect(new EditorFilter(*this), &EditorFilter::cancelled, this, &SettingEditor::forgetTyped);
  show_(text_);
}

void SettingEditor::setText(const std::string& text) {
  if (text == text_) {
    return;
  }
  text_ = text;
  show_(text_);
}

void SettingEditor::forgetTyped() {
  for (QLineEdit* const line : findChildren<QLineEdit*>()) {
    line->setModified(false);
  }
  show_(text_);
}

void SettingEditor::emitEdited(const std::string& text) {
  for (QLineEdit* const line : findChildren<QLineEdit*>()) {
    line->setModified(false);
  }
  if (text != text_) {
    text_ = text;
    Q_EMIT edited(QString::fromStdString(spec_.key), QString::fromStdString(text));
  }
}

QWidget* SettingEditor::makeBool() {
  auto* box = new QCheckBox(this);
  show_ = [this, box](const std::string& text) {
    const QSignalBlocker blocker(box);
    box->setChecked(valueOr<bool>(spec_, text, false));
  };
  connect(box, &QCheckBox::toggled, this, [this](bool on) { emitEdited(scenegraph::settingText(on)); });
  return box;
}

QWidget* SettingEditor::makeInt() {
  auto* box = new QSpinBox(this);
  box->setKeyboardTracking(false);
  box->setRange(static_cast<int>(isBounded(spec_) ? std::clamp(spec_.minimum, kLowestInt, kHighestInt) : kLowestInt),
                static_cast<int>(isBounded(spec_) ? std::clamp(spec_.maximum, kLowestInt, kHighestInt) : kHighestInt));
  show_ = [this, box](const std::string& text) {
    const QSignalBlocker blocker(box);
    box->setValue(static_cast<int>(
        std::clamp(static_cast<double>(valueOr<std::int64_t>(spec_, text, 0)), kLowestInt, kHighestInt)));
  };
  connect(box, &QSpinBox::valueChanged, this,
          [this](int value) { emitEdited(scenegraph::settingText(std::int64_t{value})); });
  return box;
}

QWidget* SettingEditor::makeDouble() {
  auto* holder = new QWidget(this);
  auto* layout = new QHBoxLayout(holder);
  layout->setContentsMargins(0, 0, 0, 0);
  const double lowest = isBounded(spec_) ? spec_.minimum : -kLargestNumber;
  const double highest = isBounded(spec_) ? spec_.maximum : kLargestNumber;
  auto* box = new NumberBox(lowest, highest, holder);
  QSlider* slider = nullptr;
  if (isBounded(spec_) && highest - lowest <= kLongestSliderRange) {
    slider = new QSlider(Qt::Horizontal, holder);
    slider->setRange(0, kSliderSteps);
    slider->setMinimumWidth(40);
    layout->addWidget(slider, 1);
    connect(slider, &QSlider::valueChanged, box, [=](int step) {
      box->setValue(roundedTo(lowest + (highest - lowest) * step / kSliderSteps, highest - lowest));
    });
  }
  layout->addWidget(box, 1);
  const auto move_slider = [=](double value) {
    if (slider != nullptr) {
      const QSignalBlocker blocker(slider);
      slider->setValue(static_cast<int>(std::lround((value - lowest) / (highest - lowest) * kSliderSteps)));
    }
  };
  show_ = [this, box, move_slider](const std::string& text) {
    const QSignalBlocker blocker(box);
    box->setValue(valueOr<double>(spec_, text, 0.0));
    move_slider(box->value());
  };
  connect(box, &QDoubleSpinBox::valueChanged, this, [this, move_slider](double value) {
    move_slider(value);
    emitEdited(scenegraph::settingText(value));
  });
  return holder;
}

QWidget* SettingEditor::makeChoice() {
  auto* box = new QComboBox(this);
  for (const std::string& choice : spec_.choices) {
    box->addItem(QString::fromStdString(choice));
  }
  // Of many choices one is found by typing a part of it.
  box->setEditable(!spec_.choices_only || spec_.choices.size() > kFewChoices);
  box->setInsertPolicy(QComboBox::NoInsert);
  box->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  if (box->isEditable()) {
    box->completer()->setCompletionMode(QCompleter::PopupCompletion);
    box->completer()->setFilterMode(Qt::MatchContains);
    box->completer()->setCaseSensitivity(Qt::CaseInsensitive);
  }
  show_ = [box](const std::string& text) {
    const QSignalBlocker blocker(box);
    const QString wanted = QString::fromStdString(text);
    const int index = box->findText(wanted);
    box->setCurrentIndex(index);
    if (index < 0 && box->isEditable()) {
      box->setEditText(wanted);
    }
  };
  connect(box, &QComboBox::textActivated, this, [this](const QString& text) { emitEdited(text.toStdString()); });
  if (box->isEditable()) {
    connect(box->lineEdit(), &QLineEdit::returnPressed, this, [this, box] {
      const QCompleter& found = *box->completer();
      if (spec_.choices_only && box->findText(box->currentText()) < 0 && found.completionCount() > 0) {
        box->setEditText(found.currentCompletion());  // the first of those that are shown
      }
    });
    connect(box->lineEdit(), &QLineEdit::editingFinished, this, [this, box] {
      if (spec_.choices_only && box->findText(box->currentText()) < 0) {
        show_(text_);  // half a name is none
      }
      emitEdited(box->currentText().toStdString());
    });
  }
  return box;
}

QWidget* SettingEditor::makeText() {
  auto* edit = new QLineEdit(this);
  show_ = [edit](const std::string& text) {
    if (!(edit->hasFocus() && edit->isModified())) {
      edit->setText(QString::fromStdString(text));
    }
  };
  connect(edit, &QLineEdit::editingFinished, this, [this, edit] { emitEdited(edit->text().toStdString()); });
  return edit;
}

QWidget* SettingEditor::makeColor() {
  auto* button = new QPushButton(this);
  show_ = [this, button](const std::string& text) {
    const QColor color = toQColor(valueOr(spec_, text, scenegraph::Color{}));
    QPixmap swatch(28, 12);
    swatch.fill(color);
    button->setIcon(QIcon(swatch));
    button->setIconSize(swatch.size());
    button->setText(QString::fromStdString(text));
  };
  connect(button, &QPushButton::clicked, this, [this, button] {
    const QColor chosen = QColorDialog::getColor(toQColor(valueOr(spec_, text_, scenegraph::Color{})), button,
                                                 QString::fromStdString(spec_.label), QColorDialog::ShowAlphaChannel);
    if (chosen.isValid()) {
      const scenegraph::Color color{chosen.redF(), chosen.greenF(), chosen.blueF(), chosen.alphaF()};
      const std::string text = scenegraph::settingText(color);
      show_(text);
      emitEdited(text);
    }
  });
  return button;
}

bool isSameSpecs(const std::vector<SettingSpec>& a, const std::vector<SettingSpec>& b) {
  return std::ranges::equal(a, b, [](const SettingSpec& x, const SettingSpec& y) {
    return x.key == y.key && x.kind == y.kind && x.choices == y.choices && x.choices_only == y.choices_only &&
           x.minimum == y.minimum && x.maximum == y.maximum && x.group == y.group && x.item == y.item;
  });
}

}  // namespace stillframe::viewer
