#include "nodes/depth_image/color_join.h"

#include "nodes/images/color_image.h"
#include "nodes/images/raw_rows.h"
#include "tf/transform_buffer.h"

namespace stillframe::nodes {
namespace {

using scenegraph::Image;
using scenegraph::Status;
using scenegraph::StatusLevel;
using Result = JoinJob<ColorFrame>::Result;

/// What one join looks at; owned by its worker.
struct Join {
  std::shared_ptr<scenegraph::Dataset> dataset;
  std::string image_topic;
  std::string frame_id;
  std::uint32_t width;
  std::uint32_t height;
  std::vector<TopicInForce> images;
};

/// nullptr when it is no colour image of this frame and size; a fault of one that is.
Result colorsOf(const Join& join, const TopicInForce& topic) {
  const scenegraph::CacheKey key = scenegraph::cacheKey(topic.id, topic.entry, "colors");
  auto colors = join.dataset->cache().get<ColorFrame>(key);
  const auto object = join.dataset->store().decode(topic.id, topic.entry);
  const auto image = object ? object->get<Image>() : nullptr;
  if (image == nullptr || !isColorEncoding(image->encoding) ||
      tf::stripLeadingSlashes(image->frame_id) != join.frame_id) {
    return nullptr;
  }
  const bool is_sized = image->width != 0 && image->height != 0;
  if (is_sized && (image->width != join.width || image->height != join.height)) {
    return nullptr;
  }
  if (colors == nullptr) {
    auto made = ColorFrame::make(*image);
    if (!made) {
      made.error().message = "the colour image of '" + topic.name + "': " + made.error().message;
      return std::unexpected(std::move(made.error()));
    }
    colors = std::make_shared<const ColorFrame>(std::move(*made));
    join.dataset->cache().put(key, colors, colors->byteSize());
  }
  return colors->width == join.width && colors->height == join.height ? colors : nullptr;
}

Result runJoin(const Join& join) {
  std::string fault;
  for (const TopicInForce& topic : join.images) {
    auto colors = colorsOf(join, topic);
    if (colors && *colors != nullptr) {
      return colors;
    }
    if (!colors && fault.empty()) {
      fault = "; " + colors.error().message;
    }
  }
  return std::unexpected(Status{StatusLevel::Info, "NoColorImage",
                                "'" + join.image_topic + "' is coloured by depth: there is no colour image of " +
                                    sizeText(join.width, join.height) + " in its frame '" + join.frame_id +
                                    "' at or before this time" + fault});
}

}  // namespace

ColorJoin::ColorJoin(const scenegraph::LayerContext& context, std::string image_topic)
    : dataset_(context.dataset.shared_from_this()),
      image_topic_(std::move(image_topic)),
      topics_(scenegraph::ObjectType::Image, image_topic_),
      job_(context) {}

std::optional<Result> ColorJoin::get(const std::string& frame_id, std::uint32_t width, std::uint32_t height,
                                     tf::TimePoint time) {
  Join join{dataset_, image_topic_, frame_id, width, height, topics_.at(dataset_->store(), time)};
  const scenegraph::CacheKey key{.product = "color join|" + frame_id + "|" + std::to_string(width) + "x" +
                                            std::to_string(height) + joinText(join.images)};
  return job_.get(key, [join = std::move(join)] { return runJoin(join); });
}

}  // namespace stillframe::nodes
