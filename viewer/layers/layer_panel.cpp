#include "viewer/layers/layer_panel.h"

#include <QHBoxLayout>
#include <QShortcut>
#include <QStyleOptionToolButton>
#include <QStylePainter>
#include <QToolButton>
#include <QVBoxLayout>

#include "viewer/layers/add_layer_menu.h"
#include "viewer/layers/layer_tree.h"

namespace stillframe::viewer {
namespace {

constexpr int kLeastButtonWidth = 24;

/// A button whose text ends in dots where there is no room for it.
class ElidedButton : public QToolButton {
 public:
  using QToolButton::QToolButton;

 protected:
  void paintEvent(QPaintEvent* /*event*/) override {
    QStylePainter painter(this);
    QStyleOptionToolButton option;
    initStyleOption(&option);
    if (width() < sizeHint().width()) {
      option.text = fontMetrics().elidedText(text(), Qt::ElideRight, width() - kLeastButtonWidth / 2);
    }
    painter.drawComplexControl(QStyle::CC_ToolButton, option);
  }
};

}  // namespace

LayerPanel::LayerPanel(QWidget* parent)
    : QWidget(parent), bar_(new QWidget(this)), tree_(new LayerTree(this)), add_menu_(new AddLayerMenu(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  auto* buttons = new QHBoxLayout(bar_);
  buttons->setContentsMargins(2, 1, 2, 1);
  buttons->setSpacing(1);
  layout->addWidget(bar_);
  layout->addWidget(tree_, 1);

  QToolButton* const add = addButton("addLayer", tr("Add"), tr("Add a layer, or a second one of a topic"));
  add->setPopupMode(QToolButton::InstantPopup);
  add->setMenu(add_menu_);
  add->setMinimumWidth(add->sizeHint().width());
  duplicate_ = addButton("duplicateLayer", tr("Duplicate"), tr("A second layer like the selected one (Ctrl+D)"));
  remove_ = addButton("removeLayer", tr("Remove"), tr("Remove the selected layer (Delete)"));
  QToolButton* const times = addButton("drawTimes", tr("Draw times"),
                                       tr("Take the time that each layer needs to be drawn; their rows show it"));
  connect(times, &QToolButton::clicked, this, &LayerPanel::drawTimesRequested);
  buttons->addStretch(1);
  up_ = addButton("moveLayerUp", {}, tr("Move the selected layer up (Ctrl+Up)"));
  up_->setArrowType(Qt::UpArrow);
  down_ = addButton("moveLayerDown", {}, tr("Move the selected layer down (Ctrl+Down)"));
  down_->setArrowType(Qt::DownArrow);

  const auto bindKeys = [this](const QKeySequence& keys, auto action) {
    auto* shortcut = new QShortcut(keys, tree_);
    shortcut->setContext(Qt::WidgetShortcut);
    connect(shortcut, &QShortcut::activated, tree_, action);
  };
  const auto bind = [&](QToolButton* button, const QKeySequence& keys, auto action) {
    connect(button, &QToolButton::clicked, tree_, action);
    bindKeys(keys, action);
  };
  bind(duplicate_, Qt::CTRL | Qt::Key_D, [this] { tree_->duplicateCurrent(); });
  connect(remove_, &QToolButton::clicked, tree_, [this] { tree_->removeCurrent(); });
  bindKeys(Qt::Key_Delete, [this] {
    if (tree_->currentItem() != nullptr && tree_->currentItem()->parent() == nullptr) {  // not from among its settings
      tree_->removeCurrent();
    }
  });
  bind(up_, Qt::CTRL | Qt::Key_Up, [this] { tree_->moveCurrent(-1); });
  bind(down_, Qt::CTRL | Qt::Key_Down, [this] { tree_->moveCurrent(1); });

  connect(add_menu_, &QMenu::aboutToShow, this, [this] { add_menu_->fill(scene_); });
  connect(add_menu_, &AddLayerMenu::chosen, tree_, [this](const QString& id) { tree_->addLayer(id.toStdString()); });
  connect(tree_, &LayerTree::changed, this, &LayerPanel::changed);
  connect(tree_, &LayerTree::refused, this, &LayerPanel::refused);
  connect(tree_, &QTreeWidget::currentItemChanged, this, &LayerPanel::enableButtons);
  enableButtons();
}

QToolButton* LayerPanel::addButton(const char* name, const QString& text, const QString& tip) {
  auto* button = new ElidedButton(bar_);
  button->setObjectName(QLatin1String(name));
  button->setMinimumWidth(kLeastButtonWidth);
  button->setText(text);
  button->setToolTip(tip);
  button->setAutoRaise(true);
  bar_->layout()->addWidget(button);
  return button;
}

void LayerPanel::enableButtons() {
  const bool has_layer = !tree_->currentLayer().empty();
  for (QToolButton* const button : {duplicate_, remove_, up_, down_}) {
    button->setEnabled(has_layer);
  }
}

void LayerPanel::setScene(scenegraph::Scene* scene) {
  scene_ = scene;
  tree_->setScene(scene);
  enableButtons();
}

void LayerPanel::refresh() { tree_->refresh(); }

}  // namespace stillframe::viewer
