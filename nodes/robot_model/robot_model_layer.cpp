#include "nodes/robot_model/robot_model_layer.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "nodes/meshes/import_process.h"
#include "nodes/osg_math.h"
#include "scenegraph/objects/robot_description.h"
#include "scenegraph/placement.h"
#include "scenegraph/store/tf_clock.h"
#include "tf/frame_names.h"

namespace stillframe::nodes {

using scenegraph::Status;
using scenegraph::StatusLevel;

namespace {

constexpr std::size_t kMostLinkRows = 500;  // a longer list is no list: the command line still reaches every link

std::vector<std::filesystem::path> pathsOf(const std::string& text) {
  std::vector<std::filesystem::path> paths;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(':', at), text.size());
    if (end > at) {
      paths.emplace_back(text.substr(at, end - at));
    }
    at = end + 1;
  }
  return paths;
}

}  // namespace

std::unique_ptr<scenegraph::Layer> RobotModelLayer::create(std::string_view topic) {
  return std::make_unique<RobotModelLayer>(topic);
}

RobotModelLayer::~RobotModelLayer() = default;

void RobotModelLayer::attach(const scenegraph::LayerContext& context) {
  context_.emplace(context);
  feed_.emplace(context);
}

void RobotModelLayer::detach() {
  if (context_) {
    clear();
  }
  loader_.reset();
  loader_tag_.clear();
  feed_.reset();
  context_.reset();
}

void RobotModelLayer::changeVisible(bool visible) {
  visible_ = visible;
  if (!visible && context_) {
    clear();
  }
}

void RobotModelLayer::clear() {
  show(nullptr);
  status_ = {};
  bounds_.init();
}

/// Other parts, other folders or other axes make another product.
void RobotModelLayer::openLoader() {
  const std::string tag = std::string("robot") + (settings_.visual ? " visual" : "") +
                          (settings_.collision ? " collision" : "") + " " + settings_.collada_up_axis + " " +
                          settings_.package_path;
  if (loader_ && tag == loader_tag_) {
    return;
  }
  loader_tag_ = tag;
  const RobotScene::Options options{.has_visuals = settings_.visual,
                                    .has_collisions = settings_.collision,
                                    .meshes = {.use_collada_up_axis = settings_.collada_up_axis == "file"}};
  loader_.emplace(
      *context_, scenegraph::ObjectType::RobotDescription, topic_, tag,
      [dataset = context_->dataset.shared_from_this(), paths = pathsOf(settings_.package_path), options](
          const scenegraph::AnyObject& object, const scenegraph::Entry&) -> std::expected<RobotScene, Status> {
        const MeshLoader meshes(dataset->cache(), dataset->resources(), paths);
        return RobotScene::make(*object.get<scenegraph::RobotDescription>(), meshes, options);
      });
}

void RobotModelLayer::update(const scenegraph::Tick& tick) {
  if (!context_ || !visible_) {
    return;
  }
  openLoader();
  (void)loader_->update(tick.time);
  const bool is_on_its_way = loader_->product() == nullptr && loader_->isPending();
  if (!is_on_its_way && loader_->product() != scene_) {
    show(loader_->product());
    noteOtherSettings();
  }
  bounds_.init();
  if (scene_ != nullptr) {
    paint();
    place(tick);
  }
  status_ = judge();
}

void RobotModelLayer::show(std::shared_ptr<const RobotScene> scene) {
  for (LinkNode& link : nodes_) {
    hang(link, std::nullopt);
  }
  nodes_.clear();
  places_.clear();
  painted_.reset();
  tally_ = {};
  if (scene_ != nullptr) {
    scene_->releaseGlObjects();
  }
  scene_ = std::move(scene);
}

std::string RobotModelLayer::frameOf(const std::string& link) const {
  const std::string& prefix = settings_.tf_prefix;
  const bool is_joined = prefix.empty() || prefix.ends_with('/') || prefix.ends_with('_');
  return std::string(tf::stripLeadingSlashes(prefix + (is_joined ? "" : "/") + link));
}

/// Makes the nodes anew where colours, parts or frames changed, and sets opacities otherwise.
void RobotModelLayer::paint() {
  if (painted_ == settings_) {
    return;
  }
  const bool is_same_shape =
      painted_ && painted_->visual == settings_.visual && painted_->collision == settings_.collision &&
      painted_->default_color == settings_.default_color && painted_->collision_color == settings_.collision_color &&
      painted_->tf_prefix == settings_.tf_prefix;
  if (!is_same_shape) {
    for (LinkNode& link : nodes_) {
      hang(link, std::nullopt);
    }
    nodes_.clear();
    for (std::size_t i = 0; i < scene_->links().size(); ++i) {
      LinkNode link;
      link.frame = frameOf(scene_->robot().links[i].name);
      link.node = new osg::MatrixTransform;
      link.node->setName(scene_->robot().links[i].name);
      link.node->setStateSet(link.state.stateSet());
      const auto add = [&](const std::vector<RobotPiece>& pieces, bool is_collision) {
        for (const RobotPiece& piece : pieces) {
          const osg::ref_ptr<osg::MatrixTransform> at = new osg::MatrixTransform(piece.link_from_mesh);
          const scenegraph::Color color = piece.is_placeholder ? kPlaceholderColor
                                          : is_collision       ? settings_.collision_color
                                                               : piece.color.value_or(settings_.default_color);
          at->addChild(piece.mesh->makeNode(color, is_collision || piece.is_placeholder));
          link.node->addChild(at);
          link.triangles += piece.mesh->triangleCount();
        }
      };
      if (settings_.visual) {
        add(scene_->links()[i].visuals, false);
      }
      if (settings_.collision) {
        add(scene_->links()[i].collisions, true);
      }
      nodes_.push_back(std::move(link));
    }
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto own = settings_.links.find(scene_->robot().links[i].name);
    const RobotLinkSettings link = own == settings_.links.end() ? RobotLinkSettings{} : own->second;
    nodes_[i].state.setOpacity(settings_.opacity * link.opacity);
    nodes_[i].is_visible = link.is_visible && settings_.opacity * link.opacity > 0.0;
  }
  painted_ = settings_;
}

JointPoses RobotModelLayer::jointPoses(const scenegraph::Tick& tick) {
  const Robot& robot = scene_->robot();
  tally_.is_at_zero = settings_.joints == "zero";
  if (settings_.joints == "zero") {
    return poseJoints(robot, {}, true);
  }
  if (settings_.joints == "tf") {
    return poseJoints(robot, {}, false);
  }
  feed_->update(tick.time, settings_.joint_topic, topic_);
  if (const JointSample* const sample = feed_->sample()) {
    return poseJoints(robot, sample->positions, false);
  }
  // Nothing ever tells of its joints: shown as it is described, and the status says so.
  const bool is_untold = settings_.joints == "auto" && feed_->topic().empty() &&
                         std::ranges::none_of(robot.joints, [&](const RobotJoint& joint) {
                           return joint.kind != RobotJointKind::Fixed &&
                                  context_->frames.buffer().findFrame(nodes_[joint.child_link].frame).has_value();
                         });
  JointPoses poses = poseJoints(robot, {}, is_untold);
  tally_.is_at_zero = is_untold && poses.unknown > 0;
  return poses;
}

std::vector<LinkByTf> RobotModelLayer::lookUp() {
  std::vector<LinkByTf> by_tf(nodes_.size(), LinkByTf::Unknown);
  const bool is_root_alone = settings_.joints == "joint_states" || settings_.joints == "zero";
  for (std::size_t i = 0; i < (is_root_alone ? std::min<std::size_t>(1, nodes_.size()) : nodes_.size()); ++i) {
    const auto fixed_from_link = context_->frames.fixedFromFrame(nodes_[i].frame);
    by_tf[i] = fixed_from_link                                                   ? LinkByTf::Placed
               : fixed_from_link.error().code == tf::LookupError::NoSampleAtTime ? LinkByTf::Absent
                                                                                 : LinkByTf::Unknown;
  }
  return by_tf;
}

void RobotModelLayer::place(const scenegraph::Tick& tick) {
  tally_ = {};
  const JointPoses joints = jointPoses(tick);
  const std::vector<LinkByTf> by_tf = lookUp();
  places_ = placeLinks(scene_->robot(), by_tf, joints);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    LinkNode& link = nodes_[i];
    if (!places_[i]) {
      hang(link, std::nullopt);
      if (!tally_.first_unplaced) {
        tally_.first_unplaced = i;
      }
      continue;
    }
    const LinkPlace& at = *places_[i];
    const bool is_by_kinematics = at.seed != i;
    ++tally_.placed;
    tally_.by_kinematics += is_by_kinematics ? 1 : 0;
    const bool is_drawn = link.is_visible && link.triangles > 0;
    hang(link, is_drawn ? std::optional(nodes_[at.seed].frame) : std::nullopt);
    if (!is_drawn) {
      continue;
    }
    if (const osg::Matrixd seed_from_link = toOsg(at.seed_from_link); link.node->getMatrix() != seed_from_link) {
      link.node->setMatrix(seed_from_link);
    }
    if (const auto fixed_from_seed = context_->frames.fixedFromFrame(nodes_[at.seed].frame)) {
      const tf::RigidTransform fixed_from_link = *fixed_from_seed * at.seed_from_link;
      for (const auto& [box, is_shown] : {std::pair{scene_->links()[i].visual_box, settings_.visual},
                                          std::pair{scene_->links()[i].collision_box, settings_.collision}}) {
        for (unsigned corner = 0; is_shown && box.valid() && corner < 8; ++corner) {
          const osg::Vec3d p = box.corner(corner);
          bounds_.expandBy(toOsg(tf::transformPoint(fixed_from_link, {p.x(), p.y(), p.z()})));
        }
      }
    }
  }
  tally_.clamped = tally_.by_kinematics > 0 ? joints.clamped : 0;
  tally_.is_at_zero = tally_.is_at_zero && tally_.by_kinematics > 0;
  if (tally_.first_unplaced) {
    // Of a robot without any place it is the root that tells the reason best, else the first link that is absent.
    if (const auto lookup = context_->frames.fixedFromFrame(nodes_[*tally_.first_unplaced].frame); !lookup) {
      tally_.failure = lookup.error();
    }
  }
}

void RobotModelLayer::hang(LinkNode& link, const std::optional<std::string>& anchor) {
  if (link.anchor == anchor) {
    return;
  }
  if (link.anchor) {
    context_->frames.unhang(link.anchor, *link.node);
  }
  link.anchor = anchor;
  if (link.anchor) {
    context_->frames.hang(link.anchor, *link.node);
  }
}

/// Why a link has no place, of a robot of which others have: by its frame, or by the joint above it.
std::string RobotModelLayer::unplacedText(std::size_t link) const {
  using enum tf::LookupError;
  const bool is_known =
      tally_.failure && tally_.failure->code != UnknownSource && tally_.failure->code != UnknownTarget;
  const auto joint = std::ranges::find(scene_->robot().joints, link, &RobotJoint::child_link);
  if (is_known || joint == scene_->robot().joints.end()) {
    return tally_.failure ? scenegraph::placementStatus(context_->frames, nodes_[link].frame, *tally_.failure).message
                          : "nothing tells where '" + nodes_[link].frame + "' is";
  }
  const std::string topic = feed_ ? feed_->topic() : "";
  return "no transform names the frame '" + nodes_[link].frame + "', and no joint state" +
         (topic.empty() ? "" : " on '" + topic + "'") + " tells of the joint '" + joint->name +
         "'; the setting joints=zero shows it at zero";
}

Status RobotModelLayer::judge() const {
  if (scene_ == nullptr || loader_->status().level == StatusLevel::Error) {
    Status status = loader_->status();
    if (status.code == "Decoding") {
      const ImportLimits limits = importLimits(0);
      status.message += ", with its meshes; one that is not read within " + std::to_string(limits.cpu_s) +
                        " s of computing, or " + std::to_string(limits.wall_s) +
                        " s in all, is given up (large ones have longer)";
    }
    return status;
  }
  if (tally_.placed == 0 && tally_.failure) {
    return scenegraph::placementStatus(context_->frames, nodes_.front().frame, *tally_.failure);
  }
  if (loader_->status().level != StatusLevel::Ok) {
    return loader_->status();
  }
  const std::string sample = "'" + topic_ + "' at " + scenegraph::timeText(loader_->entry()->log_time) + ": ";
  if (tally_.first_unplaced) {
    return {StatusLevel::Warn, "LinksUnplaced",
            sample + std::to_string(nodes_.size() - tally_.placed) + " of " + std::to_string(nodes_.size()) +
                " links have no place and are not drawn: " + unplacedText(*tally_.first_unplaced)};
  }
  for (const auto& [name, link] : settings_.links) {
    if (std::ranges::find(scene_->robot().links, name, &RobotLink::name) == scene_->robot().links.end()) {
      return {StatusLevel::Info, "UnknownLink",
              sample + "the settings name the link '" + name + "', which the robot does not have"};
    }
  }
  if (!scene_->faults().empty()) {
    return {StatusLevel::Warn, scene_->faults().front().status.code, sample + faultText()};
  }
  const bool has_visuals =
      std::ranges::any_of(scene_->robot().links, [](const RobotLink& l) { return !l.visuals.empty(); });
  const bool has_shapes =
      std::ranges::any_of(scene_->robot().links, [](const RobotLink& l) { return !l.collisions.empty(); });
  if (!has_visuals && !(has_shapes && settings_.collision)) {
    return {StatusLevel::Info, "NoVisuals",
            sample + (has_shapes ? "none of its links has a visual shape; its collision shapes are seen with "
                                   "'collision' on"
                                 : "none of its links has a shape: there is nothing to draw")};
  }
  if (tally_.by_kinematics > 0) {
    return {StatusLevel::Info, tally_.is_at_zero ? "JointsAtZero" : "ForwardKinematics", sample + kinematicsText()};
  }
  if (!scene_->remarks().empty()) {
    return {StatusLevel::Info, "RobotRemarks", sample + scene_->remarks()};
  }
  return {};
}

scenegraph::LayerCounts RobotModelLayer::counts() const {
  std::uint64_t triangles = 0;
  for (const LinkNode& link : nodes_) {
    triangles += link.anchor ? link.triangles : 0;
  }
  return {{"links", nodes_.size()},
          {"placed", tally_.placed},
          {"by_kinematics", tally_.by_kinematics},
          {"meshes", scene_ != nullptr ? scene_->meshCount() : 0},
          {"missing_meshes", scene_ != nullptr ? scene_->faults().size() : 0},
          {"triangles", triangles}};
}

std::string RobotModelLayer::sourceFrame() const { return nodes_.empty() ? "" : nodes_.front().frame; }

bool RobotModelLayer::isPending() const {
  return visible_ && context_ && ((loader_ && loader_->isPending()) || (feed_ && feed_->isPending()));
}

std::vector<scenegraph::SettingSpec> RobotModelLayer::settingSpecs() const {
  auto specs = robotModelSettingsTable().specs();
  for (const auto& [key, text] : settings()) {
    if (key.starts_with("link.") && key.ends_with(".visible")) {
      constexpr std::size_t kAround = std::string_view("link..visible").size();
      addLinkSpecs(key.substr(5, key.size() - kAround), specs);
    }
  }
  return specs;
}

scenegraph::SettingTexts RobotModelLayer::settings() const {
  auto texts = robotModelSettingsTable().texts(settings_);
  for (std::size_t i = 0; i < std::min(nodes_.size(), kMostLinkRows); ++i) {
    addLinkTexts(scene_->robot().links[i].name, {}, texts);
  }
  for (const auto& [link, own] : settings_.links) {
    addLinkTexts(link, own, texts);
  }
  return texts;
}

std::expected<void, scenegraph::SettingError> RobotModelLayer::changeSettings(const scenegraph::SettingTexts& texts) {
  RobotModelSettings changed = settings_;
  scenegraph::SettingTexts others = texts;
  if (const auto taken = takeLinkTexts(others, changed); !taken) {
    return taken;
  }
  if (const auto applied = robotModelSettingsTable().apply(others, changed); !applied) {
    return applied;
  }
  settings_ = std::move(changed);
  return {};
}

}  // namespace stillframe::nodes
