// Pictures of views and of the window, as files.
#include <gtest/gtest.h>
#include <png.h>

#include <QAction>
#include <QApplication>
#include <QFileInfo>
#include <QMenu>
#include <QProgressBar>
#include <QSpinBox>
#include <QStatusBar>
#include <QTemporaryDir>
#include <QTimer>
#include <QToolButton>
#include <algorithm>

#include "tests/viewer/open_window.h"
#include "tests/viewer/viewer_support.h"
#include "viewer/pick/view_picks.h"
#include "viewer/time/time_bar.h"
#include "viewer/view/view_panel.h"
#include "viewer/window/message_bar.h"
#include "viewer/window/picture_dialog.h"
#include "viewer/window/picture_saver.h"

namespace stillframe::viewer {
namespace {

using test::settle;
using test::waitFor;

class SavedPictures : public test::OpenWindowTest {
 protected:
  /// The menu's entries, and what they show in the status bar, once more: for saver_.
  void addMenu() {
    addPictureActions(menu_, *window_, saver_, [this]() -> ViewPanel& { return *window_->views().front(); });
  }
  void finish() {
    ASSERT_TRUE(waitFor([this] { return saver_.pending() == 0; }));
  }
  [[nodiscard]] QString fileOf(const char* name) const { return folder_.filePath(QLatin1String(name)); }
  /// The one of addMenu(); the window has its own before it.
  template <typename Widget>
  [[nodiscard]] Widget& added(const char* name) const {
    return *window_->findChildren<Widget*>(QLatin1String(name)).back();
  }

  QTemporaryDir folder_;
  std::unique_ptr<scenegraph::Executor> executor_ = scenegraph::makeThreadPoolExecutor(1);
  PictureSaver saver_{*executor_};
  QMenu menu_;
};

struct RgbaFile {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bytes;
};

RgbaFile readRgba(const QString& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&image, file.toLocal8Bit().constData()), 0) << file.toStdString();
  image.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr), 0);
  return {static_cast<int>(image.width), static_cast<int>(image.height), std::move(bytes)};
}

TEST_F(SavedPictures, APictureOfTheViewHasAnySizeAndAlpha) {
  open({.files = {"robot.mcap"}, .time = "+1"});
  QStringList saved;
  QObject::connect(&saver_, &PictureSaver::saved, &saver_, [&](const QString& file) { saved << file; });
  QString error;
  QObject::connect(&saver_, &PictureSaver::failed, &saver_, [&](const QString& message) { error = message; });
  const QImage before = view().grabFramebuffer();

  saver_.saveView(view(), {.width_px = 700, .height_px = 300, .is_transparent = true}, fileOf("clear.png"));
  saver_.saveView(view(), {.width_px = 64, .height_px = 64}, fileOf("solid.png"));
  saver_.saveView(view(), {.width_px = 64, .height_px = 64}, fileOf("light.exr"));
  EXPECT_EQ(saver_.pending(), 3);
  EXPECT_TRUE(saved.isEmpty()) << "the window has its time to say so";
  finish();
  EXPECT_EQ(saved.size(), 3) << error.toStdString();
  const RgbaFile clear = readRgba(fileOf("clear.png"));
  EXPECT_EQ(clear.width, 700);
  EXPECT_EQ(clear.height, 300);
  std::size_t nothing = 0;
  std::size_t opaque = 0;
  for (std::size_t i = 3; i < clear.bytes.size(); i += 4) {
    nothing += clear.bytes[i] == 0 ? 1U : 0U;
    opaque += clear.bytes[i] == 255 ? 1U : 0U;
  }
  EXPECT_GT(nothing, 50'000U);
  EXPECT_GT(opaque, 1'000U);
  const RgbaFile solid = readRgba(fileOf("solid.png"));
  for (std::size_t i = 3; i < solid.bytes.size(); i += 4) {
    ASSERT_EQ(solid.bytes[i], 255);
  }
  EXPECT_GT(QFileInfo(fileOf("light.exr")).size(), 1000);

  settle();
  EXPECT_EQ(view().grabFramebuffer(), before) << "the view goes on as it was";
  EXPECT_EQ(view().glMessages(), 0U);
  EXPECT_EQ(view().takePicture({.width_px = 1'000'000, .height_px = 10}).error().code, "TooLarge");
  EXPECT_EQ(view().takePicture({.width_px = 0, .height_px = 10}).error().code, "BadSize");
  EXPECT_EQ(SceneWidget().takePicture({}).error().code, "NotDrawn");
  saver_.saveView(view(), {.width_px = 8, .height_px = 8}, fileOf("no/such/a.png"));
  finish();
  EXPECT_TRUE(error.contains(QStringLiteral("no/such/a.png")));
}

TEST_F(SavedPictures, ThatAPictureIsDrawnIsShownBeforeItIsDrawn) {
  open({.files = {"robot.mcap"}, .time = "+1"});
  addMenu();
  const auto& bar = added<QProgressBar>("pictureProgress");
  bool was_painted = false;
  QObject::connect(&saver_, &PictureSaver::drawn, window_.get(), [&] { was_painted = bar.isVisible(); });
  saver_.saveView(view(), {.width_px = 2000, .height_px = 1000}, fileOf("large.png"));
  EXPECT_TRUE(bar.isVisible());
  EXPECT_TRUE(window_->statusBar()->currentMessage().contains(QStringLiteral("2000 x 1000")));
  finish();
  EXPECT_TRUE(was_painted);
  EXPECT_FALSE(bar.isVisible());
  saver_.saveView(view(), {.width_px = 0, .height_px = 1}, fileOf("none.png"));
  finish();
  EXPECT_FALSE(bar.isVisible());
}

TEST_F(SavedPictures, AHugePictureIsTakenInStepsAndTheViewStandsStillMeanwhile) {
  open({.files = {"robot.mcap"}, .time = "+1"});
  for (const bool is_transparent : {false, true}) {
    const PictureRequest request{.width_px = 4000, .height_px = 1000, .is_transparent = is_transparent};
    const auto whole = view().takePicture(request);
    ASSERT_TRUE(whole);
    settle();
    ASSERT_TRUE(view().beginPicture(request));
    EXPECT_EQ(view().beginPicture(request).error().code, "NotDrawn") << "one at a time";
    const auto frames = view().framesDrawn();
    std::vector<double> shares;
    while (shares.empty() || shares.back() < 1.0) {
      const auto share = view().continuePicture();
      ASSERT_TRUE(share);
      shares.push_back(*share);
      view().setTime(tf::TimePoint{9'000'000'000});
      view().update();
      QApplication::processEvents();
    }
    EXPECT_GT(shares.size(), 8U);
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_EQ(view().framesDrawn(), frames);
    EXPECT_FALSE(view().pick({10.0, 10.0}));
    const scenegraph::Picture stepped = view().endPicture();
    EXPECT_TRUE(stepped.rgba == whole->rgba);
    EXPECT_TRUE(stepped.depth_m == whole->depth_m);
    ASSERT_TRUE(waitFor([&] { return view().framesDrawn() > frames; })) << "the view goes on";
    EXPECT_EQ(view().scene()->time(), tf::TimePoint{9'000'000'000});
    view().setTime(window_->timeBar().time());
    settle();
  }
  EXPECT_EQ(view().continuePicture().error().code, "NotDrawn");
  ASSERT_TRUE(view().beginPicture({.width_px = 64, .height_px = 64}));
  window_->views().front()->setDataset(nullptr, *executor_, {});
  EXPECT_EQ(view().continuePicture().error().code, "NotDrawn");
}

TEST_F(SavedPictures, AHugePictureTellsHowFarItIsAndCanBeGivenUp) {
  open({.files = {"robot.mcap"}, .time = "+1"});
  addMenu();
  const auto& bar = added<QProgressBar>("pictureProgress");
  auto& cancel = added<QToolButton>("cancelPicture");
  std::vector<double> shares;
  int most = 0;
  QObject::connect(&saver_, &PictureSaver::progressed, window_.get(), [&](double share) {
    shares.push_back(share);
    most = std::max(most, bar.value());
  });
  const QString file = fileOf("huge.png");
  saver_.saveView(view(), {.width_px = 3000, .height_px = 1000}, file);
  finish();
  EXPECT_TRUE(QFileInfo::exists(file));
  EXPECT_GT(shares.size(), 12U) << "of drawing and of writing";
  EXPECT_GT(most, 900);
  EXPECT_FALSE(cancel.isVisible());

  // Given up while it is drawn, and while it is written.
  int given_up = 0;
  QObject::connect(&saver_, &PictureSaver::cancelled, window_.get(), [&] { ++given_up; });
  for (const bool is_written : {false, true}) {
    const QString never = fileOf("never.png");
    saver_.saveView(view(), {.width_px = 3000, .height_px = 1000}, never);
    saver_.saveView(view(), {.width_px = 30, .height_px = 10}, never);
    EXPECT_TRUE(cancel.isVisible());
    const auto give_up = [&] {
      cancel.click();
      return true;
    };
    QMetaObject::Connection once;
    if (is_written) {
      once = QObject::connect(&saver_, &PictureSaver::drawn, window_.get(), give_up);
    } else {
      ASSERT_TRUE(waitFor([&, count = shares.size()] { return shares.size() > count + 2; }));
      give_up();
    }
    finish();
    QObject::disconnect(once);
    EXPECT_EQ(given_up, is_written ? 4 : 2);
    EXPECT_FALSE(QFileInfo::exists(never));
    EXPECT_FALSE(cancel.isVisible());
    EXPECT_FALSE(bar.isVisible());
  }
  settle();
  EXPECT_GT(test::drawnPixels(view().grabFramebuffer()), 500) << "the view goes on";
}

TEST_F(SavedPictures, APictureOfTheViewHasItsLegendAndWhatIsMeasured) {
  open();
  ASSERT_TRUE(view().scene()->findLayer("/points")->layer->applySettings({{"color_field", "z"}}));
  scenegraph::PickResult pick{
      .topic = "/points", .layer = {}, .frame = "lidar", .picked = {}, .fixed_frame = "map", .time = {}};
  view().picks().select(pick);
  pick.frame = "map";
  view().picks().measureTo(pick);
  view().requestTick();
  settle();
  PictureRequest request{.width_px = 640, .height_px = 480};
  const auto bare = view().takePicture(request);
  request.has_legend = true;
  const auto legend = view().takePicture(request);
  request.has_legend = false;
  request.has_picks = true;
  const auto picks = view().takePicture(request);
  request.has_legend = true;
  request.is_scene_linear = true;
  const auto linear = view().takePicture(request);
  ASSERT_TRUE(bare && legend && picks && linear);
  const auto differs = [&](const scenegraph::Picture& picture) {
    int count = 0;
    for (std::size_t i = 0; i < bare->rgba.size(); i += 4) {
      count += std::equal(&bare->rgba[i], &bare->rgba[i] + 3, &picture.rgba[i]) ? 0 : 1;
    }
    return count;
  };
  EXPECT_GT(differs(*legend), 5'000);
  EXPECT_GT(differs(*picks), 300);
  EXPECT_LT(differs(*picks), 20'000);
  EXPECT_EQ(linear->rgba, bare->rgba) << "what is for measuring has neither";
  ASSERT_TRUE(view().scene()->findLayer("/points")->layer->applySettings({{"legend", "false"}}));
  request.is_scene_linear = false;
  request.has_picks = false;
  view().requestTick();
  settle();
  EXPECT_EQ(view().takePicture(request)->rgba, bare->rgba) << "the layer's own switch";
}

TEST_F(SavedPictures, APictureOfTheWindowIsAllOfIt) {
  open();
  addMenu();
  settle();
  window_->statusBar()->clearMessage();
  const QRect bar = window_->statusBar()->geometry();
  const QImage before = window_->grab().toImage().copy(bar);
  saver_.saveWindow(*window_, fileOf("window.png"));
  finish();
  const QImage image(fileOf("window.png"));
  EXPECT_EQ(test::drawnPixels(image.copy(bar)), test::drawnPixels(before)) << "nothing is told there of the picture";
  EXPECT_EQ(image.size(), window_->size() * window_->devicePixelRatioF());
  EXPECT_GT(test::drawnPixels(image), 1000);
}

TEST_F(SavedPictures, TheMenuAsksForSizeAndFile) {
  open();
  QTimer::singleShot(0, window_.get(), [&] {
    auto* const dialog = qobject_cast<PictureDialog*>(QApplication::activeModalWidget());
    ASSERT_NE(dialog, nullptr);
    dialog->findChild<QSpinBox*>(QStringLiteral("width"))->setValue(123);
    EXPECT_EQ(dialog->request().width_px, 123);
    EXPECT_FALSE(dialog->request().is_transparent);
    EXPECT_TRUE(dialog->request().has_legend) << "as the view shows it";
    EXPECT_FALSE(dialog->request().has_picks) << "there are none";
    dialog->reject();
  });
  window_->findChild<QAction*>(QStringLiteral("savePicture"))->trigger();
  EXPECT_EQ(window_->messageBar().text(), QString());
}

}  // namespace
}  // namespace stillframe::viewer
