#include "scenegraph/passes/antialiasing.h"

#include "generated/stillframe_passes/shaders.h"

namespace stillframe::scenegraph {

namespace glsl = shaders::stillframe_passes;

EffectType antialiasingEffect() {
  return makeEffectType<AntialiasingSettings>(
      {.name = "aa", .label = "Anti-aliasing", .help = "Smooths edges, lines and small points"},
      {{{.key = "mode",
         .label = "Mode",
         .help = "fxaa: cheap, by contrast; msaa: edges of geometry; ssaa: everything, drawn several times",
         .kind = SettingKind::Text,
         .choices = {"fxaa", "msaa", "ssaa"},
         .choices_only = true},
        &AntialiasingSettings::mode},
       {{.key = "samples",
         .label = "Samples",
         .help = "Of msaa (as many as the driver has at most) and ssaa",
         .kind = SettingKind::Int,
         .minimum = 2,
         .maximum = 64},
        &AntialiasingSettings::samples}},
      appendAntialiasing);
}

void appendAntialiasing(const AntialiasingSettings& settings, PostChain& chain) {
  const std::string color = chain.color();
  if (settings.mode == "fxaa") {
    chain.passes.push_back({.name = "fxaa", .fragment_source = glsl::k_fxaa_frag, .inputs = {{"u_image", color}}});
  } else if (settings.mode == "ssaa") {
    chain.passes.push_back({.name = "average",
                            .fragment_source = glsl::k_average_frag,
                            .inputs = {{"u_image", color}},
                            .format = TargetFormat::Rgba32F,  // halves would lose the last bits of a sum
                            .sub_frames = static_cast<int>(settings.samples)});
  } else {
    chain.msaa_samples = static_cast<int>(settings.samples);
  }
}

}  // namespace stillframe::scenegraph
