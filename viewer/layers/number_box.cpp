#include "viewer/layers/number_box.h"

#include <QLocale>
#include <algorithm>
#include <cmath>

namespace stillframe::viewer {

double roundedTo(double value, double range) {
  const double unit = std::pow(10.0, std::floor(std::log10(range)) - 3.0);
  const double count = std::round(value / unit);
  constexpr double kMostCount = 1e14;  // beyond, the digits of a double do not reach down to the unit
  return std::isnormal(unit) && std::abs(count) < kMostCount ? QString::number(count * unit, 'g', 15).toDouble()
                                                             : value;
}

NumberBox::NumberBox(double lowest, double highest, QWidget* parent) : QDoubleSpinBox(parent) {
  setKeyboardTracking(false);
  setDecimals(323);  // beyond it a double has no digits: QDoubleSpinBox then rounds nothing
  setRange(lowest, highest);
  setMinimumWidth(70);
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
}

QString NumberBox::textFromValue(double value) const {
  return QLocale::c().toString(value, 'g', QLocale::FloatingPointShortest);
}

QString NumberBox::digits(const QString& text) const {
  return (suffix().isEmpty() || !text.endsWith(suffix()) ? text : text.chopped(suffix().size())).trimmed();
}

double NumberBox::valueFromText(const QString& text) const { return QLocale::c().toDouble(digits(text)); }

/// By a tenth of the number's leading digit, so that each size of number has useful steps.
void NumberBox::stepBy(int steps) {
  const double size = std::abs(value());
  const double step = size > 0.0 ? std::pow(10.0, std::floor(std::log10(size)) - 1.0)
                                 : std::min(0.1, (maximum() / 2.0 - minimum() / 2.0) / 50.0);
  const double there = value() + steps * step;
  setValue(QString::number(there, 'g', 12).toDouble());  // without the digits that adding left over
}

void NumberBox::fixup(QString& text) const {
  bool is_number = false;
  const double value = QLocale::c().toDouble(digits(text), &is_number);
  // What is too large for a double is told as infinity and no number.
  if ((is_number || std::isinf(value)) && !std::isnan(value)) {
    text = textFromValue(std::clamp(value, minimum(), maximum()));
  }
}

QValidator::State NumberBox::validate(QString& text, int& /*position*/) const {
  bool is_number = false;
  const double value = QLocale::c().toDouble(digits(text), &is_number);
  if (is_number) {
    return value >= minimum() && value <= maximum() ? QValidator::Acceptable : QValidator::Intermediate;
  }
  constexpr QLatin1String kLetters("0123456789+-.eE");
  const QString typed = digits(text);
  const bool may_become_one =
      typed.size() < 32 && std::all_of(typed.begin(), typed.end(), [&](QChar c) { return kLetters.contains(c); });
  return may_become_one ? QValidator::Intermediate : QValidator::Invalid;
}

}  // namespace stillframe::viewer
