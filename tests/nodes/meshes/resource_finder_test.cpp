#include "nodes/meshes/resource_finder.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/nodes/meshes/mesh_files.h"

namespace stillframe::nodes {
namespace {

namespace fs = std::filesystem;

class Finder : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* const name :
         {"ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "COLCON_PREFIX_PATH", "CMAKE_PREFIX_PATH"}) {
      unsetenv(name);
    }
    mesh_ = files_.add("ws/src/stack/arm_description/meshes/link.stl", "x");
    files_.add("ws/src/stack/arm_description/package.xml", "<package>\n <name> my_arm </name></package>");
    urdf_ = files_.add("ws/src/stack/arm_description/urdf/arm.urdf", "<robot/>");
    files_.add("secret.stl", "x");
  }
  [[nodiscard]] ResourceFinder finder(const std::vector<fs::path>& paths = {}) const {
    return ResourceFinder(resources_, paths);
  }
  static std::string codeOf(const std::expected<FoundResource, scenegraph::Status>& found) {
    return found ? "Ok" : found.error().code;
  }
  test::FilesFolder files_;
  fs::path mesh_;
  fs::path urdf_;
  scenegraph::Resources resources_;
};

TEST_F(Finder, FindsPackagesByTheNameInTheirXmlOrOfTheirFolder) {
  for (const fs::path& path :
       {files_.path() / "ws", files_.path() / "ws/src/stack/arm_description", files_.path() / "ws/src/"}) {
    const auto found = finder({path}).find("package://my_arm/meshes/link.stl");
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->file, mesh_);
    EXPECT_EQ(found->within, mesh_.parent_path().parent_path());
  }
  EXPECT_EQ(codeOf(finder({files_.path() / "ws/src/stack"}).find("package://arm_description/meshes/link.stl")), "Ok");
  EXPECT_EQ(codeOf(finder().find("package://my_arm/meshes/link.stl")), "UnknownPackage");
  EXPECT_EQ(codeOf(finder().find("package://my_arm/meshes/link.stl", urdf_)), "Ok");
  EXPECT_EQ(codeOf(finder({files_.path() / "ws"}).find("package://my_arm/meshes/none.stl")), "MeshMissing");
}

TEST_F(Finder, ReadsTheRosEnvironment) {
  setenv("ROS_PACKAGE_PATH", ("/nonexistent:" + (files_.path() / "ws/src").string()).c_str(), 1);
  EXPECT_EQ(codeOf(finder().find("package://my_arm/meshes/link.stl")), "Ok");
  unsetenv("ROS_PACKAGE_PATH");
  files_.add("install/share/my_arm/meshes/link.stl", "x");
  setenv("AMENT_PREFIX_PATH", (files_.path() / "install").c_str(), 1);
  EXPECT_EQ(codeOf(finder().find("package://my_arm/meshes/link.stl")), "Ok");
  EXPECT_EQ(codeOf(finder().find("model://my_arm/meshes/link.stl")), "Ok");
  unsetenv("AMENT_PREFIX_PATH");
}

TEST_F(Finder, TakesFilesAbsoluteAndRelativeNames) {
  EXPECT_EQ(codeOf(finder().find("file://" + mesh_.string())), "Ok");
  EXPECT_EQ(codeOf(finder().find("file://localhost" + mesh_.string())), "Ok");
  EXPECT_EQ(codeOf(finder().find(mesh_.string())), "Ok");
  EXPECT_EQ(codeOf(finder().find("../meshes/link.stl", urdf_)), "Ok");
  EXPECT_EQ(codeOf(finder().find("../meshes/none.stl", urdf_)), "MeshMissing");
  EXPECT_EQ(codeOf(finder({mesh_.parent_path()}).find("link.stl")), "Ok");
  EXPECT_EQ(codeOf(finder().find("link.stl")), "MeshMissing");
  EXPECT_EQ(codeOf(finder().find("http://example.com/link.stl")), "UnsupportedUri");
  EXPECT_EQ(codeOf(finder().find("")), "MeshMissing");
  files_.add("ws/a b.stl", "x");
  EXPECT_EQ(codeOf(finder().find("file://" + (files_.path() / "ws/a%20b.stl").string())), "Ok");
}

TEST_F(Finder, NothingLeadsOutOfItsPackage) {
  const auto find = finder({files_.path() / "ws"});
  for (const char* const uri :
       {"package://my_arm/../../../../secret.stl", "package://my_arm/meshes/../../../../../secret.stl",
        "package://my_arm/..%2f..%2f../secret.stl", "package://../secret.stl", "package:///etc/passwd"}) {
    EXPECT_EQ(codeOf(find.find(uri)), "PathEscapesPackage") << uri;
  }
  EXPECT_EQ(codeOf(find.find("../../../../../secret.stl", urdf_)), "PathEscapesPackage");
  EXPECT_EQ(codeOf(find.find("../secret.stl")), "PathEscapesPackage");
}

TEST_F(Finder, PrefersWhatCameWithTheRecording) {
  for (const char* const name : {"my_arm/meshes/link.stl", "other/cup.dae", "package://x/y.stl"}) {
    resources_.addAttachment({.name = name, .media_type = "", .bytes = 1, .read = {}});
  }
  const auto attached = [&](const std::string& uri) {
    const auto found = finder({files_.path() / "ws"}).find(uri);
    return found && found->attachment ? found->attachment->name : std::string("none");
  };
  EXPECT_EQ(attached("package://my_arm/meshes/link.stl"), "my_arm/meshes/link.stl");
  EXPECT_EQ(attached("package://x/y.stl"), "package://x/y.stl");
  EXPECT_EQ(attached("package://gone/deep/cup.dae"), "other/cup.dae");
  EXPECT_EQ(attached("meshes/link.stl"), "my_arm/meshes/link.stl");
  EXPECT_EQ(attached("package://gone/deep/k.stl"), "none");
}

}  // namespace
}  // namespace stillframe::nodes
