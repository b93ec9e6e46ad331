#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/NodeVisitor>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <string>
#include <vector>

#include "scenegraph/export/osgt_export.h"
#include "tests/support/graph_dump.h"
#include "tools/cli/scene_session.h"
#include "tools/sample/sample.h"

namespace stillframe {
namespace {

namespace fs = std::filesystem;

/// Names of the frames, and the libraries that the nodes' classes come from.
class Census : public osg::NodeVisitor {
 public:
  Census() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
  void apply(osg::Node& node) override {
    libraries[node.libraryName()] += 1;
    if (const auto* const frame = dynamic_cast<osg::MatrixTransform*>(&node);
        frame != nullptr && !node.getName().empty()) {
      frames[node.getName()] = frame->getMatrix();
    }
    if (const osg::Geometry* const geometry = node.asGeometry(); geometry != nullptr && geometry->getVertexArray()) {
      most_vertices = std::max(most_vertices, geometry->getVertexArray()->getNumElements());
    }
    traverse(node);
  }
  unsigned most_vertices = 0;
  std::map<std::string, int> libraries;
  std::map<std::string, osg::Matrixd> frames;
};

class Plugin : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("stillframe_plugin_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    const sample::SampleOptions options{.duration_ns = 1'000'000'000, .lidar_points = 500, .seed = 3};
    ASSERT_TRUE(sample::writeSample(folder_ / "a.mcap", options));
  }
  void TearDown() override { fs::remove_all(folder_); }

  osgDB::ReaderWriter::ReadResult read(const std::string& options, const char* name = "a.mcap") const {
    const osg::ref_ptr<osgDB::Options> parsed = new osgDB::Options(options);
    return osgDB::Registry::instance()->readNode((folder_ / name).string(), parsed);
  }
  fs::path folder_;
};

TEST_F(Plugin, IsFoundByStockOpenSceneGraph) {
  auto result = read("time=+0.5 fixed_frame=base_link layers=/lidar/points");
  ASSERT_TRUE(result.validNode()) << result.message();
  Census census;
  result.getNode()->accept(census);
  ASSERT_TRUE(census.frames.contains("lidar_link"));
  EXPECT_EQ(census.frames["lidar_link"], osg::Matrixd::translate(0.05, 0.0, 0.95));
  EXPECT_GE(census.most_vertices, 500U);  // the cloud outlives what made it
  EXPECT_THAT(result.getNode()->getDescriptions(),
              testing::IsSupersetOf({"time_ns=1700000000501000000", "fixed_frame=base_link"}));
}

TEST_F(Plugin, GivesWhatAnExportHolds) {
  cli::ViewOptions view;
  view.recording.file = (folder_ / "a.mcap").string();
  auto session = cli::SceneSession::make(view);
  ASSERT_TRUE(session) << session.error().message;
  for (const auto& slot : (*session)->scene().layers()) {
    SCOPED_TRACE(slot->id);
    view.layers = {{slot->id, {}}};
    view.only_named_layers = true;
    const auto alone = cli::SceneSession::make(view);
    ASSERT_TRUE(alone) << alone.error().message;
    const auto exported = scenegraph::makeExportGraph((*alone)->scene().root(), (*alone)->exportInfo());
    auto result = read("layers=" + slot->id);
    ASSERT_TRUE(result.validNode()) << result.message();
    EXPECT_EQ(test::dumpGraph(*result.getNode()), test::dumpGraph(*exported));
  }
}

TEST_F(Plugin, GivesStockClassesOnly) {
  auto result = read("");
  ASSERT_TRUE(result.validNode()) << result.message();
  Census census;
  result.getNode()->accept(census);
  for (const auto& [library, count] : census.libraries) {
    EXPECT_THAT(library, testing::AnyOf("osg", "osgText")) << count;
  }
}

TEST_F(Plugin, SaysWhatItCannotDo) {
  EXPECT_THAT(read("fixed_frame=moon").message(), testing::HasSubstr("moon"));
  EXPECT_THAT(read("time=soon").message(), testing::HasSubstr("soon"));
  EXPECT_THAT(read("layers=/nothing").message(), testing::HasSubstr("/nothing"));
  std::ofstream(folder_ / "text.mcap") << "no recording";
  auto result = read("", "text.mcap");
  EXPECT_FALSE(result.validNode());
  EXPECT_THAT(result.message(), testing::HasSubstr("text.mcap"));
  EXPECT_FALSE(read("", "missing.mcap").validNode());
}

}  // namespace
}  // namespace stillframe
