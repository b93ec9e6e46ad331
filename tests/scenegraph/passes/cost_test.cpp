// Before OSG's headers, which bring the same ones without prototypes.
#include "tests/scenegraph/pipeline/live_objects.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>

#include "scenegraph/passes/view_effects.h"
#include "scenegraph/pipeline/offscreen_context.h"
#include "scenegraph/pipeline/view_pipeline.h"
#include "tests/scenegraph/passes/gl_calls.h"
#include "tests/scenegraph/pipeline/shader_scene.h"

namespace stillframe::scenegraph {
namespace {

constexpr int kSize = 64;

/// What effects cost in objects and in work: a quad of the scene, presented in a framebuffer of 64 x 64.
class EffectCostTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = OffscreenContext::create();
    ASSERT_TRUE(context) << context.error().message;
    context_ = std::move(*context);
    glCreateRenderbuffers(1, &color_);
    glNamedRenderbufferStorage(color_, GL_RGBA8, kSize, kSize);
    glCreateFramebuffers(1, &fbo_);
    glNamedFramebufferRenderbuffer(fbo_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
    glCreateQueries(GL_PRIMITIVES_GENERATED, 1, &triangles_);
    glCreateQueries(GL_SAMPLES_PASSED, 1, &fragments_);
    root_->addChild(makeQuad(5, 5, 0, {1, 0, 0, 1}));
    empty_ = LiveObjects::count();
    pipeline_ = std::make_unique<ViewPipeline>(root_);
    pipeline_->setView({.eye_from_fixed = lookAt({0, 0, 3}, {0, 0, 0}, {0, 1, 0})});
  }
  void TearDown() override {
    pipeline_.reset();
    EXPECT_EQ(LiveObjects::count(), empty_);
    EXPECT_EQ(context_->debugLog().count(), 0U) << ::testing::PrintToString(context_->debugLog().messages());
  }
  void present(int width = kSize, int height = kSize) {
    const auto drawn = pipeline_->render(fbo_, width, height);
    EXPECT_TRUE(drawn) << drawn.error().message;
  }

  struct Work {
    GLuint64 triangles = 0;
    GLuint64 fragments = 0;
    friend bool operator==(const Work&, const Work&) = default;
  };
  Work workOf(const ViewEffects& effects) {
    pipeline_->setPostChain(effects.chain());
    present();  // what is made once is made
    glBeginQuery(GL_PRIMITIVES_GENERATED, triangles_);
    glBeginQuery(GL_SAMPLES_PASSED, fragments_);
    present();
    glEndQuery(GL_SAMPLES_PASSED);
    glEndQuery(GL_PRIMITIVES_GENERATED);
    Work work;
    glGetQueryObjectui64v(triangles_, GL_QUERY_RESULT, &work.triangles);
    glGetQueryObjectui64v(fragments_, GL_QUERY_RESULT, &work.fragments);
    return work;
  }
  static ViewEffects with(const std::string& effect, const SettingTexts& settings = {}) {
    ViewEffects effects;
    effects.setOn(effect, true);
    EXPECT_TRUE(effects.apply(effect, settings));
    return effects;
  }

  std::unique_ptr<OffscreenContext> context_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  std::unique_ptr<ViewPipeline> pipeline_;
  LiveObjects empty_;
  GLuint color_ = 0;
  GLuint fbo_ = 0;
  GLuint triangles_ = 0;
  GLuint fragments_ = 0;
};

TEST_F(EffectCostTest, NoEffectHasNoTargetNoShaderAndNoDraw) {
  const Work none = workOf({});
  EXPECT_EQ(none.triangles, 3U) << "two of the scene, one of present";
  const LiveObjects live = LiveObjects::count();
  EXPECT_EQ(live.textures - empty_.textures, 2) << "colour and depth";
  EXPECT_EQ(live.framebuffers - empty_.framebuffers, 1);
  EXPECT_EQ(live.programs - empty_.programs, 2) << "that of the scene and present";
  // Settings of effects that are off cost nothing either.
  ViewEffects effects;
  ASSERT_TRUE(effects.apply("ssao", {{"samples", "64"}}));
  EXPECT_EQ(workOf(effects), none);
  EXPECT_EQ(LiveObjects::count(), live);
}

TEST_F(EffectCostTest, EachEffectCostsItsOwnPassesAndNothingWhenItIsOffAgain) {
  const Work none = workOf({});
  const LiveObjects live = LiveObjects::count();
  struct Case {
    ViewEffects effects;
    GLuint64 passes;
    int textures;
    int programs;
  };
  for (const Case& at : {Case{with("ssao"), 2, 2, 2},
                         {with("edl"), 1, 1, 1},
                         {with("tonemap"), 1, 1, 1},
                         {with("dither"), 1, 1, 1},
                         {with("aa", {{"mode", "fxaa"}}), 1, 1, 1},
                         {with("aa", {{"mode", "msaa"}}), 1, 2, 1}}) {
    EXPECT_EQ(workOf(at.effects).triangles, none.triangles + at.passes);
    const LiveObjects now = LiveObjects::count();
    EXPECT_EQ(now.textures - live.textures, at.textures);
    EXPECT_EQ(now.programs - live.programs, at.programs);
    EXPECT_EQ(workOf({}), none);
    EXPECT_EQ(LiveObjects::count(), live);
  }
}

TEST_F(EffectCostTest, OffIsNoDrawClearTextureOrSwitchMore) {
  const auto calls_of = [&](const ViewEffects& effects) {
    pipeline_->setPostChain(effects.chain());
    present();
    present();  // what is made once is made
    const GlCalls before = GlCalls::count();
    present();
    return GlCalls::count() - before;
  };
  const GlCalls none = calls_of({});
  EXPECT_EQ(none.draws, 2) << "the scene, and present";
  EXPECT_EQ(none.clears, 1);
  EXPECT_EQ(none.texture_makes, 0);
  for (const auto& [effect, passes] : {std::pair{"ssao", 2}, {"edl", 1}, {"tonemap", 1}, {"dither", 1}}) {
    const GlCalls on = calls_of(with(effect));
    EXPECT_EQ(on.draws, none.draws + passes) << effect;
    EXPECT_GT(on.texture_binds, none.texture_binds) << effect;
    EXPECT_EQ(on.texture_makes, 0) << effect;
    ViewEffects off = with(effect);
    off.setOn(effect, false);
    GlCalls after = calls_of(off);
    // OSG goes on unbinding the units that were in use once.
    EXPECT_LE(after.texture_binds, none.texture_binds + 2) << effect;
    after.texture_binds = none.texture_binds;
    EXPECT_EQ(after, none) << effect;
  }
}

TEST_F(EffectCostTest, ALongChainSharesTwoColourTargets) {
  ViewEffects all;
  for (const EffectType& type : effectTypes()) {
    all.setOn(type.name, true);
  }
  ASSERT_TRUE(all.apply("aa", {{"mode", "fxaa"}}));
  const LiveObjects none = (workOf({}), LiveObjects::count());
  (void)workOf(all);
  // The other colour target and the openness; six passes.
  EXPECT_EQ(LiveObjects::count().textures - none.textures, 2);
  EXPECT_EQ(LiveObjects::count().programs - none.programs, 6);
}

TEST_F(EffectCostTest, SamplesOfTheWholePictureRunAllButTheLastPassesSoManyTimes) {
  const Work none = workOf({});
  ViewEffects effects = with("aa", {{"mode", "ssaa"}, {"samples", "4"}});
  effects.setOn("edl", true);
  effects.setOn("dither", true);
  // Scene, edl and average four times; dither and present once.
  EXPECT_EQ(workOf(effects).triangles, 4 * (none.triangles - 1 + 2) + 2);
}

TEST_F(EffectCostTest, AChangeOfAParameterMakesNothingAnew) {
  (void)workOf(with("ssao"));
  const LiveObjects live = LiveObjects::count();
  const auto center = [&] {
    std::array<GLubyte, 4> rgba{};
    glBindFramebuffer(GL_READ_FRAMEBUFFER, fbo_);
    glReadPixels(kSize / 2, kSize / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    return rgba[0];
  };
  (void)workOf(with("tonemap", {{"curve", "none"}}));
  const LiveObjects toned = LiveObjects::count();
  EXPECT_NE(toned, live);
  for (const char* exposure : {"0", "1", "-1"}) {
    pipeline_->setPostChain(with("tonemap", {{"curve", "none"}, {"exposure", exposure}}).chain());
    present();
    EXPECT_EQ(center(), 255) << "a data colour";
    EXPECT_EQ(LiveObjects::count(), toned);
  }
  const ViewEffects flat = with("edl", {{"strength", "0"}});
  const ViewEffects strong = with("edl", {{"strength", "4"}, {"radius", "32"}});
  EXPECT_TRUE(isSameStructure(flat.chain(), strong.chain()));
}

TEST_F(EffectCostTest, LeaksNothingOverAThousandTogglesAndResizesOfAllEffects) {
  const std::array<ViewEffects, 7> states{ViewEffects{},
                                          with("ssao"),
                                          with("ssao", {{"half_resolution", "true"}}),
                                          with("edl"),
                                          with("tonemap"),
                                          with("aa", {{"mode", "msaa"}, {"samples", "2"}}),
                                          with("aa", {{"mode", "ssaa"}, {"samples", "2"}})};
  (void)workOf({});
  const LiveObjects live = LiveObjects::count();
  for (std::size_t i = 0; i < 1000; ++i) {
    pipeline_->setPostChain(states.at(i % states.size()).chain());
    present(1 + static_cast<int>(i % 61), 1 + static_cast<int>(7 * i % 59));
  }
  (void)workOf({});
  EXPECT_EQ(LiveObjects::count(), live);
}

}  // namespace
}  // namespace stillframe::scenegraph
