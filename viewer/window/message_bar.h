#pragma once

#include <QFrame>

#include "scenegraph/status.h"

class QLabel;

namespace stillframe::viewer {

/// One clear line above the views: what went wrong, until it is closed or replaced. GUI thread.
class MessageBar : public QFrame {
  Q_OBJECT

 public:
  explicit MessageBar(QWidget* parent = nullptr);
  void showMessage(scenegraph::StatusLevel level, const QString& text);
  void warn(const QString& text) { showMessage(scenegraph::StatusLevel::Warn, text); }
  /// "" when hidden.
  [[nodiscard]] QString text() const;

 private:
  QLabel* label_ = nullptr;
};

}  // namespace stillframe::viewer
