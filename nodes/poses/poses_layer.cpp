#include "nodes/poses/poses_layer.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "nodes/buffer_limit.h"
#include "nodes/points/value_histogram.h"
#include "scenegraph/how_many.h"
#include "scenegraph/store/tf_clock.h"

namespace stillframe::nodes {
namespace {

using scenegraph::howMany;
using scenegraph::PosesInFrame;
using scenegraph::PosesKind;
using scenegraph::Status;
using scenegraph::StatusLevel;

std::expected<ShownPoses, Status> convertPoses(const scenegraph::AnyObject& object, const PosesSettings&) {
  return ShownPoses{std::make_shared<const PoseSet>(object.get<PosesInFrame>()), nullptr};
}

/// Makes the line that the settings will ask for.
void preparePoses(const ShownPoses& shown, const PosesSettings& settings) {
  const PosesKind kind = shown.poses->source().kind;
  const bool is_line = kind == PosesKind::Path || kind == PosesKind::Polygon;
  if (settings.line == "on" || (settings.line == "auto" && is_line)) {
    (void)shown.poses->line(poseValueOf(settings.color_field));
  }
}

TrailWindow windowOf(const PosesSettings& settings) {
  TrailWindow window{.most = std::numeric_limits<std::size_t>::max()};
  if (settings.trail == "poses") {
    window.most = static_cast<std::size_t>(settings.trail_poses);
  } else if (settings.trail == "seconds") {
    window.seconds = settings.trail_seconds;
  }
  return window;
}

std::string posesText(std::size_t count) { return howMany(count, "poses"); }

/// "2 of 5 poses have no bottom"; `what` is said of one and of several.
std::string countText(std::size_t count, std::size_t of, const char* have, const char* what) {
  const char* const verb = count == 1 ? (std::string_view(have) == "are" ? "is" : "has") : have;
  return std::to_string(count) + " of " + posesText(of) + " " + verb + " " + what;
}

/// Sentences about a sample under one code, that of the first.
class Remarks {
 public:
  void add(const char* code, const std::string& text) {
    status_.message += status_.message.empty() ? text : "; " + text;
    if (status_.level == StatusLevel::Ok) {
      status_.level = StatusLevel::Info;
      status_.code = code;
    }
  }
  [[nodiscard]] Status take(const std::string& sample) {
    if (status_.level != StatusLevel::Ok) {
      status_.message = sample + status_.message;
    }
    return std::move(status_);
  }

 private:
  Status status_;
};

void remarkFaults(Remarks& remarks, const PoseSet& poses) {
  const PoseSet::Faults& faults = poses.faults();
  const std::size_t all = poses.source().poses.size();
  if (faults.not_finite > 0) {
    remarks.add("PosesNotFinite", countText(faults.not_finite, all, "have", "a NaN or infinite place: not drawn"));
  }
  if (faults.out_of_reach > 0) {
    remarks.add("PosesOutOfReach", countText(faults.out_of_reach, all, "are", "too far away to be drawn"));
  }
}

void remarkRotations(Remarks& remarks, const PoseSet& poses) {
  const PoseSet::Faults& faults = poses.faults();
  const std::size_t all = poses.source().poses.size();
  if (faults.bad_rotations > 0) {
    remarks.add("RotationsNotFinite", countText(faults.bad_rotations, all, "have", "a NaN or infinite rotation"));
  }
  if (faults.zero_rotations > 0) {
    remarks.add("ZeroRotation", countText(faults.zero_rotations, all, "have", "the rotation 0 0 0 0: drawn unturned"));
  }
  if (faults.unnormalised > 0) {
    remarks.add("UnnormalisedRotation",
                countText(faults.unnormalised, all, "have", "a rotation that is not of norm 1: drawn normalised"));
  }
}

void remarkCovariance(Remarks& remarks, const CovarianceReport& report) {
  const auto why = [](CovarianceError error) {
    return error == CovarianceError::NotFinite ? " has a NaN or an infinity"
                                               : " has a negative variance or a correlation beyond 1";
  };
  if (report.position) {
    remarks.add("BadCovariance", std::string("the covariance of the position") + why(*report.position));
  }
  if (report.rotation) {
    remarks.add("BadCovariance", std::string("the covariance of the rotation") + why(*report.rotation));
  }
  if (report.unbounded_axes > 0) {
    remarks.add("UnboundedCovariance", "the position is unknown along " + howMany(report.unbounded_axes, "axes") +
                                           " (a standard deviation beyond 300 m): the ellipsoid is flat there");
  }
}

void remarkTrail(Remarks& remarks, const PoseTrail& trail) {
  if (trail.other_frames > 0) {
    remarks.add("TrailInOtherFrames", posesText(trail.other_frames) + " of the trail " +
                                          (trail.other_frames == 1 ? "is" : "are") +
                                          " in another frame than the last one: not drawn");
  }
  if (trail.undecodable > 0) {
    remarks.add("TrailUndecodable", howMany(trail.undecodable, "messages") + " of the trail could not be decoded");
  }
  if (trail.is_cut) {
    remarks.add("TrailCut", "the trail is cut to its last " + std::to_string(PoseTrail::kMost) + " poses");
  }
}

}  // namespace

std::unique_ptr<scenegraph::Layer> PosesLayer::create(std::string_view topic) {
  return std::make_unique<PosesLayer>(topic);
}

PosesLayer::PosesLayer(std::string_view topic)
    : SampleLayer(topic,
                  {.type = scenegraph::ObjectType::PosesInFrame,
                   .tag = "poses",
                   .convert = &convertPoses,
                   .is_reference = [](const ShownPoses&) { return true; },
                   .prepare = &preparePoses},
                  posesSettingsTable()) {}

void PosesLayer::open(const scenegraph::LayerContext& context) {
  SampleLayer::open(context);
  shapes_.emplace(node());
  trails_.emplace(context, topic());
}

void PosesLayer::close() {
  SampleLayer::close();
  shapes_.reset();
  trails_.reset();
}

void PosesLayer::clear() {
  SampleLayer::clear();
  trails_->cancel();
  trail_ = nullptr;
  loaded_ = drawn_ = nullptr;
  trail_status_ = {};
}

void PosesLayer::show() {
  if (product() == nullptr) {
    shapes_->clear();  // else draw() follows, which keeps the meshes
  }
  reapply();
}

std::optional<TopicLayer::Anchor> PosesLayer::load(const scenegraph::Tick& tick) {
  if (buffer_texels_ != tick.buffer_texels) {
    buffer_texels_ = tick.buffer_texels;
    reapply();
  }
  return SampleLayer::load(tick);
}

PosesLayer::Shown PosesLayer::drawnOf(const Shown& loaded) {
  trail_status_ = {};
  const bool is_single = loaded != nullptr && (loaded->poses->source().kind == PosesKind::Single ||
                                               loaded->poses->source().kind == PosesKind::Point);
  std::shared_ptr<const PoseTrail> trail;
  if (!is_single || chosen().trail == "none") {
    trails_->cancel();
  } else if (trail = trails_->get(*loader().entry(), windowOf(chosen())); trail == nullptr) {
    trail_status_ = {StatusLevel::Warn, "Decoding", loadedText() + "the trail is being decoded"};
    return product();
  }
  if (loaded != loaded_ || trail != trail_) {
    loaded_ = loaded;
    trail_ = trail;
    drawn_ = trail == nullptr ? loaded : std::make_shared<const ShownPoses>(ShownPoses{loaded->poses, trail});
  }
  return drawn_;
}

TopicLayer::Anchor PosesLayer::anchorOf(const ShownPoses& shown) const {
  return {.frame = shown.poses->source().frame_id, .frame_from_data = {}};
}

void PosesLayer::draw(const Placement& /*fixed_from_data*/) {
  if (takeSettings()) {
    shapes_->build(*product()->poses, product()->trail.get(), chosen(), buffer_texels_);
  }
}

const Status& PosesLayer::sourceStatus() const {
  return trail_status_.level != StatusLevel::Ok && SampleLayer::sourceStatus().level == StatusLevel::Ok
             ? trail_status_
             : SampleLayer::sourceStatus();
}

std::optional<scenegraph::ColorLegend> PosesLayer::legend() const {
  const std::optional<ValueRange> range = shapes_ ? shapes_->lineRange() : std::nullopt;
  if (!range) {
    return std::nullopt;
  }
  const std::string& by = chosen().color_field;
  return chosen().legend(by, by == "time" ? "s" : by == "order" ? "" : "m", *range);
}

std::function<scenegraph::ValueHistogram()> PosesLayer::histogramWork() const {
  if (!legend() || product() == nullptr) {
    return nullptr;
  }
  return [shown = product(), by = poseValueOf(chosen().color_field)] {
    const PoseSet::Line& line = (shown->trail != nullptr ? shown->trail->poses : *shown->poses).line(by);
    return histogramOf({line.arrays.values->asVector().data(), line.arrays.values->size()}, line.offset);
  };
}

bool PosesLayer::isWorking() const { return SampleLayer::isWorking() || trails_->isPending(); }

std::optional<scenegraph::Picked> PosesLayer::describeData(const scenegraph::PickHit& hit) const {
  if (product() == nullptr) {
    return std::nullopt;
  }
  const PoseTrail* const trail = product()->trail.get();
  const auto found = shapes_->poseAt(hit, *product()->poses, trail, chosen());
  if (!found) {
    return std::nullopt;
  }
  const PoseSet& poses = found->is_of_trail ? trail->poses : *product()->poses;
  const PosesInFrame& source = poses.source();
  const auto point = found->index < source.poses.size() ? poses.point(found->index) : std::nullopt;
  if (!point) {
    return std::nullopt;
  }
  scenegraph::Picked picked{.kind = "pose",
                            .id = std::to_string(found->index),
                            .point_in_frame = *point,
                            .stamp = found->index < source.stamps.size() ? source.stamps[found->index] : source.stamp,
                            .fields = {},
                            .radius_m = std::max(1.0, 2.0 * chosen().length_m)};
  picked.add("part", found->part);
  picked.add("of", source.poses.size());
  picked.add("trail", found->is_of_trail);
  picked.addPose("", source.poses[found->index]);
  if (!source.child_frame_id.empty()) {
    picked.add("child_frame_id", source.child_frame_id);
  }
  if (source.covariance) {
    for (std::size_t i = 0; i < source.covariance->size(); ++i) {
      picked.add("covariance[" + std::to_string(i) + "]", (*source.covariance)[i]);
    }
  }
  return picked;
}

Status PosesLayer::remark() const {
  Remarks remarks;
  const PoseSet& poses = *product()->poses;
  const PoseSet& on_line = product()->trail != nullptr ? product()->trail->poses : poses;
  if (shapes_->texelsTooMany() > 0) {
    return bufferTooLarge(loadedText() + "its " + posesText(on_line.source().poses.size()), shapes_->texelsTooMany(),
                          buffer_texels_);
  }
  remarkFaults(remarks, on_line);
  if (on_line.source().poses.empty()) {
    remarks.add("NoPoses", "the message has no poses");
  } else if (chosen().line != "off" && !shapes_->box().valid() &&
             (poses.source().kind == PosesKind::Path || poses.source().kind == PosesKind::Polygon) &&
             on_line.faults().not_finite + on_line.faults().out_of_reach == 0) {
    remarks.add("NothingDrawn", posesText(on_line.source().poses.size()) +
                                    " at one place, which makes no line; with shape=triads it is seen");
  }
  if (shapes_->showsRotations()) {
    remarkRotations(remarks, poses);
  }
  remarkCovariance(remarks, shapes_->covariance());
  if (product()->trail != nullptr) {
    remarkTrail(remarks, *product()->trail);
  }
  if (chosen().color_field == "time" && shapes_->segments() > 0 && !on_line.hasTimes()) {
    remarks.add("NoPoseTimes", "the poses have no times of their own: coloured by their order");
  }
  if (shapes_->stride() > 1) {
    remarks.add("FewerShapes",
                "one pose in " + std::to_string(shapes_->stride()) + " has a shape: raise max_shapes to see others");
  }
  if (shapes_->isFillRefused()) {
    remarks.add("NotFilled", "the polygon has more than 1000 corners, or one that cannot be drawn: not filled");
  }
  return remarks.take(loadedText());
}

scenegraph::LayerCounts PosesLayer::counts() const {
  if (product() == nullptr) {
    return {{"poses", 0}, {"shapes", 0}, {"segments", 0}, {"trail", 0}, {"dropped", 0}};
  }
  const PoseSet& poses = *product()->poses;
  return {{"poses", poses.source().poses.size()},
          {"shapes", shapes_->shapes()},
          {"segments", shapes_->segments()},
          {"trail", product()->trail != nullptr ? product()->trail->poses.source().poses.size() : 0},
          {"dropped", poses.faults().not_finite + poses.faults().out_of_reach}};
}

}  // namespace stillframe::nodes
