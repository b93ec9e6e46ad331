#include "viewer/layers/setting_editor.h"

#include <QCheckBox>
#include <QColorDialog>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <variant>

namespace stillframe::viewer {
namespace {

using scenegraph::SettingKind;
using scenegraph::SettingSpec;

constexpr int kSliderSteps = 1000;
constexpr double kLongestSliderRange = 100.0;
constexpr double kLowestInt = std::numeric_limits<int>::min();
constexpr double kHighestInt = std::numeric_limits<int>::max();

bool isBounded(const SettingSpec& spec) { return spec.minimum < spec.maximum; }

template <typename T>
T valueOr(const SettingSpec& spec, const std::string& text, T fallback) {
  const auto value = scenegraph::parseSetting(spec, text);
  const T* typed = value ? std::get_if<T>(&*value) : nullptr;
  return typed == nullptr ? fallback : *typed;
}

/// Shows 2 as "2", not as "2.0000".
class NumberBox : public QDoubleSpinBox {
 public:
  using QDoubleSpinBox::QDoubleSpinBox;
  [[nodiscard]] QString textFromValue(double value) const override { return locale().toString(value, 'g', 7); }
};

QColor toQColor(const scenegraph::Color& color) { return QColor::fromRgbF(color.r, color.g, color.b, color.a); }

}  // namespace

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
  setFocusProxy(editor);
  show_(text_);
}

void SettingEditor::setText(const std::string& text) {
  if (text == text_) {
    return;
  }
  text_ = text;
  show_(text_);
}

void SettingEditor::emitEdited(const std::string& text) {
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
  auto* box = new NumberBox(holder);
  box->setKeyboardTracking(false);
  box->setDecimals(6);
  box->setGroupSeparatorShown(false);
  box->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  const double lowest = isBounded(spec_) ? spec_.minimum : -1e12;
  const double highest = isBounded(spec_) ? spec_.maximum : 1e12;
  box->setRange(lowest, highest);
  box->setMinimumWidth(70);
  box->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  QSlider* slider = nullptr;
  if (isBounded(spec_) && highest - lowest <= kLongestSliderRange) {
    slider = new QSlider(Qt::Horizontal, holder);
    slider->setRange(0, kSliderSteps);
    slider->setMinimumWidth(40);
    layout->addWidget(slider, 1);
    connect(slider, &QSlider::valueChanged, box,
            [=](int step) { box->setValue(lowest + (highest - lowest) * step / kSliderSteps); });
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
  box->setEditable(!spec_.choices_only);
  box->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
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
    connect(box->lineEdit(), &QLineEdit::editingFinished, this,
            [this, box] { emitEdited(box->currentText().toStdString()); });
  }
  return box;
}

QWidget* SettingEditor::makeText() {
  auto* edit = new QLineEdit(this);
  show_ = [edit](const std::string& text) {
    if (!edit->hasFocus()) {
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
           x.minimum == y.minimum && x.maximum == y.maximum;
  });
}

}  // namespace stillframe::viewer
