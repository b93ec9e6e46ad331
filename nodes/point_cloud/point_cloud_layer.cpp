#include "nodes/point_cloud/point_cloud_layer.h"

#include <algorithm>
#include <array>
#include <mutex>

#include "nodes/osg_math.h"
#include "scenegraph/geometry.h"
#include "scenegraph/placement.h"

namespace stillframe::nodes {

using scenegraph::Status;
using scenegraph::StatusLevel;

/// The colour field in use, for the workers: they convert it with the positions, so that scrubbing never does.
struct PointCloudLayer::Foresight {
  std::mutex mutex;  // guards color_field
  std::string color_field = "auto";

  void set(const std::string& field) {
    const std::scoped_lock lock(mutex);
    color_field = field;
  }
  void prepare(const CloudPoints& cloud) {
    std::string field;
    {
      const std::scoped_lock lock(mutex);
      field = color_field;
    }
    const ColorChoice choice = chooseColor(field, cloud, cloud);
    if (choice.mode == ColorMode::Rgb) {
      (void)cloud.colors();
    } else if (choice.mode == ColorMode::Value) {
      (void)cloud.channel(choice.channel);
    }
  }
};

std::unique_ptr<scenegraph::Layer> PointCloudLayer::create(std::string_view topic) {
  const auto convert = [](const scenegraph::AnyObject& object, const scenegraph::Entry&) {
    return CloudPoints::make(object.get<scenegraph::PointCloud>());
  };
  return std::make_unique<PointCloudLayer>(topic, CloudFeed{.convert = convert, .defaults = {}});
}

PointCloudLayer::PointCloudLayer(std::string_view topic, CloudFeed feed)
    : topic_(topic), feed_(std::move(feed)), settings_(feed_.defaults), foresight_(std::make_shared<Foresight>()) {}

PointCloudLayer::~PointCloudLayer() = default;

void PointCloudLayer::attach(const scenegraph::LayerContext& context) {
  context_.emplace(context);
  loader_.emplace(
      context, feed_.type, topic_, feed_.tag,
      [convert = feed_.convert, foresight = foresight_](
          const scenegraph::AnyObject& object, const scenegraph::Entry& entry) -> std::expected<CloudPoints, Status> {
        auto points = convert(object, entry);
        if (points) {
          foresight->prepare(*points);
        }
        return points;
      },
      [](const CloudPoints& points) { return points.converted().points > 0; });
  geometry_ = scenegraph::makeGeometry();
  geometry_->setName(topic_);
  node_ = new osg::MatrixTransform;
  node_->setName(topic_);
  node_->setStateSet(state_.stateSet());
  node_->addChild(geometry_);
  applied_.reset();
}

void PointCloudLayer::detach() {
  if (context_) {
    clear();
  }
  loader_.reset();
  reference_ = nullptr;
  geometry_ = nullptr;
  node_ = nullptr;
  context_.reset();
}

void PointCloudLayer::setVisible(bool visible) {
  visible_ = visible;
  if (!visible && context_) {
    clear();
  }
}

void PointCloudLayer::clear() {
  show(nullptr);
  hold(std::nullopt);
  applied_.reset();
  status_ = {};
  bounds_.init();
}

bool PointCloudLayer::isPending() const { return visible_ && loader_ && loader_->isPending(); }

void PointCloudLayer::update(const scenegraph::Tick& tick) {
  if (!context_ || !visible_) {
    return;
  }
  foresight_->set(settings_.color_field);
  (void)loader_->update(tick.time);
  if (auto drawn = drawnOf(loader_->product()); drawn != product_) {
    show(std::move(drawn));
  }
  hold(product_ != nullptr ? std::optional(std::string(tf::stripLeadingSlashes(product_->source().frame_id)))
                           : std::nullopt);
  if (applied_ != settings_) {
    state_.apply(settings_);
    applied_ = settings_;
  }
  const Placement placement = fixedFromPoints();
  if (product_ != nullptr) {
    const auto reference = loader_->reference();
    reference_ = reference != nullptr ? reference : product_;
    paint(placement ? std::optional(*placement) : std::nullopt);
  }
  bounds_.init();
  if (product_ != nullptr && placement && product_->converted().points > 0) {
    const ConvertedCloud& cloud = product_->converted();
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto pick = [&](unsigned axis) {
        const int i = static_cast<int>(axis);
        return ((corner >> axis) & 1U) != 0 ? cloud.box_max[i] : cloud.box_min[i];
      };
      bounds_.expandBy(toOsg(tf::transformPoint(*placement, {pick(0), pick(1), pick(2)})));
    }
  }
  status_ = judge(placement);
}

std::shared_ptr<const CloudPoints> PointCloudLayer::drawnOf(const std::shared_ptr<const CloudPoints>& loaded) {
  return loaded;
}

std::optional<scenegraph::Entry> PointCloudLayer::loadedEntry() const {
  return loader_ ? loader_->entry() : std::nullopt;
}

void PointCloudLayer::show(std::shared_ptr<const CloudPoints> product) {
  if (product_ != nullptr) {
    product_->releaseGlObjects();
  }
  product_ = std::move(product);
  choice_ = {};
  geometry_->removePrimitiveSet(0, geometry_->getNumPrimitiveSets());
  geometry_->setColorArray(nullptr);
  geometry_->setVertexAttribArray(CloudState::kValueAttribute, nullptr);
  geometry_->setVertexArray(nullptr);
  if (product_ != nullptr && product_->converted().points > 0) {
    geometry_->setVertexArray(product_->positions());
    geometry_->addPrimitiveSet(new osg::DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(product_->converted().points)));
    const auto frame_from_points = product_->source().pose;
    node_->setMatrix(osg::Matrixd::translate(toOsg(product_->converted().origin)) * toOsg(frame_from_points));
  }
  geometry_->dirtyBound();
}

void PointCloudLayer::hold(const std::optional<std::string>& frame) {
  if (held_frame_ == frame) {
    return;
  }
  if (held_frame_) {
    if (osg::MatrixTransform* const parent = context_->frames.node(*held_frame_)) {
      parent->removeChild(node_);
    }
    context_->frames.release(*held_frame_);
  }
  held_frame_ = frame;
  if (held_frame_) {
    context_->frames.acquire(*held_frame_).addChild(node_);
  }
}

PointCloudLayer::Placement PointCloudLayer::fixedFromPoints() const {
  if (product_ == nullptr) {
    return std::unexpected(tf::LookupFailure{});
  }
  const auto fixed_from_frame = context_->frames.fixedFromFrame(*held_frame_);
  if (!fixed_from_frame) {
    return fixed_from_frame;
  }
  return *fixed_from_frame * product_->source().pose;
}

void PointCloudLayer::paint(const std::optional<tf::RigidTransform>& fixed_from_points) {
  const ColorChoice choice = chooseColor(settings_.color_field, *reference_, *product_);
  if (choice != choice_) {
    choice_ = choice;
    setColorArrays();
  }
  // What the mode does not use is set all the same: the state must not tell where it came from.
  RangeMap value_map;
  osg::Vec4d axis_map;
  if (choice_.mode == ColorMode::Value) {
    const ValueRange range = channelRange(settings_, choice_.channel, *reference_, *product_);
    value_map = settings_.map(range, product_->channel(choice_.channel)->limits.offset);
  } else if (choice_.mode == ColorMode::Axis && fixed_from_points) {
    // The vertex is relative to the cloud's origin; where that lies along the axis is taken off the range in double.
    const ValueRange range = axisRange(settings_, choice_.axis, *product_, *fixed_from_points);
    const glm::dmat4 matrix = tf::toMatrix(*fixed_from_points);
    const double origin = tf::transformPoint(*fixed_from_points, product_->converted().origin)[choice_.axis];
    const RangeMap map = settings_.map(range, origin);
    axis_map = {matrix[0][choice_.axis] * map.scale, matrix[1][choice_.axis] * map.scale,
                matrix[2][choice_.axis] * map.scale, map.bias};
  }
  state_.setMode(choice_.mode, value_map);
  state_.setAxisMap(axis_map);
}

void PointCloudLayer::setColorArrays() {
  const bool has_points = product_->converted().points > 0;
  const bool is_rgb = has_points && choice_.mode == ColorMode::Rgb;
  const bool is_value = has_points && choice_.mode == ColorMode::Value;
  geometry_->setColorArray(is_rgb ? product_->colors() : nullptr);
  geometry_->setVertexAttribArray(CloudState::kValueAttribute,
                                  is_value ? product_->channel(choice_.channel)->values.get() : nullptr);
}

std::string PointCloudLayer::sampleText() const {
  return "'" + topic_ + "' at " + scenegraph::timeText(loader_->entry()->log_time) + ": ";
}

Status PointCloudLayer::judge(const Placement& placement) const {
  if (product_ == nullptr) {
    return loader_->status();
  }
  if (!placement) {
    return scenegraph::placementStatus(context_->frames, *held_frame_, placement.error());
  }
  if (loader_->status().level != StatusLevel::Ok) {
    return loader_->status();
  }
  if (choice_.is_missing) {
    std::string known;
    for (const ChannelInfo& channel : product_->channels()) {
      known += ", " + channel.name;
    }
    return {StatusLevel::Info, "UnknownField",
            sampleText() + "no field '" + settings_.color_field + "' to colour by; there are x, y, z" +
                (product_->hasColors() ? ", rgb" : "") + known};
  }
  const ConvertedCloud& cloud = product_->converted();
  if (const std::size_t dropped = cloud.not_finite + cloud.out_of_reach; dropped > 0) {
    return {StatusLevel::Info, "PointsDropped",
            sampleText() + std::to_string(dropped) + " of " + std::to_string(dropped + cloud.points) +
                " points are not drawn: " + std::to_string(cloud.not_finite) + " with a NaN or infinite coordinate, " +
                std::to_string(cloud.out_of_reach) + " farther than 1e15 m"};
  }
  return remark();
}

scenegraph::LayerCounts PointCloudLayer::counts() const {
  if (product_ == nullptr) {
    return {{"points", 0}, {"dropped", 0}, {"bytes", 0}};
  }
  const ConvertedCloud& cloud = product_->converted();
  return {{"points", cloud.points + cloud.out_of_reach},
          {"dropped", cloud.not_finite + product_->supplement().left_out},
          {"bytes", product_->source().data.bytes.size()}};
}

std::vector<scenegraph::SettingSpec> PointCloudLayer::settingSpecs() const {
  auto specs = pointCloudSettingsTable().specs();
  if (reference_ != nullptr) {
    std::vector<std::string>& choices = specs.front().choices;
    if (reference_->hasColors()) {
      choices.insert(choices.begin() + 1, "rgb");
    }
    for (const ChannelInfo& channel : reference_->channels()) {
      choices.push_back(channel.name);
    }
  }
  return specs;
}

scenegraph::SettingTexts PointCloudLayer::settings() const { return pointCloudSettingsTable().texts(settings_); }

std::expected<void, scenegraph::SettingError> PointCloudLayer::applySettings(const scenegraph::SettingTexts& texts) {
  return pointCloudSettingsTable().apply(texts, settings_);
}

}  // namespace stillframe::nodes
