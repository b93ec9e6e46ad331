#include "viewer/window/picture_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QMainWindow>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QStatusBar>
#include <QToolButton>
#include <algorithm>
#include <array>
#include <utility>

#include "viewer/layers/legend_overlay.h"
#include "viewer/pick/view_picks.h"
#include "viewer/view/view_panel.h"
#include "viewer/widget/scene_widget.h"
#include "viewer/window/picture_saver.h"
#include "viewer/window/set_later.h"

namespace stillframe::viewer {
namespace {

constexpr int kLargestSide = 16384;
constexpr int kPictureSteps = 1000;
constexpr std::array<QSize, 4> kSizes{QSize(1280, 720), QSize(1920, 1080), QSize(3840, 2160), QSize(7680, 4320)};

QString textOf(QSize size) { return QStringLiteral("%1 x %2").arg(size.width()).arg(size.height()); }

}  // namespace

PictureDialog::PictureDialog(const PictureRequest& shown, QWidget* parent) : QDialog(parent) {
  const QSize shown_px(shown.width_px, shown.height_px);
  setWindowTitle(tr("Picture of the view"));
  auto* form = new QFormLayout(this);
  auto* sizes = new QComboBox(this);
  sizes->setObjectName(QStringLiteral("sizes"));
  sizes->addItem(tr("As shown, %1").arg(textOf(shown_px)), shown_px);
  sizes->addItem(tr("As shown, twice as fine, %1").arg(textOf(shown_px * 2)), shown_px * 2);
  for (const QSize& size : kSizes) {
    sizes->addItem(textOf(size), size);
  }
  form->addRow(tr("&Size"), sizes);
  const auto add_side = [&](const QString& label, const QString& name) {
    auto* box = new QSpinBox(this);
    box->setObjectName(name);
    box->setRange(1, kLargestSide);
    box->setSuffix(tr(" px"));
    form->addRow(label, box);
    return box;
  };
  width_ = add_side(tr("&Width"), QStringLiteral("width"));
  height_ = add_side(tr("&Height"), QStringLiteral("height"));
  const auto add_switch = [&](const QString& label, const char* name, bool is_on) {
    auto* box = new QCheckBox(label, this);
    box->setObjectName(QLatin1String(name));
    box->setChecked(is_on);
    form->addRow(box);
    return box;
  };
  transparent_ = add_switch(tr("&Transparent background"), "transparent", shown.is_transparent);
  legend_ = add_switch(tr("&Legend of the colours"), "withLegend", shown.has_legend);
  picks_ = add_switch(tr("What is &picked and measured"), "withPicks", shown.has_picks);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Save | QDialogButtonBox::Cancel, this);
  buttons->button(QDialogButtonBox::Save)->setText(tr("&Save as..."));
  form->addRow(buttons);
  const auto take = [this, sizes] {
    const QSize size = sizes->currentData().toSize();
    width_->setValue(size.width());
    height_->setValue(size.height());
  };
  connect(sizes, &QComboBox::activated, this, take);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  take();
}

PictureRequest PictureDialog::request() const {
  return {.width_px = width_->value(),
          .height_px = height_->value(),
          .is_transparent = transparent_->isChecked(),
          .has_legend = legend_->isChecked(),
          .has_picks = picks_->isChecked()};
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): kept by the actions
void addPictureActions(QMenu& menu, QMainWindow& window, PictureSaver& saver, std::function<ViewPanel&()> shown_view) {
  const auto ask_for_file = [&window](const QString& kinds) {
    QFileDialog dialog(&window, QObject::tr("Save picture"), {}, kinds);
    dialog.setAcceptMode(QFileDialog::AcceptSave);
    dialog.setDefaultSuffix(QStringLiteral("png"));
    return dialog.exec() == QDialog::Accepted ? dialog.selectedFiles().constFirst() : QString();
  };
  QAction* const of_view = menu.addAction(QObject::tr("Save &picture of the view..."));
  of_view->setObjectName(QStringLiteral("savePicture"));
  of_view->setShortcut(Qt::CTRL | Qt::SHIFT | Qt::Key_P);
  QObject::connect(of_view, &QAction::triggered, &window, [&window, &saver, shown_view, ask_for_file] {
    ViewPanel& panel = shown_view();
    SceneWidget& view = panel.view();
    const QSize size_px = view.size() * view.devicePixelRatioF();
    PictureDialog dialog({.width_px = size_px.width(),
                          .height_px = size_px.height(),
                          .has_legend = panel.legend().isEnabledByUser(),
                          .has_picks = !view.picks().marks().isEmpty()},
                         &window);
    if (dialog.exec() != QDialog::Accepted) {
      return;
    }
    const QString file = ask_for_file(QObject::tr("PNG, 8 bit (*.png);;OpenEXR, linear light with depth (*.exr)"));
    if (!file.isEmpty()) {
      saver.saveView(view, dialog.request(), file);
    }
  });
  QAction* const of_window = menu.addAction(QObject::tr("Save picture of the &window..."));
  of_window->setObjectName(QStringLiteral("saveWindowPicture"));
  of_window->setShortcut(Qt::CTRL | Qt::SHIFT | Qt::Key_W);
  QObject::connect(of_window, &QAction::triggered, &window, [&window, &saver, ask_for_file] {
    const QString file = ask_for_file(QObject::tr("PNG, 8 bit (*.png)"));
    if (!file.isEmpty()) {
      saver.saveWindow(window, file);
    }
  });
  QStatusBar& bar = *window.statusBar();
  auto* const busy = new QProgressBar(&bar);
  busy->setObjectName(QStringLiteral("pictureProgress"));
  busy->setRange(0, kPictureSteps);
  busy->setMaximumSize(120, 14);
  busy->hide();
  bar.addPermanentWidget(busy);
  auto* const cancel = new QToolButton(&bar);
  cancel->setObjectName(QStringLiteral("cancelPicture"));
  cancel->setText(QObject::tr("Cancel"));
  cancel->setToolTip(QObject::tr("Give up the picture that is being saved"));
  cancel->setAutoRaise(true);
  cancel->setMaximumHeight(bar.fontMetrics().height() + 2);  // hidden, it would make the bar higher
  cancel->hide();
  bar.addPermanentWidget(cancel);
  QObject::connect(cancel, &QToolButton::clicked, &saver, &PictureSaver::cancel);
  const auto show_busy = [busy, cancel](bool shown) {
    busy->setVisible(shown);
    cancel->setVisible(shown);
  };
  const auto end = [&saver, show_busy] { show_busy(saver.pending() > 0); };
  QObject::connect(&saver, &PictureSaver::started, &bar, [&bar, busy, show_busy](int width_px, int height_px) {
    bar.showMessage(QObject::tr("Drawing the picture, %1 x %2 pixels").arg(width_px).arg(height_px));
    setLater(*busy, 0);
    show_busy(true);
  });
  QObject::connect(&saver, &PictureSaver::progressed, busy,
                   [busy](double share) { setLater(*busy, static_cast<int>(share * kPictureSteps)); });
  QObject::connect(&saver, &PictureSaver::drawn, &bar, [&bar, busy] {
    bar.showMessage(QObject::tr("Writing the picture"));
    setLater(*busy, 0);
  });
  QObject::connect(&saver, &PictureSaver::cancelled, &bar, [&bar, end] {
    bar.showMessage(QObject::tr("The picture was given up"));
    end();
  });
  QObject::connect(&saver, &PictureSaver::saved, &bar, [&bar, end](const QString& file, int width_px, int height_px) {
    bar.showMessage(QObject::tr("Saved %1, %2 x %3 pixels").arg(file).arg(width_px).arg(height_px));
    end();
  });
  QObject::connect(&saver, &PictureSaver::failed, &bar, [&bar, end] {
    bar.clearMessage();
    end();
  });
}

}  // namespace stillframe::viewer
