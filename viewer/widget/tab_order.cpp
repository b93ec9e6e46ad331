#include "viewer/widget/tab_order.h"

#include <QAbstractButton>
#include <QDockWidget>
#include <QLayout>
#include <QMainWindow>
#include <QSplitter>
#include <QToolBar>
#include <QTreeWidget>
#include <QTreeWidgetItemIterator>
#include <vector>

namespace stillframe::viewer {
namespace {

using Chain = std::vector<QWidget*>;

void collect(QWidget& widget, Chain& chain);

void collectLayout(const QLayout& layout, Chain& chain) {
  for (int i = 0; i < layout.count(); ++i) {
    QLayoutItem* const item = layout.itemAt(i);
    if (item->widget() != nullptr) {
      collect(*item->widget(), chain);
    } else if (item->layout() != nullptr) {
      collectLayout(*item->layout(), chain);
    }
  }
}

void collectWindow(const QMainWindow& window, Chain& chain) {
  if (window.centralWidget() != nullptr) {
    collect(*window.centralWidget(), chain);
  }
  for (QToolBar* const bar : window.findChildren<QToolBar*>(Qt::FindDirectChildrenOnly)) {
    collect(*bar, chain);
  }
  for (const QDockWidget* const dock : window.findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly)) {
    if (dock->widget() != nullptr && dock->window() == &window) {
      collect(*dock->widget(), chain);
    }
  }
}

void collect(QWidget& widget, Chain& chain) {
  if (auto* const tree = qobject_cast<QTreeWidget*>(&widget)) {
    chain.push_back(tree);
    for (QTreeWidgetItemIterator row(tree); *row != nullptr; ++row) {
      if (QWidget* const editor = tree->itemWidget(*row, 1)) {
        collect(*editor, chain);
      }
    }
  } else if (const auto* const window = qobject_cast<QMainWindow*>(&widget)) {
    collectWindow(*window, chain);
  } else if (const auto* const splitter = qobject_cast<QSplitter*>(&widget)) {
    for (int i = 0; i < splitter->count(); ++i) {
      collect(*splitter->widget(i), chain);
    }
  } else if ((widget.focusPolicy() & Qt::TabFocus) != 0 || qobject_cast<QAbstractButton*>(&widget) != nullptr) {
    chain.push_back(&widget);
  } else if (widget.layout() != nullptr) {
    collectLayout(*widget.layout(), chain);
  }
}

}  // namespace

void orderTabs(QWidget& root) {
  Chain chain;
  collect(root, chain);
  for (std::size_t i = 1; i < chain.size(); ++i) {
    QWidget::setTabOrder(chain[i - 1], chain[i]);
  }
}

}  // namespace stillframe::viewer
