// std_msgs/String that describes a robot, and sensor_msgs/JointState.
#include "scenegraph/objects/robot_description.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/robot_text.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/shapes.h"

namespace stillframe::ingest::converters {

namespace {

using scenegraph::JointStates;
using scenegraph::RobotDescription;

struct JointsRow {
  JointStates joints;
  std::vector<std::string_view> names;
};

}  // namespace

Created rosRobotDescription(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&RobotDescription::text>("data");
  using Decoder = RowDecoder<RobotDescription>;
  return Decoder::create(schema, message_encoding, shape,
                         [](RobotDescription& robot, const MessageView&) -> Decoder::Result {
                           robot.format = robotFormat(robot.text);
                           return scenegraph::AnyObject::make(std::move(robot));
                         });
}

Created rosJointState(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&JointsRow::joints, &JointStates::stamp>("header.stamp")
      .field<&JointsRow::names>("name")
      .field<&JointsRow::joints, &JointStates::positions>("position");
  using Decoder = RowDecoder<JointsRow>;
  return Decoder::create(schema, message_encoding, shape, [](JointsRow& row, const MessageView&) -> Decoder::Result {
    row.joints.names.assign(row.names.begin(), row.names.end());
    return scenegraph::AnyObject::make(std::move(row.joints));
  });
}

}  // namespace stillframe::ingest::converters
