#include "scenegraph/export/osgt_export.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <osg/Image>
#include <osg/MatrixTransform>
#include <osg/TextureBuffer>
#include <osgDB/ReadFile>
#include <random>
#include <string>

#include "tests/scenegraph/pipeline/shader_scene.h"

namespace stillframe::scenegraph {
namespace {

/// A subclass that does not say so: OSG would write it as a Group.
class SilentGroup : public osg::Group {};

class ForeignGroup : public osg::Group {
 public:
  ForeignGroup() = default;
  ForeignGroup(const ForeignGroup& other, const osg::CopyOp& copy = osg::CopyOp::SHALLOW_COPY)
      : osg::Group(other, copy) {}
  META_Node(robot, ForeignGroup)
};

const osg::Vec3d kUtm{447631.12345678912, 5411742.9876543219, 131.1};

osg::ref_ptr<osg::MatrixTransform> makeFrame(const std::string& name, const osg::Matrixd& matrix) {
  osg::ref_ptr<osg::MatrixTransform> frame = new osg::MatrixTransform{matrix};
  frame->setName(name);
  return frame;
}

/// Two visible frames at a UTM offset and one hidden.
osg::ref_ptr<osg::Group> makeScene() {
  osg::ref_ptr<osg::Group> root = new osg::Group;
  root->setName("root");
  const auto base = makeFrame("base \"link\"",
                              osg::Matrixd::rotate(0.1, 0.2, 0.3, 0.9273618495495704) * osg::Matrixd::translate(kUtm));
  base->addChild(makeQuad(0.8F, 0.5F, 0.0F, {0.9F, 0.4F, 0.2F, 1}));
  base->addChild(makeShape(GL_POINTS, {{0.5F, 0.9F, 0.2F}, {-0.9F, 0.1F, 0.3F}}, {{1, 1, 0, 1}, {0, 1, 1, 1}}));
  const auto lidar = makeFrame("lidar", osg::Matrixd::translate(kUtm + osg::Vec3d(0.4, 0.2, 0.1)));
  lidar->addChild(makeShape(GL_LINES, {{-1, -1, -1}, {1, 1, 1}, {1, -1, 0}, {-1, 1, 0}}, {{0.2F, 0.9F, 0.3F, 1}}));
  const auto hidden = makeFrame("hidden", osg::Matrixd::translate(kUtm));
  hidden->addChild(makeQuad(9, 9, 1, {1, 0, 1, 1}));
  hidden->setNodeMask(0);
  for (const auto& frame : {base, lidar, hidden}) {
    root->addChild(frame);
  }
  return root;
}

osg::MatrixTransform& frameOf(osg::Group& root, unsigned index) {
  return dynamic_cast<osg::MatrixTransform&>(*root.getChild(index));
}

class OsgtExport : public ::testing::Test {
 protected:
  OsgtExport() : folder_(std::filesystem::path(::testing::TempDir()) / ("osgt_export_" + std::string(name()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~OsgtExport() override { std::filesystem::remove_all(folder_); }
  static const char* name() { return ::testing::UnitTest::GetInstance()->current_test_info()->name(); }
  static ExportInfo info() {
    return {.time = {1'700'000'000'123'456'789},
            .fixed_frame = "map",
            .source = "run \"7\".mcap",
            .layers = {{"/points", {{"color", "intensity"}, {"size", "3"}}}, {"grid", {}}}};
  }
  osg::ref_ptr<osg::Group> roundTrip(const osg::Group& root, const char* file) {
    const auto path = folder_ / file;
    const auto written = exportGraph(root, info(), path);
    EXPECT_TRUE(written) << written.error().message;
    osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(path.string());
    return node.valid() ? node->asGroup() : nullptr;
  }
  std::expected<void, Status> write(const osg::Group& root) { return exportGraph(root, info(), folder_ / "x.osgt"); }
  [[nodiscard]] bool isFolderEmpty() const { return std::filesystem::is_empty(folder_); }

  std::filesystem::path folder_;
};

TEST_F(OsgtExport, KeepsFrameNamesAndEveryBitOfTheirMatrices) {
  const auto root = makeScene();
  for (const char* const file : {"scene.osgt", "scene.osgb"}) {
    const auto back = roundTrip(*root, file);
    ASSERT_NE(back, nullptr) << file;
    ASSERT_EQ(back->getNumChildren(), 2U) << file;
    for (unsigned i = 0; i < 2; ++i) {
      EXPECT_EQ(frameOf(*back, i).getName(), frameOf(*root, i).getName());
      for (int k = 0; k < 16; ++k) {
        EXPECT_EQ(frameOf(*back, i).getMatrix().ptr()[k], frameOf(*root, i).getMatrix().ptr()[k]) << file << " " << k;
      }
    }
  }
}

TEST_F(OsgtExport, TextComesBackWithinOneUlpThroughTheReadersInexactParser) {
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> unit{-1.0, 1.0};
  osg::ref_ptr<osg::Group> root = new osg::Group;
  std::vector<osg::Matrixd> matrices;
  for (const double scale : {1e-9, 1e-3, 1.0, 1e3, 5e5, 6.4e6, 1e9}) {
    for (int i = 0; i < 40; ++i) {
      osg::Matrixd matrix;
      for (int k = 0; k < 16; ++k) {
        matrix.ptr()[k] = unit(random) * (k < 12 ? 1.0 : scale);
      }
      matrices.push_back(matrix);
      root->addChild(makeFrame("f", matrix));
    }
  }
  const auto back = roundTrip(*root, "random.osgt");
  ASSERT_NE(back, nullptr);
  std::size_t different = 0;
  double worst_ulp = 0.0;
  for (unsigned i = 0; i < matrices.size(); ++i) {
    for (int k = 0; k < 16; ++k) {
      const double sent = matrices[i].ptr()[k];
      const double got = frameOf(*back, i).getMatrix().ptr()[k];
      different += sent != got ? 1U : 0U;
      worst_ulp = std::max(worst_ulp, std::abs(got - sent) / (std::nextafter(std::abs(sent), 1e300) - std::abs(sent)));
    }
  }
  EXPECT_LE(different, 20U) << "of " << matrices.size() * 16;
  EXPECT_LE(worst_ulp, 1.0);
}

TEST_F(OsgtExport, SaysTimeFixedFrameSourceAndSettings) {
  const auto back = roundTrip(*makeScene(), "scene.osgt");
  ASSERT_NE(back, nullptr);
  EXPECT_EQ(back->getDescriptions(),
            (std::vector<std::string>{"time_ns=1700000000123456789", "fixed_frame=map", "source=run \"7\".mcap",
                                      "layer=/points:color=intensity,size=3", "layer=grid"}));
}

TEST_F(OsgtExport, LeavesTheGraphAsItWas) {
  const auto root = makeScene();
  root->addDescription("mine");
  ASSERT_TRUE(write(*root));
  EXPECT_EQ(root->getNumChildren(), 3U);
  EXPECT_EQ(root->getStateSet(), nullptr);
  EXPECT_EQ(root->getDescriptions(), std::vector<std::string>{"mine"});
  const osg::Group& geode = *frameOf(*root, 0).getChild(0)->asGroup();
  EXPECT_EQ(geode.getNumParents(), 1U);
  EXPECT_EQ(geode.getChild(0)->getNumParents(), 1U);
  EXPECT_EQ(geode.getChild(0)->referenceCount(), 1);
}

TEST_F(OsgtExport, KeepsSharedStateShared) {
  const auto root = makeScene();
  const auto shared = new osg::StateSet;
  frameOf(*root, 0).getChild(0)->setStateSet(shared);
  frameOf(*root, 1).getChild(0)->setStateSet(shared);
  const auto back = roundTrip(*root, "scene.osgt");
  ASSERT_NE(back, nullptr);
  EXPECT_NE(frameOf(*back, 0).getChild(0)->getStateSet(), nullptr);
  EXPECT_EQ(frameOf(*back, 0).getChild(0)->getStateSet(), frameOf(*back, 1).getChild(0)->getStateSet());
}

TEST_F(OsgtExport, RefusesClassesThatStockReadersLose) {
  const auto code = [&](osg::Node* child) {
    const auto root = makeScene();
    root->addChild(child);
    const auto result = write(*root);
    return result ? std::string("written") : result.error().code + ": " + result.error().message;
  };
  EXPECT_TRUE(code(new SilentGroup).starts_with("NotExportable")) << code(new SilentGroup);
  const std::string foreign = code(new ForeignGroup);
  EXPECT_TRUE(foreign.starts_with("NotExportable") && foreign.contains("robot::ForeignGroup")) << foreign;
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(4, 1, 1, GL_RGBA, GL_FLOAT);
  const auto textured = makeQuad(1, 1, 0, {1, 1, 1, 1});
  textured->getOrCreateStateSet()->setTextureAttribute(0, new osg::TextureBuffer{image});
  EXPECT_TRUE(code(textured).contains("TextureBuffer")) << code(textured);
  EXPECT_EQ(code(new osg::Group), "written");
  std::filesystem::remove(folder_ / "x.osgt");
  EXPECT_TRUE(isFolderEmpty());
}

TEST_F(OsgtExport, KeepsTexelsOfAnArrayBackedTextureBuffer) {
  const auto root = makeScene();
  osg::ref_ptr<osg::FloatArray> texels = new osg::FloatArray;
  texels->push_back(0.1F);
  texels->push_back(1e-30F);
  frameOf(*root, 0).getChild(0)->getOrCreateStateSet()->setTextureAttribute(0, new osg::TextureBuffer{texels});
  const auto back = roundTrip(*root, "scene.osgt");
  ASSERT_NE(back, nullptr);
  const auto* texture = dynamic_cast<const osg::TextureBuffer*>(
      frameOf(*back, 0).getChild(0)->getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
  ASSERT_NE(texture, nullptr);
  const auto* array = dynamic_cast<const osg::FloatArray*>(texture->getBufferData());
  ASSERT_NE(array, nullptr);
  EXPECT_EQ(array->at(0), 0.1F);
  EXPECT_EQ(array->at(1), 1e-30F);
}

TEST_F(OsgtExport, RefusesWhatTextWouldTurnIntoZero) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto code = [&](osg::Node* child) {
    const auto root = makeScene();
    root->addChild(child);
    const auto result = write(*root);
    return result ? std::string("written") : result.error().code;
  };
  EXPECT_EQ(code(makeShape(GL_POINTS, {{0, kNan, 0}}, {{1, 1, 1, 1}})), "NotFinite");
  EXPECT_EQ(code(makeShape(GL_POINTS, {{0, 0, 0}}, {{1, 1, kInfinity, 1}})), "NotFinite");
  const auto quad = makeQuad(1, 1, 0, {1, 1, 1, 1});
  quad->getOrCreateStateSet()->addUniform(new osg::Uniform{"u_low", kNan});
  EXPECT_EQ(code(quad), "NotFinite");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code(new osg::MatrixTransform{osg::Matrixd::translate(0, 0, nan)}), "NotFinite");
  EXPECT_TRUE(isFolderEmpty());
}

TEST_F(OsgtExport, NamesWhatCannotBeWrittenAndLeavesNothingBehind) {
  const auto root = makeScene();
  EXPECT_EQ(exportGraph(*root, info(), folder_ / "scene.obj").error().code, "UnknownFormat");
  EXPECT_EQ(exportGraph(*root, info(), folder_ / "no" / "scene.osgt").error().code, "CannotWrite");
  EXPECT_TRUE(isFolderEmpty());
  std::filesystem::create_symlink("/dev/full", folder_ / "full.osgt");
  const auto full = exportGraph(*root, info(), folder_ / "full.osgt");
  ASSERT_FALSE(full);
  EXPECT_NE(full.error().message.find("No space left"), std::string::npos) << full.error().message;
}

}  // namespace
}  // namespace stillframe::scenegraph
