// Pictures that are drawn in steps: those that are drawn at once, to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <osg/GraphicsContext>
#include <osg/Image>
#include <osg/MatrixTransform>
#include <osg/Texture2D>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/blending.h"
#include "scenegraph/passes/antialiasing.h"
#include "scenegraph/pipeline/drawable_slices.h"
#include "scenegraph/pipeline/offscreen_context.h"
#include "scenegraph/pipeline/texture_uploads.h"
#include "scenegraph/pipeline/view_pipeline.h"
#include "tests/scenegraph/pipeline/picture_steps.h"
#include "tests/scenegraph/pipeline/shader_scene.h"

namespace stillframe::scenegraph {
namespace {

TEST_F(PictureSteps, EveryBlendedThingIsAStepOfItsOwn) {
  root_->addChild(makeQuad(1, 1, 0, {1, 0, 0, 1}));
  EXPECT_GT(inStepsAndPresented(), 1);
  const int without = inSteps();
  addPanes(12);
  const Pixels at_once = atOnce();
  EXPECT_EQ(pipeline_->blendedBands(), 1);
  EXPECT_GT(inStepsAndPresented(), without + 12 + 1) << "with the first use of their program";
  for (int round = 0; round < 3; ++round) {
    EXPECT_EQ(inSteps(), without + 12 + 1) << "and what lays them over the picture";
    EXPECT_TRUE(read() == at_once) << round;
    EXPECT_EQ(pipeline_->blendedBands(), 1);
    pipeline_->present(output_->id());
  }
  EXPECT_EQ(inSteps(1e6), 1);
  EXPECT_TRUE(read() == at_once);
}

TEST_F(PictureSteps, BlendedThingsBeyondTheRoomForThemComeInBandsAsWell) {
  addPanes(12);
  const Pixels at_once = atOnce();
  pipeline_->setBlendLimits({.most_fragments = 1U << 12U});
  EXPECT_GT(inSteps(), 3 * 12);
  EXPECT_TRUE(read() == at_once);
  const int bands = pipeline_->blendedBands();
  EXPECT_GT(bands, 3);
  EXPECT_TRUE(atOnce() == at_once);
  EXPECT_EQ(pipeline_->blendedBands(), bands);
}

TEST_F(PictureSteps, BlendedThingsComeOverAllOfALargePicture) {
  const Output large(1000, 800);  // OSG's own viewport has 800 x 600
  addPanes(2);
  ASSERT_TRUE(pipeline_->render(large.id(), large.width(), large.height()));
  const auto at_once = pipeline_->readColor(0, large.height());
  auto done = pipeline_->step(large.id(), large.width(), large.height(), 0.0);
  for (int steps = 0; steps < 100 && done == PictureStep::More; ++steps) {
    done = pipeline_->step(large.id(), large.width(), large.height(), 0.0);
  }
  EXPECT_EQ(done, PictureStep::Whole);
  EXPECT_TRUE(pipeline_->readColor(0, large.height()) == at_once);
}

TEST_F(PictureSteps, OtherThingsThatAreBlendedMeanwhileEndWithThePicture) {
  addPanes(6);
  const Pixels at_once = atOnce();
  ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
  ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
  ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
  EXPECT_TRUE(atOnce() == at_once) << "what was begun is left";
  EXPECT_GT(inSteps(), 6);
  EXPECT_TRUE(read() == at_once);
}

TEST_F(PictureSteps, EachSubFrameIsDrawnInStepsOfItsOwn) {
  root_->addChild(makeQuad(1, 1, 0, {1, 0, 0, 1}));
  addPanes(3);
  EXPECT_GT(inStepsAndPresented(), 1);
  const int without = inSteps();
  for (const int samples : {4, 8}) {
    const auto chain = supersampling(samples);
    pipeline_->setPostChain(chain);
    const Pixels at_once = atOnce();
    EXPECT_GE(inSteps(), samples * without) << samples;
    EXPECT_TRUE(read() == at_once) << samples;
    pipeline_->present(output_->id());
    EXPECT_GE(inSteps(), samples * without) << samples;
    EXPECT_TRUE(read() == at_once) << samples;
  }
}

TEST_F(PictureSteps, PointsOfSubFramesAreAllThere) {
  std::vector<osg::Vec3> points;
  std::vector<osg::Vec4> colors;
  for (int i = 0; i < 20'000; ++i) {
    const auto at = static_cast<float>(i);
    points.emplace_back(std::sin(at * 0.37F), std::sin(at * 0.73F), std::sin(at * 1.17F));
    colors.emplace_back(0.5F + 0.5F * std::sin(at), 0.5F, 0.2F, 1.0F);
  }
  root_->addChild(makeShape(GL_POINTS, points, colors));
  pipeline_->setPointWay(PointWay::Cpu);
  pipeline_->setPostChain(supersampling(4));
  const Pixels at_once = atOnce();
  EXPECT_GT(inSteps(), 4);
  EXPECT_TRUE(read() == at_once);
}

TEST_F(PictureSteps, AStepEndsWithinALargeDrawable) {
  constexpr unsigned kTriangles = 70'001;  // three slices
  root_->addChild(makeQuad(1, 1, -0.5F, {1, 0, 0, 1}));
  EXPECT_GT(inStepsAndPresented(), 1);
  const int without = inSteps();
  for (const bool has_indices : {false, true}) {
    for (const bool is_blended : {false, true}) {
      const osg::ref_ptr<osg::Geode> sheet = makeSheet(kTriangles, has_indices, {0, 1, 0.4F, 0.5F});
      osg::Geometry& geometry = *sheet->getDrawable(0)->asGeometry();
      const osg::PrimitiveSet* const set = geometry.getPrimitiveSet(0);
      setBlended(*sheet->getOrCreateStateSet(), is_blended);
      root_->addChild(sheet);
      const Pixels at_once = atOnce();
      EXPECT_GE(inStepsAndPresented(), without + 3) << "and perhaps the first use of its program";
      EXPECT_EQ(inSteps(), without + 3 + (is_blended ? 1 : 0)) << has_indices << is_blended;
      EXPECT_TRUE(read() == at_once) << has_indices << is_blended;
      EXPECT_EQ(geometry.getNumPrimitiveSets(), 1U);
      EXPECT_EQ(geometry.getPrimitiveSet(0), set) << "for picking and export it is what it was";
      root_->removeChild(sheet);
    }
  }
}

/// A quad before everything with a texture of its own, whose texels all differ from their neighbours'.
osg::ref_ptr<osg::Geode> makePoster(int width, int height, GLenum format, GLint internal_format) {
  const osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(width, height, 1, format, GL_UNSIGNED_BYTE, 1);
  image->setInternalTextureFormat(internal_format);
  for (unsigned i = 0; i < image->getTotalSizeInBytes(); ++i) {
    image->data()[i] = static_cast<unsigned char>((i * 2654435761U) >> 24U);
  }
  const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
  texture->setInternalFormat(internal_format);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
  texture->setResizeNonPowerOfTwoHint(false);
  const osg::ref_ptr<osg::Geode> geode = makeQuad(0.8F, 0.8F, 0.2F, {1, 1, 1, 1});
  osg::StateSet& state = *geode->getDrawable(0)->getOrCreateStateSet();
  state.setTextureAttribute(0, texture);
  state.addUniform(new osg::Uniform("u_poster", 0));
  state.setAttributeAndModes(makeProgram("poster", kTestVertex, R"(#version 450 compatibility
uniform sampler2D u_poster;
void main() { gl_FragColor = vec4(texture(u_poster, gl_FragCoord.xy / vec2(96.0, 72.0)).rgb, 0.7); }
)"));
  return geode;
}

osg::Texture2D& textureOf(osg::Geode& poster) {
  return dynamic_cast<osg::Texture2D&>(
      *poster.getDrawable(0)->getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
}

bool isUploaded(const osg::Texture2D& texture) {
  bool is_there = false;
  for (unsigned context = 0; context <= osg::GraphicsContext::getMaxContextID(); ++context) {
    is_there = is_there || texture.getTextureObject(context) != nullptr;
  }
  return is_there;
}

TEST_F(PictureSteps, ALargeTextureIsUploadedInBandsAndDrawnWhenItIsWhole) {
  const int without = inSteps();
  for (const auto& [format, internal_format] : {std::pair<GLenum, GLint>{GL_RGBA, GL_RGBA8}, {GL_RED, GL_R8}}) {
    for (const bool is_blended : {false, true}) {
      constexpr int kEdge = 1999;  // bands do not divide it, nor four its rows
      const auto at = [&](const osg::ref_ptr<osg::Geode>& poster) {
        setBlended(*poster->getOrCreateStateSet(), is_blended);
        root_->addChild(poster);
      };
      const auto first = makePoster(kEdge, kEdge, format, internal_format);
      at(first);
      const Pixels at_once = atOnce();
      root_->removeChild(first);

      const auto poster = makePoster(kEdge, kEdge, format, internal_format);
      const auto bands =
          static_cast<int>(textureOf(*poster).getImage()->getTotalSizeInBytes() / TextureUploads::kBandBytes);
      at(poster);
      EXPECT_FALSE(isUploaded(textureOf(*poster)));
      EXPECT_GT(inSteps(), without + bands) << format << is_blended;
      EXPECT_TRUE(isUploaded(textureOf(*poster)));
      EXPECT_TRUE(read() == at_once) << format << is_blended;
      pipeline_->present(output_->id());
      EXPECT_LE(inSteps(), without + 2) << "it is there now";

      // What is changed afterwards OSG uploads.
      osg::Image& image = *textureOf(*poster).getImage();
      std::fill_n(image.data(), image.getTotalSizeInBytes(), static_cast<unsigned char>(90));
      image.dirty();
      const Pixels changed = atOnce();
      EXPECT_FALSE(changed == at_once);
      root_->removeChild(poster);
    }
  }
}

TEST_F(PictureSteps, APictureAtOnceHasATextureThatWasHalfThere) {
  const auto first = makePoster(1024, 1024, GL_RGBA, GL_RGBA8);
  root_->addChild(first);
  const Pixels at_once = atOnce();
  root_->removeChild(first);
  const auto poster = makePoster(1024, 1024, GL_RGBA, GL_RGBA8);
  root_->addChild(poster);
  ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
  ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
  ASSERT_FALSE(isUploaded(textureOf(*poster)));
  EXPECT_TRUE(atOnce() == at_once);
}

TEST_F(PictureSteps, OsgUsesTheObjectOfATextureThatCameInBandsAgain) {
  const auto poster = makePoster(1024, 1024, GL_RGBA, GL_RGBA8);
  root_->addChild(poster);
  EXPECT_GT(inSteps(), 2);
  const Pixels in_steps = read();
  root_->removeChild(poster);
  textureOf(*poster).releaseGLObjects();
  for (int i = 0; i < 3; ++i) {
    const auto next = makePoster(1024, 1024, GL_RGBA, GL_RGBA8);
    root_->addChild(next);
    EXPECT_TRUE(atOnce() == in_steps);
    root_->removeChild(next);
    textureOf(*next).releaseGLObjects();
  }
}

TEST_F(PictureSteps, ATextureThatChangesOrGoesMeanwhileIsBegunAnew) {
  const auto poster = makePoster(1024, 1024, GL_RGBA, GL_RGBA8);
  const auto other = makePoster(1024, 700, GL_RGBA, GL_RGBA8);
  root_->addChild(other);
  ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
  ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
  root_->removeChild(other);
  root_->addChild(poster);
  ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
  osg::Image& image = *textureOf(*poster).getImage();
  std::fill_n(image.data(), image.getTotalSizeInBytes(), static_cast<unsigned char>(90));
  image.dirty();
  EXPECT_GT(inSteps(), 3);
  const Pixels in_steps = read();
  EXPECT_TRUE(atOnce() == in_steps);
  root_->removeChild(poster);
  root_->addChild(other);
  ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
  ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
  pipeline_->releaseGl();  // with one that is half there
  EXPECT_GT(inSteps(), 2);
}

/// Triangles of a sheet as so many instances of three of them, each told apart by its number alone.
osg::ref_ptr<osg::Geode> makeCopies(int copies, const std::string& instance, const osg::Vec4& color) {
  const osg::ref_ptr<osg::Geode> geode = makeSheet(3, false, color);
  osg::Geometry& geometry = *geode->getDrawable(0)->asGeometry();
  geometry.getPrimitiveSet(0)->setNumInstances(copies);
  geometry.getOrCreateStateSet()->setAttributeAndModes(makeProgram("copies", R"(#version 450 compatibility
uniform int u_first_instance;
out vec4 v_color;
void main() {
  int i = )" + instance + R"(;
  float at = float(i);
  v_color = gl_Color * vec4(fract(at * 0.37), fract(at * 0.173), 1.0, 1.0);
  gl_Position = gl_ModelViewProjectionMatrix *
                (gl_Vertex + vec4(float(i % 200) * 0.01, float(i / 200) * 0.01, 0.2 * sin(at), 0.0));
})",
                                                                   kTestFragment));
  return geode;
}

TEST_F(PictureSteps, AStepEndsWithinManyInstances) {
  constexpr int kCopies = 25'000;  // three slices of three triangles each
  root_->addChild(makeQuad(1, 1, -0.5F, {1, 0, 0, 1}));
  EXPECT_GT(inStepsAndPresented(), 1);
  const int without = inSteps();
  for (const bool is_blended : {false, true}) {
    const osg::ref_ptr<osg::Geode> copies =
        makeCopies(kCopies, "u_first_instance + gl_InstanceID", {0.5F, 1, 0.4F, 0.5F});
    osg::Geometry& geometry = *copies->getDrawable(0)->asGeometry();
    setBlended(*copies->getOrCreateStateSet(), is_blended);
    root_->addChild(copies);
    const Pixels at_once = atOnce();
    EXPECT_GE(inStepsAndPresented(), without + 3) << "and perhaps the first use of its program";
    for (int round = 0; round < 2; ++round) {
      EXPECT_EQ(inSteps(), without + 3 + (is_blended ? 1 : 0)) << is_blended;
      EXPECT_TRUE(read() == at_once) << is_blended;
      pipeline_->present(output_->id());
    }
    EXPECT_EQ(geometry.getPrimitiveSet(0)->getNumInstances(), kCopies) << "for picking and export it is what it was";
    EXPECT_EQ(geometry.getDrawCallback(), nullptr);
    EXPECT_TRUE(atOnce() == at_once) << "the number of the first one goes with its slice";
    root_->removeChild(copies);
  }
}

TEST_F(PictureSteps, InstancesThatAShaderCountsForItselfAreDrawnInTheFirstSlice) {
  root_->addChild(makeCopies(25'000, "gl_InstanceID", {0.5F, 1, 0.4F, 1}));
  const Pixels at_once = atOnce();
  EXPECT_GT(inSteps(), 3);
  EXPECT_TRUE(read() == at_once);
}

TEST_F(PictureSteps, AMillionInstancesTakeManySlicesAndStripsNone) {
  const osg::ref_ptr<osg::Geode> sheet = makeSheet(70'001, false, {0, 1, 0.4F, 1});
  const osg::ref_ptr<osg::PrimitiveSet> set = sheet->getDrawable(0)->asGeometry()->getPrimitiveSet(0);
  EXPECT_EQ(sliceCount(*sheet->getDrawable(0)), 3U);
  set->setNumInstances(1);
  EXPECT_EQ(sliceCount(*sheet->getDrawable(0)), 3U);
  set->setNumInstances(5);
  EXPECT_EQ(sliceCount(*sheet->getDrawable(0)), 5U) << "a slice is an instance at least";
  set->setNumInstances(0);
  set->setMode(GL_TRIANGLE_STRIP);
  EXPECT_EQ(sliceCount(*sheet->getDrawable(0)), 1U);
  const osg::ref_ptr<osg::Geode> copies = makeSheet(6, false, {0, 1, 0.4F, 1});
  copies->getDrawable(0)->asGeometry()->getPrimitiveSet(0)->setNumInstances(1'000'000);
  EXPECT_EQ(sliceCount(*copies->getDrawable(0)), 184U);
}

}  // namespace
}  // namespace stillframe::scenegraph
