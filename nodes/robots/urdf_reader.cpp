#include "nodes/robots/urdf_reader.h"

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nodes/robots/urdf_scan.h"

namespace stillframe::nodes {
namespace {

using scenegraph::Status;
using scenegraph::StatusLevel;

constexpr double kMaxSize = 1e9;  // m
constexpr std::size_t kMaxRemarks = 500;

/// Takes what urdfdom would print, for as long as it lives.
class Console final : public console_bridge::OutputHandler {
 public:
  Console() : lock_(mutex()) { console_bridge::useOutputHandler(this); }
  ~Console() override { console_bridge::restorePreviousOutputHandler(); }
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/, int /*line*/) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && first_.empty()) {
      first_ = text.substr(0, 300);
    }
  }
  [[nodiscard]] const std::string& firstError() const { return first_; }

 private:
  static std::mutex& mutex() {
    static std::mutex one_at_a_time;
    return one_at_a_time;
  }
  std::scoped_lock<std::mutex> lock_;
  std::string first_;
};

glm::dvec3 toGlm(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

tf::RigidTransform toTransform(const urdf::Pose& pose) {
  glm::dquat rotation(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z);
  const double length = glm::length(rotation);
  rotation = length > 0.0 && std::isfinite(length) ? rotation / length : glm::dquat(1, 0, 0, 0);
  return {rotation, toGlm(pose.position)};
}

bool isLength(double x) { return x > 0.0 && x <= kMaxSize; }

class Converter {
 public:
  Converter(const urdf::ModelInterface& model, const ScannedUrdf& scanned) : model_(model), scanned_(scanned) {}

  Robot run() {
    robot_.name = model_.getName();
    addLink(*model_.getRoot(), -1);
    for (std::size_t next = 0; next < robot_.links.size(); ++next) {  // grows: breadth first, without recursion
      const urdf::LinkConstSharedPtr link = model_.getLink(robot_.links[next].name);
      for (const urdf::JointSharedPtr& joint : link->child_joints) {
        const urdf::LinkConstSharedPtr child = model_.getLink(joint->child_link_name);
        if (child == nullptr || index_of_link_.contains(child->name)) {
          remark("joint '" + joint->name + "' leads to no link of its own");
          continue;
        }
        addJoint(*joint, static_cast<std::uint32_t>(next));
        addLink(*child, static_cast<std::int32_t>(robot_.joints.size() - 1));
        robot_.joints.back().child_link = static_cast<std::uint32_t>(robot_.links.size() - 1);
      }
    }
    addMimics();
    return std::move(robot_);
  }

 private:
  void remark(const std::string& what) {
    if (robot_.remarks.size() < kMaxRemarks) {
      robot_.remarks += (robot_.remarks.empty() ? "" : "; ") + what;
    }
  }

  void addLink(const urdf::Link& from, std::int32_t parent_joint) {
    index_of_link_.emplace(from.name, robot_.links.size());
    RobotLink link{.name = from.name, .parent_joint = parent_joint, .visuals = {}, .collisions = {}};
    for (std::size_t i = 0; i < from.visual_array.size(); ++i) {
      const urdf::Visual& visual = *from.visual_array[i];
      if (auto shape = makeShape(visual.geometry.get(), visual.origin, from.name, true, i)) {
        if (visual.material != nullptr) {
          const urdf::Color& c = visual.material->color;
          const auto unit = [](float x) { return x >= 0.0F ? std::min(x, 1.0F) : 0.0F; };  // NaN is 0
          shape->color = scenegraph::Color{unit(c.r), unit(c.g), unit(c.b), unit(c.a)};
          shape->texture_uri = visual.material->texture_filename;
          if (!shape->texture_uri.empty() && c.r + c.g + c.b <= 0.0F) {
            shape->color = scenegraph::Color{};  // none was given: urdfdom's black would hide the texture
          }
        }
        link.visuals.push_back(std::move(*shape));
      }
    }
    for (std::size_t i = 0; i < from.collision_array.size(); ++i) {
      const urdf::Collision& collision = *from.collision_array[i];
      if (auto shape = makeShape(collision.geometry.get(), collision.origin, from.name, false, i)) {
        link.collisions.push_back(std::move(*shape));
      }
    }
    robot_.links.push_back(std::move(link));
  }

  std::optional<RobotShape> makeShape(const urdf::Geometry* geometry, const urdf::Pose& origin, const std::string& link,
                                      bool is_visual, std::size_t index) {
    RobotShape shape;
    shape.link_from_shape = toTransform(origin);
    const auto refused = [&](const char* why) {
      remark("a shape of link '" + link + "' is left out: " + why);
      return std::nullopt;
    };
    if (geometry == nullptr) {
      return refused("it has no geometry");
    }
    if (!tf::isFinite(shape.link_from_shape)) {
      return refused("its origin is not finite");
    }
    bool is_good = true;
    switch (geometry->type) {
      case urdf::Geometry::BOX:
        shape.size = toGlm(static_cast<const urdf::Box*>(geometry)->dim);
        break;
      case urdf::Geometry::SPHERE:
        shape.kind = RobotShapeKind::Sphere;
        shape.size = glm::dvec3(2.0 * static_cast<const urdf::Sphere*>(geometry)->radius);
        break;
      case urdf::Geometry::CYLINDER: {
        const auto* const cylinder = static_cast<const urdf::Cylinder*>(geometry);
        shape.kind =
            scanned_.capsules.contains({link, is_visual, index}) ? RobotShapeKind::Capsule : RobotShapeKind::Cylinder;
        shape.size = {2.0 * cylinder->radius, 2.0 * cylinder->radius, cylinder->length};
        break;
      }
      case urdf::Geometry::MESH: {
        const auto* const mesh = static_cast<const urdf::Mesh*>(geometry);
        shape.kind = RobotShapeKind::Mesh;
        shape.size = toGlm(mesh->scale);
        shape.mesh_uri = mesh->filename;
        is_good = std::abs(shape.size.x) <= kMaxSize && std::abs(shape.size.y) <= kMaxSize &&
                  std::abs(shape.size.z) <= kMaxSize && !shape.mesh_uri.empty();
        break;
      }
      default:
        return refused("its geometry is of a kind that URDF does not know");
    }
    if (shape.kind != RobotShapeKind::Mesh) {
      is_good = isLength(shape.size.x) && isLength(shape.size.y) && isLength(shape.size.z);
    }
    return is_good ? std::optional(std::move(shape)) : refused("its size is not a positive length");
  }

  void addJoint(const urdf::Joint& from, std::uint32_t parent_link) {
    RobotJoint joint;
    joint.name = from.name;
    joint.parent_link = parent_link;
    joint.parent_from_joint = toTransform(from.parent_to_joint_origin_transform);
    if (!tf::isFinite(joint.parent_from_joint)) {
      remark("the origin of joint '" + from.name + "' is not finite");
      joint.parent_from_joint = {};
    }
    switch (from.type) {
      case urdf::Joint::REVOLUTE:
        joint.kind = RobotJointKind::Revolute;
        break;
      case urdf::Joint::CONTINUOUS:
        joint.kind = RobotJointKind::Continuous;
        break;
      case urdf::Joint::PRISMATIC:
        joint.kind = RobotJointKind::Prismatic;
        break;
      case urdf::Joint::PLANAR:
        joint.kind = RobotJointKind::Planar;
        break;
      case urdf::Joint::FLOATING:
        joint.kind = RobotJointKind::Floating;
        break;
      default:
        break;
    }
    const glm::dvec3 axis = toGlm(from.axis);
    const double largest = std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
    if (largest > 0.0 && std::isfinite(largest)) {
      joint.axis = glm::normalize(axis / largest);
    } else if (joint.kind != RobotJointKind::Fixed && joint.kind != RobotJointKind::Floating) {
      remark("the axis of joint '" + from.name + "' has no direction");
    }
    const bool is_limited = joint.kind == RobotJointKind::Revolute || joint.kind == RobotJointKind::Prismatic;
    if (is_limited && from.limits != nullptr && from.limits->lower < from.limits->upper) {
      joint.limits = {from.limits->lower, from.limits->upper};
    }
    robot_.joints.push_back(std::move(joint));
  }

  void addMimics() {
    std::map<std::string, std::uint32_t> index_of_joint;
    for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
      index_of_joint.emplace(robot_.joints[i].name, static_cast<std::uint32_t>(i));
    }
    for (RobotJoint& joint : robot_.joints) {
      const urdf::JointConstSharedPtr from = model_.getJoint(joint.name);
      if (from == nullptr || from->mimic == nullptr) {
        continue;
      }
      const auto master = index_of_joint.find(from->mimic->joint_name);
      if (master == index_of_joint.end()) {
        remark("joint '" + joint.name + "' mimics '" + from->mimic->joint_name + "', which there is not");
      } else {
        joint.mimic = {master->second, from->mimic->multiplier, from->mimic->offset};
      }
    }
  }

  const urdf::ModelInterface& model_;
  const ScannedUrdf& scanned_;
  Robot robot_;
  std::map<std::string, std::size_t> index_of_link_;
};

/// Links hold one another both ways where the description is no tree: nothing would free them.
void breakLoops(urdf::ModelInterface& model) {
  for (auto& [name, link] : model.links_) {
    link->child_links.clear();
    link->child_joints.clear();
  }
}

}  // namespace

std::size_t Robot::byteSize() const noexcept {
  std::size_t bytes = sizeof(*this) + joints.size() * (sizeof(RobotJoint) + 32);
  for (const RobotLink& link : links) {
    bytes +=
        sizeof(link) + link.name.size() + (link.visuals.size() + link.collisions.size()) * (sizeof(RobotShape) + 64);
  }
  return bytes;
}

std::expected<Robot, Status> readUrdf(std::string_view text) {
  const auto scanned = scanUrdf(text);
  if (!scanned) {
    return std::unexpected(scanned.error());
  }
  std::string why;
  try {
    const Console console;
    const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(scanned->text);
    if (model != nullptr && model->getRoot() != nullptr) {
      Robot robot = Converter(*model, *scanned).run();
      breakLoops(*model);
      if (!console.firstError().empty()) {
        robot.remarks += (robot.remarks.empty() ? "" : "; ") + console.firstError();
      }
      return robot;
    }
    why = console.firstError();
  } catch (const std::exception& error) {
    why = error.what();
  }
  return std::unexpected(Status{StatusLevel::Error, "UrdfMalformed",
                                "the URDF cannot be read" + (why.empty() ? std::string() : ": " + why)});
}

}  // namespace stillframe::nodes
