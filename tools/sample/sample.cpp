#include "tools/sample/sample.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tools/ingest/mcap_writer.h"
#include "tools/sample/topic.h"

namespace stillframe::sample {
namespace {

constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000;  // 14 November 2023, 22:13:20 UTC
constexpr std::int64_t kTransport_ns = 1'000'000;              // from a stamp to its place in the log

/// Every producer of the recording, in the order in which those of the same instant are logged.
std::vector<std::unique_ptr<Topic>> makeTopics(const Stage& stage, const SampleOptions& options) {
  std::vector<std::unique_ptr<Topic>> topics;
  topics.push_back(makeStaticTransforms(stage));
  topics.push_back(makeLocalisationTransforms(stage));
  topics.push_back(makeOdometryTransforms(stage));
  topics.push_back(makeLidar(stage, options.lidar_points));
  topics.push_back(makeDepthCamera(stage));
  topics.push_back(makeScanner(stage));
  topics.push_back(makeHeightMap(stage));
  topics.push_back(makeVoxels(stage));
  topics.push_back(makeMap(stage));
  topics.push_back(makeMarkers(stage));
  topics.push_back(makeMapUpdates(stage));
  topics.push_back(makeDepthCameraInfo(stage));
  topics.push_back(makeDepthImages(stage));
  topics.push_back(makeOdometry(stage));
  topics.push_back(makePath(stage));
  topics.push_back(makeParticles(stage));
  topics.push_back(makeFootprint(stage));
  topics.push_back(makeCompressedLidar(stage, options.lidar_points, "cloudini"));
  topics.push_back(makeCompressedLidar(stage, options.lidar_points, "draco"));
  topics.push_back(makeRobotDescription());
  topics.push_back(makeArmStates(stage));
  return topics;
}

/// When a producer sends its next message.
struct Due {
  std::int64_t elapsed_ns = 0;
  const Topic* topic = nullptr;
  std::uint16_t channel = 0;
};

}  // namespace

std::expected<SampleReport, scenegraph::Status> writeSample(const std::filesystem::path& path,
                                                            const SampleOptions& options) {
  const World world(options.seed);
  const Robot robot(options.seed, options.duration_ns);
  const Stage stage{world, robot, options.seed, kStart_ns};
  const auto topics = makeTopics(stage, options);

  auto writer = ingest::McapWriter::open(path);
  if (!writer) {
    return std::unexpected(writer.error());
  }
  std::map<std::string, std::uint16_t, std::less<>> channels;
  std::vector<Due> due;
  for (const auto& topic : topics) {
    auto channel = channels.find(topic->name());
    if (channel == channels.end()) {
      const Ros2Type type = topic->type();
      const auto id = (*writer)->addChannel(topic->name(), type.name, "ros2msg", type.definition, "cdr");
      channel = channels.emplace(topic->name(), id).first;
    }
    due.push_back({0, topic.get(), channel->second});
  }

  SampleReport report;
  while (!due.empty()) {
    const auto next = std::ranges::min_element(due, {}, &Due::elapsed_ns);  // the first of equals
    const auto stamp_ns = static_cast<std::uint64_t>(kStart_ns + next->elapsed_ns);
    const auto bytes = next->topic->message(next->elapsed_ns);
    if (const auto written = (*writer)->write(next->channel, stamp_ns + kTransport_ns, stamp_ns, bytes); !written) {
      return std::unexpected(written.error());
    }
    ++report.messages;
    report.bytes += bytes.size();
    next->elapsed_ns += next->topic->periodNs();
    if (next->topic->periodNs() == 0 || next->elapsed_ns > options.duration_ns) {
      due.erase(next);
    }
  }
  const std::map<std::string, std::string> origin{{"seed", std::to_string(options.seed)},
                                                  {"duration_ns", std::to_string(options.duration_ns)},
                                                  {"lidar_points", std::to_string(options.lidar_points)}};
  if (const auto added = (*writer)->addMetadata("stillframe_sample", origin); !added) {
    return std::unexpected(added.error());
  }
  if (const auto finished = (*writer)->finish(); !finished) {
    return std::unexpected(finished.error());
  }
  return report;
}

}  // namespace stillframe::sample
