#include "tools/ingest/robot_topics.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include "scenegraph/objects/robot_description.h"
#include "tests/tools/ingest/temporary_file.h"
#include "tools/ingest/mcap_writer.h"
#include "tools/ingest/recording.h"

namespace stillframe::ingest {
namespace {

using scenegraph::ObjectType;
using scenegraph::RobotDescription;
using test::TemporaryFile;

const std::string kRobot = "<robot name='r'><link name='base'/></robot>";

/// A recording of one message at 1000 ns, with a robot and a mesh attached.
std::unique_ptr<Recording> record(const TemporaryFile& file) {
  auto writer = McapWriter::open(file.path(), {});
  EXPECT_TRUE(writer);
  const auto channel = (*writer)->addChannel("/a", "pkg/A", "ros2msg", "int32 x", "cdr");
  EXPECT_TRUE((*writer)->write(channel, 1000, 1000, std::array{std::byte{0}}));
  EXPECT_TRUE((*writer)->attach("arm.urdf", "application/xml", 5000, std::as_bytes(std::span(kRobot))));
  EXPECT_TRUE((*writer)->attach("arm/meshes/a.stl", "model/stl", 5, std::as_bytes(std::span(kRobot))));
  EXPECT_TRUE((*writer)->finish());
  const std::array files{file.path()};
  auto recording = Recording::open(files);
  EXPECT_TRUE(recording);
  (*recording)->load();
  return std::move(*recording);
}

std::string textAt(scenegraph::Dataset& dataset, const std::string& topic, std::int64_t time_ns) {
  const auto id = dataset.store().findTopic(topic, ObjectType::RobotDescription);
  const auto entry = id ? dataset.store().newestAtOrBefore(*id, {time_ns}) : std::nullopt;
  const auto object = entry ? dataset.store().decode(*id, *entry) : std::unexpected(scenegraph::DecodeError{});
  const auto robot = object ? object->get<RobotDescription>() : nullptr;
  return robot != nullptr && robot->format == "urdf" ? robot->text : "none";
}

TEST(RobotTopics, AttachedRobotsAreThereFromTheFirstInstant) {
  const TemporaryFile file;
  const auto recording = record(file);
  EXPECT_EQ(textAt(*recording->dataset(), "attachment:arm.urdf", 1000), kRobot);
  const auto attachments = recording->dataset()->resources().attachments();
  ASSERT_EQ(attachments.size(), 2U);
  EXPECT_EQ(attachments[1].name, "arm/meshes/a.stl");
  const auto bytes = attachments[1].read();
  ASSERT_TRUE(bytes);
  EXPECT_EQ(bytes->bytes.size(), kRobot.size());
  EXPECT_EQ(recording->dataset()->timeRange()->first.ns, 1000);
}

TEST(RobotTopics, AFileOfTheUsersIsATopicThatKnowsWhereItLies) {
  const TemporaryFile file;
  const auto recording = record(file);
  const TemporaryFile urdf;
  std::ofstream(urdf.path()) << kRobot;
  ASSERT_TRUE(addRobotFile(*recording->dataset(), urdf.path()));
  EXPECT_EQ(textAt(*recording->dataset(), "robot:" + urdf.path().filename().string(), 1000), kRobot);
  const auto refused = addRobotFile(*recording->dataset(), "/nonexistent/robot.urdf");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "CannotOpen");
}

}  // namespace
}  // namespace stillframe::ingest
