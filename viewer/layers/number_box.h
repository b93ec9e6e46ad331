#pragma once

#include <QDoubleSpinBox>

namespace stillframe::viewer {

/// A box for any finite number: shows it with the fewest digits that tell it from its neighbours, 2 as "2" and 1e-9 as
/// "1e-9", and steps by its size. A number beyond its ends becomes the end. GUI thread.
class NumberBox : public QDoubleSpinBox {
  Q_OBJECT

 public:
  NumberBox(double lowest, double highest, QWidget* parent = nullptr);
  [[nodiscard]] QString textFromValue(double value) const override;
  [[nodiscard]] double valueFromText(const QString& text) const override;
  void stepBy(int steps) override;
  [[nodiscard]] QValidator::State validate(QString& text, int& position) const override;
  void fixup(QString& text) const override;

 private:
  [[nodiscard]] QString digits(const QString& text) const;
};

/// To four digits of the range, as far as a double has them: what is dragged in pixels is no more exact.
[[nodiscard]] double roundedTo(double value, double range);

/// What a number box and a slider without bounds reach to.
inline constexpr double kLargestNumber = 1e300;

}  // namespace stillframe::viewer
