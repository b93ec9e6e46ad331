// The robot's description, and the states of its arm, which no transform tells of.
#include <array>
#include <cmath>
#include <string>

#include "tools/ingest/cdr_writer.h"
#include "tools/sample/definition_text.h"
#include "tools/sample/topic.h"

namespace stillframe::sample {
namespace {

constexpr std::string_view kMaterials = R"(<material name="body"><color rgba="0.18 0.4 0.62 1"/></material>
<material name="dark"><color rgba="0.16 0.17 0.19 1"/></material><material name="light"><color rgba="0.85 0.86 0.88 1"/></material>
<material name="warn"><color rgba="0.95 0.7 0.1 1"/></material><material name="glass"><color rgba="0.6 0.85 1 0.45"/></material>
)";

std::string link(const std::string& name, const std::string& shapes) {
  return "<link name=\"" + name + "\">" + shapes + "</link>\n";
}
std::string visual(const std::string& xyz, const std::string& geometry, const std::string& material,
                   const std::string& rpy = "0 0 0") {
  return "<visual><origin xyz=\"" + xyz + "\" rpy=\"" + rpy + "\"/><geometry><" + geometry +
         "/></geometry><material name=\"" + material + "\"/></visual>";
}
std::string collision(const std::string& xyz, const std::string& geometry) {
  return "<collision><origin xyz=\"" + xyz + "\"/><geometry><" + geometry + "/></geometry></collision>";
}
std::string joint(const std::string& name, const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& xyz, const std::string& more = "") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent + "\"/><child link=\"" + child +
         "\"/><origin xyz=\"" + xyz + "\"/>" + more + "</joint>\n";
}

std::string urdf() {
  const std::string wheel = visual("0 0 0", "cylinder radius=\"0.15\" length=\"0.06\"", "dark", "1.5707963 0 0");
  const std::string limits = R"(<limit lower="-1.2" upper="1.2" effort="1" velocity="1"/>)";
  return "<?xml version=\"1.0\"?>\n<robot name=\"courier\">\n" + std::string(kMaterials) +
         link("base_link", visual("0 0 0.25", "box size=\"0.62 0.44 0.24\"", "body") +
                               visual("-0.1 0 0.62", "box size=\"0.3 0.36 0.5\"", "light") +
                               visual("0.31 0 0.16", "capsule radius=\"0.04\" length=\"0.001\"", "warn") +
                               collision("0 0 0.45", "box size=\"0.7 0.6 0.9\"")) +
         link("left_wheel", wheel) + link("right_wheel", wheel) +
         link("lidar_link", visual("0 0 0", "cylinder radius=\"0.06\" length=\"0.08\"", "dark")) +
         link("camera_link", visual("0 0 0", "box size=\"0.03 0.12 0.03\"", "dark")) +
         link("rear_camera_link", visual("0 0 0", "box size=\"0.03 0.12 0.03\"", "dark")) +
         link("scan_link", visual("0 0 0", "cylinder radius=\"0.05\" length=\"0.05\"", "warn")) +
         link("lamp_link", visual("0 0 0.05", "sphere radius=\"0.05\"", "glass")) +
         link("arm_link", visual("0 0 0.14", "capsule radius=\"0.03\" length=\"0.22\"", "warn")) +
         link("hand_link", visual("0 0 0.08", "cylinder radius=\"0.02\" length=\"0.16\"", "light")) +
         joint("left_wheel_joint", "continuous", "base_link", "left_wheel", "0 0.26 0.15", "<axis xyz=\"0 1 0\"/>") +
         joint("right_wheel_joint", "continuous", "base_link", "right_wheel", "0 -0.26 0.15", "<axis xyz=\"0 1 0\"/>") +
         joint("lidar_joint", "fixed", "base_link", "lidar_link", "0.05 0 0.95") +
         joint("camera_joint", "fixed", "base_link", "camera_link", "0.32 0 0.6") +
         joint("rear_camera_joint", "fixed", "base_link", "rear_camera_link", "-0.32 0 0.7") +
         joint("scan_joint", "fixed", "base_link", "scan_link", "0.3 0 0.25") +
         joint("lamp_joint", "fixed", "base_link", "lamp_link", "-0.15 0.12 0.87") +
         joint("arm_joint", "revolute", "base_link", "arm_link", "0.2 0 0.37", "<axis xyz=\"0 1 0\"/>" + limits) +
         joint("hand_joint", "revolute", "arm_link", "hand_link", "0 0 0.28",
               "<axis xyz=\"0 1 0\"/>" + limits + R"(<mimic joint="arm_joint" multiplier="-0.8" offset="0.4"/>)") +
         "</robot>\n";
}

class Description final : public Topic {
 public:
  std::string_view name() const override { return "/robot_description"; }
  Ros2Type type() const override { return {"std_msgs/msg/String", "string data\n"}; }
  std::int64_t periodNs() const override { return 0; }
  std::vector<std::byte> message(std::int64_t /*elapsed_ns*/) const override {
    ingest::CdrWriter cdr;
    cdr.string(urdf());
    return cdr.bytes();
  }
};

/// The arm nods, ten times a second.
class ArmStates final : public Topic {
 public:
  explicit ArmStates(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/joint_states"; }
  Ros2Type type() const override {
    return {"sensor_msgs/msg/JointState",
            "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] "
            "effort\n" STILLFRAME_HEADER};
  }
  std::int64_t periodNs() const override { return 100'000'000; }
  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    ingest::CdrWriter cdr;
    cdr.header(stage_.start_ns + elapsed_ns, "");
    cdr.length(1).string("arm_joint");
    cdr.length(1).number(0.6 + 0.5 * std::sin(static_cast<double>(elapsed_ns) * 1e-9));
    cdr.length(0).length(0);
    return cdr.bytes();
  }

 private:
  Stage stage_;
};

}  // namespace

std::unique_ptr<Topic> makeRobotDescription() { return std::make_unique<Description>(); }
std::unique_ptr<Topic> makeArmStates(const Stage& stage) { return std::make_unique<ArmStates>(stage); }

}  // namespace stillframe::sample
