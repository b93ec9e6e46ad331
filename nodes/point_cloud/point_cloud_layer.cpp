#include "nodes/point_cloud/point_cloud_layer.h"

#include "nodes/osg_math.h"
#include "nodes/point_cloud/describe_point.h"
#include "nodes/points/value_histogram.h"
#include "scenegraph/geometry.h"
#include "scenegraph/known_bound.h"

namespace stillframe::nodes {

using scenegraph::Status;
using scenegraph::StatusLevel;

namespace {

void prepare(const CloudPoints& cloud, const PointCloudSettings& settings) {
  prepareColors(cloud, chooseColor(settings.color_field, cloud, cloud), settings);
}

}  // namespace

CloudFeed feedOf(scenegraph::ObjectType type,
                 const std::function<CloudFeed::Cloud(const scenegraph::AnyObject&)>& read) {
  CloudFeed feed{.type = type, .convert = {}, .settle = {}, .defaults = {}};
  feed.convert = [read](const scenegraph::AnyObject& object,
                        const PointCloudSettings& settings) -> std::expected<CloudPoints, Status> {
    auto cloud = read(object);
    return cloud ? CloudPoints::make(std::move(*cloud), {}, wantedChannel(settings)) : std::unexpected(cloud.error());
  };
  feed.settle = [read](CloudPoints& points, const scenegraph::MessageOrigin& origin) {
    points.settle([read, origin]() -> std::shared_ptr<const scenegraph::PointCloud> {
      const scenegraph::AnyObject object = origin.read();
      return object ? read(object).value_or(nullptr) : nullptr;
    });
  };
  return feed;
}

std::unique_ptr<scenegraph::Layer> PointCloudLayer::create(std::string_view topic) {
  const auto cloudOf = [](const scenegraph::AnyObject& object) -> CloudFeed::Cloud {
    return object.get<scenegraph::PointCloud>();
  };
  return std::make_unique<PointCloudLayer>(topic, feedOf(scenegraph::ObjectType::PointCloud, cloudOf));
}

PointCloudLayer::PointCloudLayer(std::string_view topic, CloudFeed feed)
    : SampleLayer(topic,
                  {.type = feed.type,
                   .tag = std::move(feed.tag),
                   .convert = std::move(feed.convert),
                   .is_reference = [](const CloudPoints& points) { return points.converted().points > 0; },
                   .prepare = &prepare,
                   .settle = std::move(feed.settle),
                   .takes_early = feed.type == scenegraph::ObjectType::PointCloud},
                  pointCloudSettingsTable(), std::move(feed.defaults)) {}

void PointCloudLayer::open(const scenegraph::LayerContext& context) {
  SampleLayer::open(context);
  color_job_.emplace(context.executor, context.request_update);
  geometry_ = addGeometry(state_.stateSet());
}

void PointCloudLayer::close() {
  SampleLayer::close();
  color_job_.reset();
  color_work_.reset();
  geometry_ = nullptr;
}

std::optional<scenegraph::Picked> PointCloudLayer::describeData(const scenegraph::PickHit& hit) const {
  return product() != nullptr ? describePoint(*product(), hit.vertex) : std::nullopt;
}

TopicLayer::Anchor PointCloudLayer::anchorOf(const CloudPoints& cloud) const {
  return {cloud.source().frame_id, cloud.source().pose};
}

osg::BoundingBoxd PointCloudLayer::box() const {
  const ConvertedCloud& cloud = product()->converted();
  return cloud.points > 0 ? osg::BoundingBoxd(toOsg(cloud.box_min), toOsg(cloud.box_max)) : osg::BoundingBoxd();
}

osg::BoundingBoxd PointCloudLayer::bulk() const {
  // A quarter of the spread beyond the 5th and 95th percentile at most: a cloud without strays keeps its whole box.
  osg::BoundingBoxd bulk = box();
  const auto middle = product()->sampledPercentiles(5.0, 95.0);
  for (unsigned axis = 0; axis < middle.size(); ++axis) {
    const double margin = (middle[axis].high - middle[axis].low) / 4.0;
    bulk._min[axis] = std::max(bulk._min[axis], middle[axis].low - margin);
    bulk._max[axis] = std::min(bulk._max[axis], middle[axis].high + margin);
  }
  return bulk;
}

bool PointCloudLayer::isWorking() const { return SampleLayer::isWorking() || color_job_->isPending(); }

void PointCloudLayer::show() {
  color_job_->cancel();
  color_work_.reset();
  colored_by_ = nullptr;
  choice_ = {};
  range_.reset();
  geometry_->removePrimitiveSet(0, geometry_->getNumPrimitiveSets());
  geometry_->setColorArray(nullptr);
  geometry_->setVertexAttribArray(CloudState::kValueAttribute, nullptr);
  geometry_->setVertexArray(nullptr);
  if (product() != nullptr && product()->converted().points > 0) {
    geometry_->setVertexArray(product()->positions());
    geometry_->addPrimitiveSet(new osg::DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(product()->converted().points)));
    const auto frame_from_points = product()->source().pose;
    node().setMatrix(osg::Matrixd::translate(toOsg(product()->converted().origin)) * toOsg(frame_from_points));
    const ConvertedCloud& cloud = product()->converted();
    scenegraph::setKnownBound(*geometry_, {toOsg(cloud.box_min - cloud.origin), toOsg(cloud.box_max - cloud.origin)});
  } else {
    geometry_->dirtyBound();
  }
}

/// Whether all is there that these colours need; sees to it that it will be.
bool PointCloudLayer::hasColorsFor(const ColorChoice& choice) {
  if (colored_by_ == reference() && choice == choice_ && ranged_ == chosen()) {
    return true;
  }
  ColorWork work{product(), reference(), choice, chosen()};
  const auto isReady = [&] {
    return areColorsPrepared(*work.cloud, choice, work.settings) &&
           areColorsPrepared(*work.reference, choice, work.settings);
  };
  if (isReady()) {
    color_job_->cancel();
    color_work_.reset();
    return true;
  }
  const auto prepareBoth = [work] {
    for (const Shown& cloud : {work.cloud, work.reference}) {
      prepareColors(*cloud, work.choice, work.settings);
    }
  };
  constexpr std::size_t kQuick = 100'000;  // points: some milliseconds
  if (product()->converted().points + reference()->converted().points <= 2 * kQuick) {
    prepareBoth();
    return true;
  }
  if (color_work_ != work) {
    color_work_ = work;
    color_job_->request({.sequence = ++color_jobs_, .product = "colors"},
                        [work, prepareBoth]() -> scenegraph::LatestJob<CloudPoints>::Result {
                          prepareBoth();
                          return work.cloud;
                        });
  }
  (void)color_job_->take();
  return isReady();
}

void PointCloudLayer::draw(const Placement& fixed_from_points) {
  if (takeSettings()) {
    state_.apply(chosen());
    geometry_->setNodeMask(chosen().opacity < 1.0 ? ~0U : scenegraph::kOpaquePoints);
  }
  const ColorChoice choice = chooseColor(chosen().color_field, *reference(), *product());
  if (hasColorsFor(choice)) {
    ranged_ = chosen();
    colored_by_ = reference();
    if (choice != choice_) {
      choice_ = choice;
      setColorArrays();
    }
  }
  // What the mode does not use is set all the same: the state must not tell where it came from.
  RangeMap value_map;
  glm::dvec4 axis_map{0.0};
  range_.reset();
  if (choice_.mode == ColorMode::Value) {
    range_ = channelRange(ranged_, choice_.channel, *reference(), *product());
    value_map = ranged_.map(*range_, product()->channel(choice_.channel)->limits.offset);
  } else if (choice_.mode == ColorMode::Axis && fixed_from_points) {
    range_ = axisRange(ranged_, choice_.axis, *product(), *fixed_from_points);
    fixed_from_points_ = *fixed_from_points;
    axis_map = axisMap(ranged_, *range_, choice_.axis, *fixed_from_points, product()->converted().origin);
  }
  state_.setMode(choice_.mode, value_map);
  state_.setAxisMap(axis_map);
}

void PointCloudLayer::setColorArrays() {
  const bool has_points = product()->converted().points > 0;
  const bool is_rgb = has_points && choice_.mode == ColorMode::Rgb;
  const bool is_value = has_points && choice_.mode == ColorMode::Value;
  geometry_->setColorArray(is_rgb ? product()->colors() : nullptr);
  geometry_->setVertexAttribArray(CloudState::kValueAttribute,
                                  is_value ? product()->channel(choice_.channel)->values.get() : nullptr);
}

Status PointCloudLayer::remark() const {
  if (choice_.is_missing) {
    const std::string known = fieldNames(product()->hasColors(), product()->channels());
    return {StatusLevel::Info, "UnknownField",
            loadedText() + "no field '" + chosen().color_field + "' to colour by; there are x, y, z" +
                (known == "none" ? "" : ", " + known)};
  }
  const ConvertedCloud& cloud = product()->converted();
  if (const std::size_t dropped = cloud.not_finite + cloud.out_of_reach; dropped > 0) {
    std::string why = cloud.out_of_reach == 0 ? "a NaN or infinite coordinate" : "farther than 1e15 m";
    if (cloud.not_finite > 0 && cloud.out_of_reach > 0) {
      why = std::to_string(cloud.not_finite) + " with a NaN or infinite coordinate, " +
            std::to_string(cloud.out_of_reach) + " farther than 1e15 m";
    }
    return {StatusLevel::Info, "PointsDropped",
            loadedText() + std::to_string(dropped) + " of " + std::to_string(dropped + cloud.points) +
                " points are not drawn: " + why};
  }
  if (cloud.points == 0) {
    const std::size_t beams = product()->supplement().left_out;
    return beams == 0 ? Status{StatusLevel::Info, "NoPoints", loadedText() + "the message has no points"}
                      : Status{StatusLevel::Info, "NoReturns",
                               loadedText() + "none of its " + std::to_string(beams) +
                                   " ranges is finite and within range_min and range_max"};
  }
  return feedRemark();
}

std::optional<scenegraph::ColorLegend> PointCloudLayer::legend() const {
  if (!range_ || product()->converted().points == 0) {
    return std::nullopt;
  }
  return choice_.mode == ColorMode::Value
             ? chosen().legend(choice_.channel, "", *range_)
             : chosen().legend(axisTitle(choice_.axis, context().frames.fixedFrame()), "m", *range_);
}

std::function<scenegraph::ValueHistogram()> PointCloudLayer::histogramWork() const {
  if (!legend()) {
    return nullptr;
  }
  if (choice_.mode == ColorMode::Value) {
    return [cloud = product(), channel = choice_.channel] {
      const CloudChannel& values = *cloud->channel(channel);
      return histogramOf({values.values->asVector().data(), values.values->size()}, values.limits.offset);
    };
  }
  return [cloud = product(), axis = choice_.axis, fixed_from_points = fixed_from_points_] {
    const osg::Vec3Array& positions = *cloud->positions();
    const glm::dmat4 matrix = tf::toMatrix(fixed_from_points);
    return histogramAlong({positions.front().ptr(), 3 * positions.size()},
                          {matrix[0][axis], matrix[1][axis], matrix[2][axis]},
                          tf::transformPoint(fixed_from_points, cloud->converted().origin)[axis]);
  };
}

scenegraph::LayerCounts PointCloudLayer::counts() const {
  if (product() == nullptr) {
    return {{"points", 0}, {"dropped", 0}, {"bytes", 0}};
  }
  const ConvertedCloud& cloud = product()->converted();
  return {{"points", cloud.points + cloud.out_of_reach},
          {"dropped", cloud.not_finite + product()->supplement().left_out},
          {"bytes", product()->messageBytes()}};
}

std::vector<scenegraph::SettingSpec> PointCloudLayer::settingSpecs() const {
  auto specs = SampleLayer::settingSpecs();
  if (reference() != nullptr) {
    offerFields(specs.front(), reference()->hasColors(), reference()->channels());
  }
  return specs;
}

}  // namespace stillframe::nodes
