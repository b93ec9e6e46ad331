#include "scenegraph/sample_loader.h"

#include <gtest/gtest.h>

#include <deque>
#include <semaphore>

#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

using test::CloudBuilder;
using test::DatasetBuilder;
using namespace tf::literals;

/// Runs jobs only when told to: what a pool does, without its timing.
class ManualExecutor : public Executor {
 public:
  void submit(std::function<void()> job) override { jobs_.push_back(std::move(job)); }
  void submitSpare(std::function<void()> job) override { spare_jobs_.push_back(std::move(job)); }
  /// Runs the spare jobs; how many there were.
  std::size_t idle() {
    const std::size_t count = spare_jobs_.size();
    for (; !spare_jobs_.empty(); spare_jobs_.pop_front()) {
      std::thread(spare_jobs_.front()).join();
    }
    return count;
  }
  void drain() override {
    while (!jobs_.empty()) {
      auto job = std::move(jobs_.front());
      jobs_.pop_front();
      std::thread(std::move(job)).join();  // on another thread, as in a pool
    }
  }
  [[nodiscard]] std::size_t waiting() const { return jobs_.size(); }

 private:
  std::deque<std::function<void()>> jobs_;
  std::deque<std::function<void()>> spare_jobs_;
};

struct Width {
  std::uint32_t width = 0;
  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this); }
};

PointCloud cloudOf(std::uint32_t width) {
  PointCloud cloud;
  cloud.width = width;
  return cloud;
}

std::expected<Width, Status> widthOf(const AnyObject& object, const Entry& /*entry*/) {
  const auto cloud = object.get<PointCloud>();
  if (cloud->width == 666) {
    return std::unexpected(Status{StatusLevel::Error, "MalformedCloud", "the number of the beast"});
  }
  return Width{cloud->width};
}

class SampleLoaderTest : public testing::Test {
 protected:
  SampleLoaderTest() { builder.topic("/points", ObjectType::PointCloud); }

  SampleLoader<Width> loader(Executor& executor) {
    return {context(executor), ObjectType::PointCloud,
            "/points",         "width",
            widthOf,           [](const Width& width) { return width.width > 0; }};
  }
  LayerContext context(Executor& executor) {
    return {*builder.raw(), frames, executor, [this] { ++wakes; }};
  }

  DatasetBuilder builder;
  FrameGraph frames{builder.raw()->transforms()};
  std::unique_ptr<Executor> at_once = makeSynchronousExecutor();
  ManualExecutor later;
  std::atomic<int> wakes = 0;
};

TEST_F(SampleLoaderTest, ShowsTheSampleInForceInTheSameUpdateWhenWorkRunsAtOnce) {
  builder.at(10_s, cloudOf(1)).at(20_s, cloudOf(2));
  auto points = loader(*at_once);
  EXPECT_TRUE(points.update({15_s}));
  ASSERT_NE(points.product(), nullptr);
  EXPECT_EQ(points.product()->width, 1U);
  EXPECT_EQ(points.entry()->log_time.ns, 10_s);
  EXPECT_EQ(points.status().code, "Ok");
  EXPECT_FALSE(points.isPending());
  EXPECT_EQ(wakes, 0) << "the caller has the result already";
}

TEST_F(SampleLoaderTest, DoesNothingWhenATickResolvesToTheSampleShown) {
  builder.at(10_s, cloudOf(1));
  auto points = loader(*at_once);
  EXPECT_TRUE(points.update({15_s}));
  EXPECT_FALSE(points.update({16_s}));
  EXPECT_FALSE(points.update({10_s}));
  EXPECT_EQ(builder.source().decodeCount(), 1U);
}

TEST_F(SampleLoaderTest, SaysThatThereIsNoMessageYetAndWhenTheFirstComes) {
  builder.at(10_s, cloudOf(1));
  auto points = loader(*at_once);
  points.update({10_s});
  EXPECT_TRUE(points.update({9_s}));
  EXPECT_EQ(points.product(), nullptr);
  EXPECT_EQ(points.status().code, "NoMessage");
  EXPECT_NE(points.status().message.find("10.000000000 s"), std::string::npos) << points.status().message;
  EXPECT_TRUE(points.update({10_s}));
  EXPECT_EQ(builder.source().decodeCount(), 1U) << "it is in the cache";
}

TEST_F(SampleLoaderTest, SaysThatTheTopicDoesNotExistUntilItDoes) {
  SampleLoader<Width> points(context(*at_once), ObjectType::PointCloud, "/later", "width", widthOf);
  points.update({10_s});
  EXPECT_EQ(points.status().code, "NoTopic");
  builder.topic("/later", ObjectType::PointCloud).at(5_s, cloudOf(3));
  EXPECT_TRUE(points.update({10_s}));
  EXPECT_EQ(points.product()->width, 3U);
}

TEST_F(SampleLoaderTest, AFailedDecodeClearsTheViewAndIsNeverRetried) {
  builder.at(10_s, cloudOf(1)).failsAt(20_s, "BadChunk").at(30_s, cloudOf(666)).at(40_s, cloudOf(4));
  auto points = loader(*at_once);
  for (int round = 0; round < 3; ++round) {
    points.update({10_s});
    EXPECT_EQ(points.product()->width, 1U);
    EXPECT_TRUE(points.update({20_s}));
    EXPECT_EQ(points.product(), nullptr);
    EXPECT_EQ(points.status().code, "BadChunk");
    EXPECT_EQ(points.status().level, StatusLevel::Error);
    EXPECT_FALSE(points.update({21_s}));
    EXPECT_TRUE(points.update({30_s}));
    EXPECT_EQ(points.product(), nullptr);
    EXPECT_EQ(points.status().code, "MalformedCloud");
    EXPECT_NE(points.status().message.find("/points"), std::string::npos);
    points.update({40_s});
    EXPECT_EQ(points.status().code, "Ok");
  }
  EXPECT_EQ(builder.source().decodeCount(), 4U);
}

TEST_F(SampleLoaderTest, KeepsTheSampleBeforeAndSaysSoWhileWorkIsUnderWay) {
  builder.at(10_s, cloudOf(1)).at(20_s, cloudOf(2));
  auto points = loader(later);
  points.update({10_s});
  EXPECT_EQ(points.product(), nullptr);
  EXPECT_EQ(points.status().code, "Decoding");
  EXPECT_TRUE(points.isPending());
  later.drain();
  EXPECT_EQ(wakes, 1);
  EXPECT_TRUE(points.update({10_s}));
  EXPECT_EQ(points.product()->width, 1U);
  points.update({20_s});
  EXPECT_EQ(points.product()->width, 1U);
  EXPECT_EQ(points.entry()->log_time.ns, 10_s);
  EXPECT_EQ(points.status().code, "Decoding");
  EXPECT_TRUE(points.update({10_s})) << "back again: nothing is under way for what is shown";
  EXPECT_EQ(points.status().code, "Ok");
  EXPECT_FALSE(points.isPending());
}

TEST_F(SampleLoaderTest, ANewerRequestReplacesOneThatWaits) {
  builder.at(10_s, cloudOf(1)).at(20_s, cloudOf(2)).at(30_s, cloudOf(3));
  auto points = loader(later);
  points.update({10_s});
  points.update({20_s});
  points.update({30_s});
  EXPECT_EQ(later.waiting(), 1U);
  later.drain();
  points.update({30_s});
  EXPECT_EQ(points.product()->width, 3U);
  EXPECT_EQ(builder.source().decodeCount(), 1U);
}

TEST_F(SampleLoaderTest, TwoLoadersShareOneProduct) {
  builder.at(10_s, cloudOf(1));
  auto one = loader(*at_once);
  auto two = loader(*at_once);
  one.update({10_s});
  two.update({10_s});
  EXPECT_EQ(one.product(), two.product());
  EXPECT_EQ(builder.source().decodeCount(), 1U);
}

TEST_F(SampleLoaderTest, WorkOutlivesItsLoaderAndItsDatasetAndWakesNobody) {
  ManualExecutor executor;
  {
    DatasetBuilder gone;
    gone.topic("/points", ObjectType::PointCloud).at(10_s, cloudOf(1));
    FrameGraph graph(gone.raw()->transforms());
    SampleLoader<Width> points({*gone.raw(), graph, executor, [this] { ++wakes; }}, ObjectType::PointCloud, "/points",
                               "width", widthOf);
    points.update({10_s});
  }
  executor.drain();
  EXPECT_EQ(wakes, 0);
}

TEST_F(SampleLoaderTest, ReferenceIsTheFirstGoodSampleWhicheverIsVisitedFirst) {
  builder.failsAt(5_s, "BadChunk").at(10_s, cloudOf(0)).at(20_s, cloudOf(2)).at(30_s, cloudOf(3));
  auto points = loader(*at_once);
  points.update({30_s});
  ASSERT_NE(points.reference(), nullptr);
  EXPECT_EQ(points.reference()->width, 2U);
  const std::size_t decoded = builder.source().decodeCount();
  points.update({20_s});
  EXPECT_EQ(points.reference()->width, 2U);
  EXPECT_EQ(builder.source().decodeCount(), decoded) << "it is in the cache";
}

TEST_F(SampleLoaderTest, ReferenceFollowsAStoreThatGrows) {
  auto points = loader(*at_once);
  EXPECT_EQ(points.reference(), nullptr);
  builder.at(10_s, cloudOf(0));
  EXPECT_EQ(points.reference(), nullptr);
  builder.at(20_s, cloudOf(2));
  ASSERT_NE(points.reference(), nullptr);
  EXPECT_EQ(points.reference()->width, 2U);
  builder.at(30_s, cloudOf(3));
  EXPECT_EQ(points.reference()->width, 2U);
  builder.at(15_s, cloudOf(7));  // late, and before the reference
  EXPECT_EQ(points.reference()->width, 7U);
}

TEST_F(SampleLoaderTest, ReferenceComesInTheBackground) {
  builder.at(10_s, cloudOf(5));
  auto points = loader(later);
  EXPECT_EQ(points.reference(), nullptr);
  EXPECT_TRUE(points.isPending());
  later.drain();
  EXPECT_EQ(points.reference()->width, 5U);
  EXPECT_FALSE(points.isPending());
}

/// Clouds whose width is there before all of them is; whole ones are one wider.
class EarlySource : public EntrySource {
 public:
  [[nodiscard]] std::expected<AnyObject, DecodeError> decode(const TopicInfo&, const Entry& entry) const override {
    ++decoded;
    return entry.payload_bytes == 0
               ? std::expected<AnyObject, DecodeError>(std::unexpected(DecodeError{"BadChunk", "its CRC is wrong"}))
               : AnyObject::make(cloudOf(static_cast<std::uint32_t>(entry.payload_bytes) + 1));
  }
  [[nodiscard]] std::optional<EarlyObject> decodeEarly(const TopicInfo&, const Entry& entry) const override {
    PointCloud cloud = cloudOf(static_cast<std::uint32_t>(entry.payload_bytes));
    const auto arrival = std::make_shared<Arrival>();
    arrival->finish(entry.payload_bytes != 0);
    cloud.data.arrival = arrival;
    return EarlyObject{AnyObject::make(cloud), nullptr};
  }
  mutable int decoded = 0;
};

TEST_F(SampleLoaderTest, ConvertsWhatIsNotAllThereOnlyWhereThatIsKnownToWait) {
  const auto source = std::make_shared<EarlySource>();
  TopicInfo info;
  info.name = "/early";
  info.type = ObjectType::PointCloud;
  const TopicId topic = builder.raw()->store().addTopic(info, source);
  builder.raw()->store().append(
      topic, std::vector<Entry>{{.log_time = {10_s}, .payload_bytes = 0}, {.log_time = {20_s}, .payload_bytes = 7}});
  const auto waits = [](const AnyObject& object, const Entry& entry) -> std::expected<Width, Status> {
    const auto cloud = object.get<PointCloud>();
    if (cloud->data.arrival != nullptr && !cloud->data.arrival->waitForAll()) {
      return std::unexpected(Status{StatusLevel::Error, "MalformedCloud", "it does not come"});
    }
    return widthOf(object, entry);
  };
  SampleLoader<Width> early(context(*at_once), ObjectType::PointCloud, "/early", "early", waits, {}, true);
  early.update({20_s});
  ASSERT_NE(early.product(), nullptr);
  EXPECT_EQ(early.product()->width, 7U);
  EXPECT_EQ(source->decoded, 0);
  early.update({10_s});
  EXPECT_EQ(early.product(), nullptr);
  EXPECT_EQ(early.status().code, "BadChunk") << "the reason is that of decode()";
  SampleLoader<Width> whole(context(*at_once), ObjectType::PointCloud, "/early", "whole", widthOf);
  whole.update({20_s});
  ASSERT_NE(whole.product(), nullptr);
  EXPECT_EQ(whole.product()->width, 8U);
}

TEST_F(SampleLoaderTest, MakesTheNextSampleOfTheDirectionOfPlayWhenThereIsTime) {
  for (std::uint32_t i = 1; i <= 9; ++i) {
    builder.at(i * 1_s, cloudOf(i));
  }
  auto played = loader(later);
  const auto show = [&](std::int64_t time_ns) {
    played.update(tf::TimePoint{time_ns});
    const bool is_there = played.status().level == StatusLevel::Ok;
    later.drain();
    played.update(tf::TimePoint{time_ns});
    EXPECT_EQ(played.product()->width, static_cast<std::uint32_t>(time_ns / (1_s)));
    return is_there;
  };
  EXPECT_FALSE(show(2_s));
  EXPECT_EQ(later.idle(), 1U);
  EXPECT_TRUE(show(3_s)) << "forwards";
  EXPECT_EQ(builder.source().decodeCount(), 2U);
  later.idle();
  EXPECT_TRUE(show(2_s)) << "was here before";
  later.idle();
  EXPECT_TRUE(show(1_s)) << "backwards";
  EXPECT_EQ(later.idle(), 0U) << "there is nothing before it";
  EXPECT_FALSE(show(5_s)) << "a jump";
  later.idle();
  EXPECT_TRUE(show(9_s)) << "and one as wide";
}

TEST_F(SampleLoaderTest, MakesOnlyTheLatestOfWhatWaitsToBeMadeAhead) {
  for (std::uint32_t i = 1; i <= 9; ++i) {
    builder.at(i * 1_s, cloudOf(i));
  }
  auto played = loader(later);
  for (std::int64_t second = 1; second <= 4; ++second) {
    played.update(tf::TimePoint{second * 1_s});
    later.drain();
    played.update(tf::TimePoint{second * 1_s});
  }
  EXPECT_EQ(builder.source().decodeCount(), 4U);
  EXPECT_EQ(later.idle(), 4U);
  EXPECT_EQ(builder.source().decodeCount(), 5U);
}

TEST_F(SampleLoaderTest, MakesNothingAheadForWhichTheCacheHasNoRoom) {
  builder.at(1_s, cloudOf(1)).at(2_s, cloudOf(2));
  builder.raw()->cache().setMaxBytes(2 * sizeof(Width));
  auto played = loader(later);
  played.update(tf::TimePoint{1_s});
  later.drain();
  played.update(tf::TimePoint{1_s});
  EXPECT_EQ(later.idle(), 0U);
}

}  // namespace
}  // namespace stillframe::scenegraph
