#pragma once

#include <QWidget>

#include "scenegraph/layout/xml.h"

namespace stillframe::viewer {

class ViewArea;

/// A window of views that were taken out of the main one. Closing it asks for the views to be closed. GUI thread.
class ViewWindow : public QWidget {
  Q_OBJECT

 public:
  explicit ViewWindow(QWidget* parent = nullptr);

  [[nodiscard]] ViewArea& area() noexcept { return *area_; }
  /// What is unknown in the element that the window was restored from.
  scenegraph::XmlElement source;

 Q_SIGNALS:
  void closed();

 protected:
  void closeEvent(QCloseEvent* event) override;

 private:
  ViewArea* area_ = nullptr;
};

}  // namespace stillframe::viewer
