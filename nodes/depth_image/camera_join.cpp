#include "nodes/depth_image/camera_join.h"

#include <algorithm>
#include <bit>

#include "scenegraph/near_names.h"
#include "tf/transform_buffer.h"

namespace stillframe::nodes {
namespace {

using scenegraph::CameraInfo;
using scenegraph::Status;
using scenegraph::StatusLevel;
using Result = JoinJob<CameraRays>::Result;

/// What one join looks at; owned by its worker.
struct Join {
  std::shared_ptr<scenegraph::Dataset> dataset;
  std::string image_topic;
  CameraJoin::Wanted wanted;
  std::vector<TopicInForce> infos;
  std::vector<std::string> later;  // topics without a message yet
};

struct Candidate {
  std::string topic;
  std::shared_ptr<const CameraInfo> info;
};

/// image_rect, image_rect_raw, image_rect_color: pictures that a driver has rectified.
bool isRectifiedTopic(std::string_view topic) { return topic.find("/image_rect") != std::string_view::npos; }

PixelGrid gridOf(const Join& join) {
  if (isRectifiedTopic(join.image_topic)) {
    return PixelGrid::Rectified;
  }
  return join.wanted.rectify ? PixelGrid::Raw : PixelGrid::Undone;
}

Status noCameraInfo(const Join& join, const std::vector<std::string>& other_frames) {
  const std::string wanted = join.wanted.info_topic == "auto" ? "in its frame '" + join.wanted.frame_id + "'"
                                                              : "on '" + join.wanted.info_topic + "'";
  std::string known;
  if (!other_frames.empty()) {
    known = "; there are " + scenegraph::quotedList(other_frames) + ", of which one can be named as info_topic";
  }
  if (!join.later.empty()) {
    known += "; " + scenegraph::quotedList(join.later) + " begins later";
  }
  return {StatusLevel::Warn, "NoCameraInfo",
          "'" + join.image_topic + "' has no CameraInfo " + wanted + " at or before this time" +
              (known.empty() ? "; the recording has none" : known)};
}

/// Equal for cameras with equal rays.
std::string contentOf(const CameraInfo& info, const CameraJoin::Wanted& wanted, PixelGrid grid) {
  std::string text = "camera rays " + info.distortion_model;
  const auto add = [&](std::uint64_t bits) { text += " " + std::to_string(bits); };
  for (const std::uint32_t number :
       {static_cast<std::uint32_t>(grid), wanted.width, wanted.height, info.width, info.height, info.binning_x,
        info.binning_y, info.roi_x_offset, info.roi_y_offset, info.roi_width, info.roi_height}) {
    add(number);
  }
  for (const std::span<const double> numbers :
       {std::span<const double>(info.k), std::span<const double>(info.p), std::span<const double>(info.distortion)}) {
    std::ranges::for_each(numbers, [&](double number) { add(std::bit_cast<std::uint64_t>(number)); });
  }
  return text;
}

Result raysOf(const Join& join, const Candidate& candidate) {
  const PixelGrid grid = gridOf(join);
  const auto model = CameraModel::make(*candidate.info, join.wanted.width, join.wanted.height, grid);
  if (!model) {
    return std::unexpected(Status{
        StatusLevel::Error, model.error().code,
        "'" + join.image_topic + "' with the CameraInfo of '" + candidate.topic + "': " + model.error().message});
  }
  const scenegraph::CacheKey key{.product = contentOf(*candidate.info, join.wanted, grid)};
  if (auto known = join.dataset->cache().get<CameraRays>(key)) {
    return known;
  }
  auto rays = std::make_shared<const CameraRays>(CameraRays::make(*model, join.wanted.width, join.wanted.height));
  join.dataset->cache().put(key, rays, rays->byteSize());
  return rays;
}

bool takesOwn(const CameraJoin::Wanted& wanted) { return wanted.own != nullptr && wanted.info_topic == "auto"; }

Result runJoin(const Join& join) {
  if (takesOwn(join.wanted)) {
    return raysOf(join, {join.image_topic, join.wanted.own});
  }
  std::vector<Candidate> candidates;
  std::vector<std::string> other_frames;
  for (const TopicInForce& topic : join.infos) {
    const auto object = join.dataset->store().decode(topic.id, topic.entry);
    const auto info = object ? object->get<CameraInfo>() : nullptr;
    if (info == nullptr) {
      continue;
    }
    const bool is_named = join.wanted.info_topic == topic.name;
    if (is_named || tf::stripLeadingSlashes(info->frame_id) == join.wanted.frame_id) {
      candidates.push_back({topic.name, info});
    } else {
      other_frames.push_back(topic.name);
    }
  }
  if (candidates.empty()) {
    return std::unexpected(noCameraInfo(join, other_frames));
  }
  const auto fits = [&](const Candidate& candidate) {
    return CameraModel::make(*candidate.info, join.wanted.width, join.wanted.height, PixelGrid::Undone).has_value();
  };
  const auto found = std::ranges::find_if(candidates, fits);
  return raysOf(join, found != candidates.end() ? *found : candidates.front());
}

}  // namespace

CameraJoin::CameraJoin(const scenegraph::LayerContext& context, std::string image_topic)
    : dataset_(context.dataset.shared_from_this()),
      image_topic_(std::move(image_topic)),
      topics_(scenegraph::ObjectType::CameraInfo, image_topic_),
      job_(context) {}

std::optional<Result> CameraJoin::get(const Wanted& wanted, tf::TimePoint time) {
  if (takesOwn(wanted)) {
    const scenegraph::CacheKey key{.product = contentOf(*wanted.own, wanted, PixelGrid::Raw) +
                                              (wanted.rectify ? " own camera" : " own camera undone")};
    return job_.get(key, [join = Join{dataset_, image_topic_, wanted, {}, {}}] { return runJoin(join); });
  }
  Join join{dataset_, image_topic_, wanted, topics_.at(dataset_->store(), time), {}};
  const bool is_auto = wanted.info_topic == "auto";
  if (!is_auto) {
    std::erase_if(join.infos, [&](const TopicInForce& topic) { return topic.name != wanted.info_topic; });
  }
  if (join.infos.size() < topics_.topics().size()) {
    for (const TopicInForce& topic : topics_.topics()) {
      if ((is_auto || topic.name == wanted.info_topic) &&
          std::ranges::find(join.infos, topic.id, &TopicInForce::id) == join.infos.end()) {
        join.later.push_back(topic.name);
      }
    }
  }
  if (join.infos.empty()) {
    job_.cancel();
    return std::unexpected(noCameraInfo(join, {}));  // nothing to decode
  }
  const scenegraph::CacheKey key{.product = "camera join|" + wanted.frame_id + "|" + wanted.info_topic + "|" +
                                            std::to_string(wanted.width) + "x" + std::to_string(wanted.height) +
                                            (wanted.rectify ? "|rectify" : "") + joinText(join.infos)};
  return job_.get(key, [join = std::move(join)] { return runJoin(join); });
}

std::vector<std::string> CameraJoin::topicNames() const {
  std::vector<std::string> names;
  for (const TopicInForce& topic : topics_.topics()) {
    names.push_back(topic.name);
  }
  return names;
}

}  // namespace stillframe::nodes
