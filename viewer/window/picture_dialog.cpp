#include "viewer/window/picture_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QMainWindow>
#include <QMenu>
#include <QPushButton>
#include <QSpinBox>
#include <QStatusBar>
#include <algorithm>
#include <array>
#include <utility>

#include "viewer/widget/scene_widget.h"
#include "viewer/window/picture_saver.h"

namespace stillframe::viewer {
namespace {

constexpr int kLargestSide = 16384;
constexpr std::array<QSize, 4> kSizes{QSize(1280, 720), QSize(1920, 1080), QSize(3840, 2160), QSize(7680, 4320)};

QString textOf(QSize size) { return QStringLiteral("%1 x %2").arg(size.width()).arg(size.height()); }

}  // namespace

PictureDialog::PictureDialog(QSize shown_px, QWidget* parent) : QDialog(parent) {
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
  transparent_ = new QCheckBox(tr("&Transparent background"), this);
  transparent_->setObjectName(QStringLiteral("transparent"));
  form->addRow(transparent_);
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
  return {.width_px = width_->value(), .height_px = height_->value(), .is_transparent = transparent_->isChecked()};
}

void addPictureActions(QMenu& menu, QMainWindow& window, PictureSaver& saver,
                       std::function<SceneWidget&()> shown_view) {
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
    SceneWidget& view = shown_view();
    PictureDialog dialog(view.size() * view.devicePixelRatioF(), &window);
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
  QObject::connect(&saver, &PictureSaver::started, &bar,
                   [&bar] { bar.showMessage(QObject::tr("Writing the picture")); });
  QObject::connect(&saver, &PictureSaver::saved, &bar, [&bar](const QString& file, int width_px, int height_px) {
    bar.showMessage(QObject::tr("Saved %1, %2 x %3 pixels").arg(file).arg(width_px).arg(height_px));
  });
}

}  // namespace stillframe::viewer
