#include "viewer/view/narrow_bar.h"

#include <QLayout>
#include <QToolButton>

namespace stillframe::viewer {

int NarrowBar::widthOf(const QToolButton& button) const { return button.sizeHint().width() + layout()->spacing(); }

QSize NarrowBar::minimumSizeHint() const {
  QSize least = layout()->minimumSize();
  for (const QToolButton* const button : spared_) {
    least.rwidth() -= button->isHidden() ? 0 : widthOf(*button);
  }
  return least;
}

void NarrowBar::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  int needed = layout()->minimumSize().width();
  for (QToolButton* const button : spared_) {
    if (needed > width() && !button->isHidden()) {
      needed -= widthOf(*button);
      gone_.push_back(button);
      button->hide();
    }
  }
  while (!gone_.empty() && needed + widthOf(*gone_.back()) <= width()) {
    needed += widthOf(*gone_.back());
    gone_.back()->show();
    gone_.pop_back();
  }
}

}  // namespace stillframe::viewer
