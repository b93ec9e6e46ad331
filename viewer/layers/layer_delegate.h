#pragma once

#include <QIcon>
#include <QStyledItemDelegate>

class QTreeWidget;

namespace stillframe::viewer {

/// Lets rows of a LayerTree grow with their sentences (QTreeView itself reckons with one line), and lets the user edit
/// nothing but the name of a layer.
class LayerDelegate : public QStyledItemDelegate {
  Q_OBJECT

 public:
  /// Role of a row that is a sentence, over both columns.
  static constexpr int kIsNote = Qt::UserRole + 1;

  explicit LayerDelegate(QTreeWidget& tree);
  [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  [[nodiscard]] QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& option,
                                      const QModelIndex& index) const override;

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override;

 private:
  QTreeWidget& tree_;
};

/// A dot in the colour of a scenegraph::StatusLevel, grey for -1 (hidden).
[[nodiscard]] QIcon statusIcon(int level);

}  // namespace stillframe::viewer
