#pragma once

#include <QWidget>
#include <vector>

class QToolButton;

namespace stillframe::viewer {

/// A row of controls that is narrow where it must be: buttons that can be spared go, one after the other, as far as
/// there is no room for all, and come back in turn. Who offers them meanwhile asks sparedNow(). GUI thread.
class NarrowBar : public QWidget {
 public:
  using QWidget::QWidget;

  /// Of its layout; the first go first. One that somebody else has hidden stays so.
  void spare(std::vector<QToolButton*> buttons) { spared_ = std::move(buttons); }
  [[nodiscard]] const std::vector<QToolButton*>& sparedNow() const noexcept { return gone_; }
  /// Without those that can be spared.
  [[nodiscard]] QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  [[nodiscard]] int widthOf(const QToolButton& button) const;

  std::vector<QToolButton*> spared_;
  std::vector<QToolButton*> gone_;  // the last comes back first
};

}  // namespace stillframe::viewer
