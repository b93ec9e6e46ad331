#include "viewer/window/dataset_loader.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

#include "tests/viewer/viewer_support.h"
#include "viewer/widget/update_gate.h"

namespace stillframe::viewer {
namespace {

using test::settle;
using test::waitFor;

/// What a loader said, in order.
struct Listener {
  explicit Listener(DatasetLoader& loader) {
    QObject::connect(&loader, &DatasetLoader::opened, &loader,
                     [this](const std::shared_ptr<scenegraph::Dataset>& opened) {
                       dataset = opened;
                       heard += "opened ";
                     });
    QObject::connect(&loader, &DatasetLoader::progressed, &loader, [this](double value) { fraction = value; });
    QObject::connect(&loader, &DatasetLoader::loaded, &loader, [this] { heard += "loaded "; });
    QObject::connect(&loader, &DatasetLoader::failed, &loader,
                     [this](const scenegraph::Status& status) { heard += "failed:" + status.code + " "; });
  }
  std::shared_ptr<scenegraph::Dataset> dataset;
  double fraction = -1.0;
  std::string heard;
};

/// A recording whose load waits until it is let go or cancelled.
struct SlowRecording {
  std::atomic<bool> may_end = false;
  std::atomic<bool> was_stopped = false;

  OpenedRecording open() {
    return {std::make_shared<scenegraph::Dataset>("slow"), [this](const std::function<bool(double)>& progress) {
              while (!may_end) {
                if (!progress(0.5)) {
                  was_stopped = true;
                  return;
                }
                std::this_thread::yield();
              }
            }};
  }
};

TEST(DatasetLoader, OpensThenLoadsWithProgress) {
  DatasetLoader loader(test::fakeOpener());
  Listener listener(loader);
  loader.open({"good.mcap"});
  EXPECT_TRUE(loader.isBusy());
  ASSERT_TRUE(waitFor([&] { return listener.heard.ends_with("loaded "); }));
  EXPECT_EQ(listener.heard, "opened loaded ");
  EXPECT_DOUBLE_EQ(listener.fraction, 1.0);
  EXPECT_NE(listener.dataset, nullptr);
  EXPECT_FALSE(loader.isBusy());
}

TEST(DatasetLoader, TellsWhyAFileIsRefused) {
  DatasetLoader loader(test::fakeOpener());
  Listener listener(loader);
  loader.open({"bad.mcap"});
  ASSERT_TRUE(waitFor([&] { return !listener.heard.empty(); }));
  settle();
  EXPECT_EQ(listener.heard, "failed:NotMcap ");
  EXPECT_FALSE(loader.isBusy());
}

TEST(DatasetLoader, BadFileLeavesTheLoadUnderWayAlone) {
  SlowRecording slow;
  DatasetLoader loader([&](const auto& files) -> std::expected<OpenedRecording, scenegraph::Status> {
    return files.at(0) == "slow" ? slow.open() : test::fakeOpener()(files);
  });
  Listener listener(loader);
  loader.open({"slow"});
  ASSERT_TRUE(waitFor([&] { return listener.heard == "opened "; }));
  loader.open({"bad.mcap"});
  ASSERT_TRUE(waitFor([&] { return listener.heard == "opened failed:NotMcap "; }));
  EXPECT_TRUE(loader.isBusy());
  EXPECT_FALSE(slow.was_stopped);
  slow.may_end = true;
  ASSERT_TRUE(waitFor([&] { return listener.heard == "opened failed:NotMcap loaded "; }));
}

TEST(DatasetLoader, AnotherRecordingStopsTheLoadUnderWay) {
  SlowRecording slow;
  DatasetLoader loader([&](const auto& files) -> std::expected<OpenedRecording, scenegraph::Status> {
    return files.at(0) == "slow" ? slow.open() : test::fakeOpener()(files);
  });
  Listener listener(loader);
  loader.open({"slow"});
  ASSERT_TRUE(waitFor([&] { return listener.heard == "opened "; }));
  loader.open({"good.mcap"});
  ASSERT_TRUE(waitFor([&] { return listener.heard.ends_with("loaded "); }));
  EXPECT_TRUE(waitFor([&] { return slow.was_stopped.load(); }));
  EXPECT_EQ(listener.heard, "opened opened loaded ");
  EXPECT_EQ(listener.dataset->name(), "test");
}

TEST(DatasetLoader, EndsWithALoadUnderWay) {
  SlowRecording slow;
  {
    DatasetLoader loader(
        [&](const auto&) -> std::expected<OpenedRecording, scenegraph::Status> { return slow.open(); });
    Listener listener(loader);
    loader.open({"slow"});
    ASSERT_TRUE(waitFor([&] { return listener.fraction == 0.5; }));
  }
  EXPECT_TRUE(slow.was_stopped);
}

TEST(DatasetLoader, ReportsAnExceptionOfTheReader) {
  DatasetLoader loader([](const auto&) -> std::expected<OpenedRecording, scenegraph::Status> {
    throw std::runtime_error("out of luck");
  });
  Listener listener(loader);
  loader.open({"any"});
  ASSERT_TRUE(waitFor([&] { return !listener.heard.empty(); }));
  EXPECT_EQ(listener.heard, "failed:OpenFailed ");
}

TEST(UpdateGate, MergesRequestsAndOutlivesItsOwner) {
  int calls = 0;
  std::function<void()> requester;
  {
    UpdateGate gate([&] { ++calls; });
    requester = gate.requester();
    std::thread other([&] {
      for (int i = 0; i < 100; ++i) {
        requester();
      }
    });
    other.join();
    EXPECT_EQ(calls, 0) << "a worker must never run the callback itself";
    settle();
    EXPECT_EQ(calls, 1);
    requester();
  }
  requester();
  settle();
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace stillframe::viewer
