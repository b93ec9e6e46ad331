#include "scenegraph/passes/ssao.h"

#include "generated/stillframe_passes/shaders.h"

namespace stillframe::scenegraph {

namespace glsl = shaders::stillframe_passes;

EffectType ssaoEffect() {
  return makeEffectType<SsaoSettings>(
      {.name = "ssao", .label = "Ambient occlusion", .help = "Darkens corners and creases; made for surfaces"},
      {{{.key = "radius",
         .label = "Radius (m)",
         .help = "How far away something may be and still take light",
         .kind = SettingKind::Double,
         .minimum = 1e-3,
         .maximum = 1e4},
        &SsaoSettings::radius},
       {{.key = "intensity",
         .label = "Intensity",
         .help = "How much darker; 1 is the estimate itself",
         .kind = SettingKind::Double,
         .minimum = 0.0,
         .maximum = 4.0},
        &SsaoSettings::intensity},
       {{.key = "samples",
         .label = "Samples",
         .help = "Places looked at for each pixel: more are slower and less grainy",
         .kind = SettingKind::Int,
         .minimum = 1,
         .maximum = 1024},
        &SsaoSettings::samples},
       {{.key = "half_resolution",
         .label = "Half resolution",
         .help = "Estimate for one of four pixels: about three times as fast, softer at edges",
         .kind = SettingKind::Bool},
        &SsaoSettings::half_resolution},
       {{.key = "smoothing",
         .label = "Smoothing",
         .help = "Mean of neighbouring pixels of like depth",
         .kind = SettingKind::Bool},
        &SsaoSettings::smoothing}},
      appendSsao);
}

void appendSsao(const SsaoSettings& settings, PostChain& chain) {
  const std::string color = chain.color();
  const int divisor = settings.half_resolution ? 2 : 1;
  const auto radius = static_cast<float>(settings.radius);
  chain.passes.push_back({.name = "ssao",
                          .fragment_source = glsl::k_ssao_frag,
                          .inputs = {{"u_depth", "depth"}},
                          .parameters = passParameters(std::pair{"u_radius", radius},
                                                       std::pair{"u_intensity", static_cast<float>(settings.intensity)},
                                                       std::pair{"u_samples", static_cast<int>(settings.samples)},
                                                       std::pair{"u_divisor", divisor}),
                          .format = TargetFormat::R16F,
                          .divisor = divisor});
  chain.passes.push_back({.name = "ssao_apply",
                          .fragment_source = glsl::k_ssao_apply_frag,
                          .inputs = {{"u_image", color}, {"u_openness", "ssao"}, {"u_depth", "depth"}},
                          .parameters = passParameters(std::pair{"u_radius", radius}, std::pair{"u_divisor", divisor},
                                                       std::pair{"u_smooths", settings.smoothing})});
}

}  // namespace stillframe::scenegraph
