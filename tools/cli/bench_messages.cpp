#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "nodes/markers/scene_history.h"
#include "nodes/poses/pose_set.h"
#include "scenegraph/objects/poses.h"
#include "scenegraph/objects/scene_entities.h"
#include "tools/cli/bench_conversions.h"
#include "tools/cli/bench_results.h"
#include "tools/ingest/message_decoder.h"
#include "tools/sample/marker_messages.h"
#include "tools/sample/pose_messages.h"

namespace stillframe::cli {
namespace {

using scenegraph::AnyObject;
using scenegraph::PosesInFrame;
using scenegraph::SceneEntities;

/// A message of CDR, and what reads it.
class WrittenMessage {
 public:
  WrittenMessage(const sample::Ros2Type& type, std::vector<std::byte> bytes)
      : schema_{1, std::string(type.name), "ros2msg", std::string(type.definition)},
        decoder_(ingest::makeDecoder(&schema_, "cdr", "/bench")),
        bytes_(std::make_shared<const std::vector<std::byte>>(std::move(bytes))) {}

  [[nodiscard]] std::size_t size() const { return bytes_->size(); }
  [[nodiscard]] std::expected<AnyObject, scenegraph::DecodeError> read() const {
    return decoder_.decoder->decode({*bytes_, bytes_, bytes_->size(), {0}});
  }

 private:
  ingest::SchemaRecord schema_;
  ingest::ChannelDecoder decoder_;
  std::shared_ptr<const std::vector<std::byte>> bytes_;
};

WrittenMessage markers(int count) {
  std::vector<sample::Marker> all;
  for (int i = 0; i < count; ++i) {
    sample::Marker marker;
    marker.frame_id = "map";
    marker.ns = "cubes";
    marker.id = i;
    marker.pose.translation = {0.1 * (i % 300), 0.1 * (i / 300), 0.0};
    all.push_back(marker);
  }
  return {sample::markerArrayType(), sample::serializeMarkerArray(all)};
}

PosesInFrame poses(std::size_t count) {
  PosesInFrame poses;
  poses.frame_id = "map";
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 1e-3 * static_cast<double>(i);
    poses.poses.push_back({.translation = {20.0 * std::cos(angle), 20.0 * std::sin(angle), 0.0}});
    poses.stamps.push_back({static_cast<std::int64_t>(i) * 1'000'000});
  }
  return poses;
}

}  // namespace

/// From the bytes of the message to what is drawn: read, then made into shapes or judged.
void benchMessages(std::vector<BenchResult>& results) {
  Conversions conversions(results);
  constexpr int kMarkers = 20'000;
  const WrittenMessage cubes = markers(kMarkers);
  conversions.add("markers, message of 20 000 cubes", cubes.size(), 5, [&] {
    const auto object = cubes.read();
    nodes::SceneHistory history;
    return object && history.at(
                                1, {1}, [](std::size_t) { return 0U; },
                                [&](std::size_t) {
                                  return nodes::SceneMessage{{0}, 0, cubes.size(), object->get<SceneEntities>()};
                                })
                             .totals.entities == kMarkers;
  });
  constexpr std::size_t kPoses = 200'000;
  const auto addPoses = [&](const char* name, const WrittenMessage& message) {
    conversions.add(name, message.size(), 5, [&] {
      const auto object = message.read();
      return object && nodes::PoseSet(object->get<PosesInFrame>()).source().poses.size() == kPoses;
    });
  };
  addPoses("pose array of 200 000 poses", {sample::poseArrayType(), sample::serializePoseArray(poses(kPoses))});
  addPoses("path of 200 000 poses", {sample::pathType(), sample::serializePath(poses(kPoses))});
}

}  // namespace stillframe::cli
