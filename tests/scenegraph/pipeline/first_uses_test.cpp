// Pictures in steps: what is new to OpenGL, programs and arrays.
#include <gtest/gtest.h>

#include <osg/Texture2D>
#include <string>

#include "scenegraph/own_texture.h"
#include "scenegraph/pipeline/buffer_uploads.h"
#include "tests/scenegraph/pipeline/picture_steps.h"

namespace stillframe::scenegraph {
namespace {

TEST_F(PictureSteps, AProgramThatIsNewTakesTwoStepsAndNoOtherIsLinkedInThem) {
  const auto add = [&](const std::string& color, bool is_blended) {
    const osg::ref_ptr<osg::Geode> quad = makeQuad(1, 1, 0, {1, 1, 1, 1});
    quad->getDrawable(0)->getOrCreateStateSet()->setAttributeAndModes(makeProgram(
        "own", kTestVertex, "#version 450 compatibility\nvoid main() { gl_FragColor = vec4(" + color + ", 0.5); }\n"));
    setBlended(*quad->getOrCreateStateSet(), is_blended);
    root_->addChild(quad);
  };
  constexpr double kAmple_ms = 1e6;
  EXPECT_EQ(inStepsAndPresented(kAmple_ms), 1);
  add("0.1, 0.2, 0.3", false);
  add("0.3, 0.2, 0.1", false);
  add("0.5, 0.4, 0.3", false);
  EXPECT_EQ(inSteps(kAmple_ms), 3 * 2 + 1) << "linked, drawn with; and one that finds nothing left";
  pipeline_->present(output_->id());
  EXPECT_EQ(inSteps(kAmple_ms), 1);
  pipeline_->present(output_->id());
  add("0.7, 0.4, 0.3", true);
  EXPECT_EQ(inSteps(kAmple_ms), 1 + 2 + 3)
      << "what is known; the new one; what lays over is one too, and takes a step before";
  const Pixels in_steps = read();
  EXPECT_TRUE(atOnce() == in_steps);
  pipeline_->setPostChain(supersampling(2));
  EXPECT_EQ(inSteps(kAmple_ms), 2) << "a pass that is new is a step";
  pipeline_->releaseGl();
  EXPECT_GT(inSteps(kAmple_ms), 4 * 2) << "in another context all are new";
}

TEST_F(PictureSteps, CodeForMipmapsOfAFormatTakesTwoStepsOfItsOwn) {
  constexpr double kAmple_ms = 1e6;
  const osg::ref_ptr<osg::Program> program = makeProgram("textured", kTestVertex, R"(#version 450 compatibility
uniform sampler2D u_texture;
void main() { gl_FragColor = vec4(textureLod(u_texture, gl_FragCoord.xy / vec2(96.0, 72.0), 1.0).rgb, 1.0); }
)");
  float z = 0.0F;
  const auto steps = [&](GLint format, int width, osg::Texture::FilterMode filter, bool is_own) {
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(width, 16, 1, format == GL_R8 ? GL_RED : GL_RGBA, GL_UNSIGNED_BYTE, 1);
    image->setInternalTextureFormat(format);
    for (unsigned i = 0; i < image->getTotalSizeInBytes(); ++i) {
      image->data()[i] = static_cast<unsigned char>((i * 2654435761U) >> 24U);
    }
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setFilter(osg::Texture::MIN_FILTER, filter);
    texture->setResizeNonPowerOfTwoHint(false);
    const osg::ref_ptr<osg::Geode> quad = makeQuad(1, 1, z += 0.01F, {1, 1, 1, 1});
    osg::StateSet& state = *quad->getDrawable(0)->getOrCreateStateSet();
    state.setAttributeAndModes(program);
    if (is_own) {
      quad->getDrawable(0)->setUserData(new OwnTexture(texture.get()));
    } else {
      state.setTextureAttribute(0, texture);
    }
    root_->addChild(quad);
    const int count = inSteps(kAmple_ms);
    const Pixels in_steps = read();
    pipeline_->present(output_->id());
    EXPECT_TRUE(atOnce() == in_steps);
    return count;
  };
  using enum osg::Texture::FilterMode;
  constexpr int kOwn = 3;  // what is known ends before; code of the first level, and of the others
  steps(GL_RGBA8, 16, LINEAR, false);
  const int without = steps(GL_RGBA8, 16, LINEAR, false);
  EXPECT_EQ(steps(GL_RGBA8, 16, LINEAR_MIPMAP_LINEAR, false), without + kOwn);
  EXPECT_EQ(steps(GL_RGBA8, 32, LINEAR_MIPMAP_NEAREST, false), without) << "it is there now";
  EXPECT_EQ(steps(GL_RGBA8, 17, LINEAR_MIPMAP_LINEAR, false), without + kOwn) << "of sides that halves do not fit";
  EXPECT_EQ(steps(GL_R8, 16, LINEAR_MIPMAP_LINEAR, true), without + kOwn) << "of a texture that the drawable names";
  EXPECT_EQ(steps(GL_R8, 16, LINEAR_MIPMAP_LINEAR, false), without);
}

/// Bands that the arrays of a sheet take, at least.
int bandsOf(osg::Geode& sheet) {
  const osg::Array& positions = *sheet.getDrawable(0)->asGeometry()->getVertexArray();
  return static_cast<int>(positions.getTotalDataSize() / BufferUploads::kBandBytes);
}

TEST_F(PictureSteps, ALargeArrayIsUploadedInBandsAndDrawnWhenItIsWhole) {
  constexpr unsigned kTriangles = 600'000;
  for (const bool is_blended : {false, true}) {
    for (const bool is_changed : {false, true}) {
      const auto add = [&] {
        const osg::ref_ptr<osg::Geode> sheet = makeSheet(kTriangles, false, {0, 1, 0.4F, 0.5F});
        setBlended(*sheet->getOrCreateStateSet(), is_blended);
        root_->addChild(sheet);
        return sheet;
      };
      const auto sheet = add();
      ASSERT_GT(bandsOf(*sheet), 3);
      ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
      ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
      osg::Geometry& geometry = *sheet->getDrawable(0)->asGeometry();
      if (is_changed) {
        dynamic_cast<osg::Vec3Array&>(*geometry.getVertexArray())[0] = {-1.0F, -1.0F, 1.0F};
        geometry.getVertexArray()->dirty();
      }
      const int first = inSteps();
      const Pixels in_steps = read();
      pipeline_->present(output_->id());
      EXPECT_GE(first, inSteps() + bandsOf(*sheet) - 2);
      EXPECT_TRUE(read() == in_steps);
      EXPECT_TRUE(atOnce() == in_steps);
      geometry.getVertexArray()->getVertexBufferObject()->releaseGLObjects();
      EXPECT_TRUE(atOnce() == in_steps) << "as OSG uploads it";
      root_->removeChild(sheet);

      const auto other = add();
      if (!is_changed) {
        ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
        ASSERT_EQ(pipeline_->step(output_->id(), kWidth, kHeight, 0.0), PictureStep::More);
        EXPECT_TRUE(atOnce() == in_steps) << "at once all is there, whatever was begun";
      }
      root_->removeChild(other);
    }
  }
}

}  // namespace
}  // namespace stillframe::scenegraph
