// Robots of public projects, and those that must fail.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "nodes/meshes/mesh_loader.h"
#include "nodes/robots/urdf_reader.h"

namespace stillframe::nodes {
namespace {

namespace fs = std::filesystem;

std::string textOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(RecordedRobots, AllAreReadAndEveryMeshIsFound) {
  scenegraph::Resources resources;
  resources.setSearchPaths({fs::path(STILLFRAME_TEST_DATA) / "urdf"});
  const ResourceFinder finder(resources);
  std::size_t robots = 0;
  std::size_t meshes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(STILLFRAME_TEST_DATA) / "urdf")) {
    if (entry.path().extension() == ".xacro") {
      const auto read = readUrdf(textOf(entry.path()));
      ASSERT_FALSE(read) << entry.path();
      EXPECT_EQ(read.error().code, "XacroUnexpanded") << entry.path();
    } else if (entry.path().extension() == ".urdf") {
      const auto read = readUrdf(textOf(entry.path()));
      ASSERT_TRUE(read) << entry.path() << ": " << read.error().message;
      EXPECT_EQ(read->remarks, "") << entry.path();
      ++robots;
      for (const RobotLink& link : read->links) {
        for (const auto* shapes : {&link.visuals, &link.collisions}) {
          for (const RobotShape& shape : *shapes) {
            if (shape.kind == RobotShapeKind::Mesh) {
              ++meshes;
              const auto found = finder.find(shape.mesh_uri, entry.path());
              EXPECT_TRUE(found) << found.error().message;
            }
          }
        }
      }
    }
  }
  EXPECT_GE(robots, 15U);
  EXPECT_GE(meshes, 60U);
}

TEST(RecordedRobots, ThoseThatMustFailSayWhy) {
  const fs::path tricky = fs::path(STILLFRAME_TEST_DATA) / "urdf_tricky/ros2_urdf";
  const auto codeOf = [&](const char* name) {
    const auto read = readUrdf(textOf(tricky / name));
    return read ? "Ok" : read.error().code;
  };
  EXPECT_EQ(codeOf("fail_pr2_desc_loop.urdf"), "UrdfLoop");
  EXPECT_EQ(codeOf("fail_pr2_desc_no_joint2.urdf"), "UrdfUnknownLink");
  for (const char* const good :
       {"one_link.urdf", "two_links_one_joint.urdf", "no_visual.urdf", "pr2_desc_no_joint.urdf"}) {
    EXPECT_EQ(codeOf(good), "Ok") << good;
  }
}

}  // namespace
}  // namespace stillframe::nodes
