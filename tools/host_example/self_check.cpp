#include "self_check.h"

#include <QApplication>
#include <QComboBox>
#include <QElapsedTimer>
#include <QFile>
#include <QImage>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QStatusBar>
#include <QTemporaryDir>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "host_window.h"
#include "plot.h"
#include "viewer/view/view_panel.h"
#include "viewer/widget/scene_widget.h"

namespace host_example {
namespace {

using stillframe::tf::TimePoint;
using stillframe::viewer::SceneDock;
using stillframe::viewer::SceneWidget;

constexpr qint64 kPatience_ms = 20'000;

/// Runs the event loop until `condition` holds.
bool waitFor(const std::function<bool()>& condition) {
  QElapsedTimer waited;
  waited.start();
  while (!condition()) {
    if (waited.elapsed() > kPatience_ms) {
      return false;
    }
    QApplication::processEvents(QEventLoop::AllEvents, 20);
  }
  return true;
}

/// Pixels that differ from the upper left one by more than a little.
int drawnPixels(const QImage& image) {
  int drawn = 0;
  const QRgb ground = image.pixel(0, 0);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QRgb pixel = image.pixel(x, y);
      drawn += std::abs(qRed(pixel) - qRed(ground)) + std::abs(qGreen(pixel) - qGreen(ground)) > 20 ? 1 : 0;
    }
  }
  return drawn;
}

class Check {
 public:
  explicit Check(HostWindow& window) : window_(window) {}

  int run() {
    expect(waitFor([&] { return allDrawn(); }), "both docks draw");
    expect(waitFor([&] { return window_.time().ns > 500'000'000 && docksAreAt(window_.time()); }),
           "the docks follow the newest edge while the host is live");
    window_.setGrowing(false);
    seekInThePlot();
    stepInADock();
    pickInADock();
    showEveryValue();
    saveAndRestore();
    refuseABrokenLayout();
    tellOfFiles();
    for (SceneDock* const dock : window_.docks()) {
      expect(dock->panel().view().glMessages() == 0, "OpenGL has nothing to say");
      expect(drawnPixels(pictureOf(*dock)) > 500, "the docks show the robot and its room");
    }
    if (failures_ == 0) {
      std::puts("ok");
    }
    return failures_ == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  }

 private:
  void expect(bool holds, const char* what) {
    if (!holds) {
      std::fprintf(stderr, "host_example: not so: %s\n", what);
      ++failures_;
    }
  }
  bool allDrawn() {
    for (SceneDock* const dock : window_.docks()) {
      if (dock->panel().view().framesDrawn() == 0) {
        return false;
      }
    }
    return true;
  }
  bool docksAreAt(TimePoint time) {
    for (SceneDock* const dock : window_.docks()) {
      if (dock->panel().view().scene()->time() != time) {
        return false;
      }
    }
    return true;
  }
  static QImage pictureOf(SceneDock& dock) {
    waitFor([&] { return !dock.panel().view().applyTick() && !dock.panel().view().scene()->isPending(); });
    return dock.panel().view().grabFramebuffer();
  }

  void seekInThePlot() {
    Plot& plot = window_.plot();
    const QPointF middle(plot.width() / 2.0, plot.height() / 2.0);
    QMouseEvent press(QEvent::MouseButtonPress, middle, plot.mapToGlobal(middle), Qt::LeftButton, Qt::LeftButton,
                      Qt::NoModifier);
    QApplication::sendEvent(&plot, &press);
    expect(!window_.isLive(), "a click into the plot leaves the newest edge");
    expect(window_.time() == plot.timeAt(middle.x()), "the tracker goes to the click");
    expect(waitFor([&] { return docksAreAt(window_.time()); }), "both docks go along");
  }

  void stepInADock() {
    const TimePoint before = window_.time();
    SceneWidget& view = window_.docks()[1]->panel().view();
    view.activateWindow();
    view.setFocus();
    waitFor([&] { return view.hasFocus(); });
    Q_EMIT window_.docks()[1]->seekRequested(TimePoint{before.ns + 50'000'000});
    expect(window_.time().ns == before.ns + 50'000'000, "a dock asks for another time and gets it");
    expect(waitFor([&] { return docksAreAt(window_.time()); }), "both docks go there");
  }

  QString told() const { return window_.statusBar()->currentMessage(); }

  void pickInADock() {
    SceneDock& dock = *window_.docks()[0];
    dock.panel().view().setSmoothMoves(false);  // there at once
    dock.panel().view().frameOrigin("base_link");
    pictureOf(dock);
    const QPointF middle(dock.panel().view().width() / 2.0, dock.panel().view().height() / 2.0);
    for (const QEvent::Type type : {QEvent::MouseButtonPress, QEvent::MouseButtonRelease}) {
      QMouseEvent click(type, middle, dock.panel().view().mapToGlobal(middle), Qt::LeftButton,
                        type == QEvent::MouseButtonPress ? Qt::LeftButton : Qt::NoButton, Qt::NoModifier);
      QApplication::sendEvent(&dock.panel().view(), &click);
    }
    expect(waitFor([&] { return told().contains(QStringLiteral(" at ")); }), "the host tells what is clicked");
  }

  void showEveryValue() {
    expect(window_.values().count() >= 11, "every number of the data can be plotted");
    for (int i = 0; i < window_.values().count(); ++i) {
      window_.values().setCurrentIndex(i);
      expect(drawnPixels(window_.plot().grab().toImage()) > 50, "the plot draws a curve");
    }
  }

  void saveAndRestore() {
    SceneWidget& view = window_.docks()[0]->panel().view();
    view.setFixedFrame("odom");
    view.setCameraKind(stillframe::scenegraph::CameraKind::TopDownOrtho);
    view.scene()->findLayer("grid")->layer->setVisible(false);
    view.applyTick();
    auto viewpoint = view.camera().state();
    viewpoint.camera.top_down.vertical_extent_m = 9.0;
    view.setViewpoint(viewpoint);
    const QString saved = window_.layoutText();
    const QImage picture = pictureOf(*window_.docks()[0]);
    view.setFixedFrame("map");
    view.setCameraKind(stillframe::scenegraph::CameraKind::Orbit);
    view.scene()->findLayer("grid")->layer->setVisible(true);
    expect(pictureOf(*window_.docks()[0]) != picture, "another view is another picture");
    expect(window_.layoutText() != saved, "and another layout");
    expect(window_.restoreLayout(saved), "a saved layout is restored");
    expect(pictureOf(*window_.docks()[0]) == picture, "with the picture it had");
    expect(window_.layoutText() == saved, "and saved again byte for byte");
  }

  void refuseABrokenLayout() {
    const QString saved = window_.layoutText();
    QString broken = saved;
    broken.replace(QStringLiteral("Scene3DDock version=\"1\""), QStringLiteral("Scene3DDock version=\"99\""));
    broken.replace(QStringLiteral(" version=\"1\""), QStringLiteral(" version=\"99\""));
    expect(broken != saved && !window_.restoreLayout(broken), "a layout of another version is refused");
    expect(window_.docks()[0]->message().contains(QStringLiteral("99")), "the dock says why");
    expect(window_.layoutText() == saved, "nothing is lost by it");
  }

  void tellOfFiles() {
    const QTemporaryDir folder;
    const QString saved = window_.layoutText();
    window_.saveLayoutTo(folder.filePath(QStringLiteral("layout.xml")));
    window_.openLayout(folder.filePath(QStringLiteral("layout.xml")));
    expect(window_.layoutText() == saved, "a layout comes back from its file");
    window_.openLayout(folder.path());
    expect(told().startsWith(folder.path()), "a folder given as a layout is told");
    window_.saveLayoutTo(folder.path());
    expect(told().startsWith(folder.path()), "and so is what cannot be written");
    QFile rubbish(folder.filePath(QStringLiteral("rubbish.xml")));
    expect(rubbish.open(QIODevice::WriteOnly) && rubbish.write("rubbish") > 0, "a file can be written");
    rubbish.close();
    window_.openLayout(rubbish.fileName());
    expect(told().startsWith(rubbish.fileName()), "rubbish given as a layout is told");
    expect(window_.layoutText() == saved, "and nothing is lost by any of it");
  }

  HostWindow& window_;
  int failures_ = 0;
};

}  // namespace

int checkHost(HostWindow& window) { return Check(window).run(); }

}  // namespace host_example
