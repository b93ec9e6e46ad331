#pragma once

#include <cstdint>
#include <osg/StateSet>
#include <osg/ref_ptr>
#include <string>
#include <utility>
#include <vector>

namespace stillframe::scenegraph {

/// What a target holds, by channel.
enum class TargetFormat : std::uint8_t {
  R16F,        ///< one half float: a factor or a weight
  Rgba8,       ///< bytes; linear light in them bands, and beyond 1 there is nothing
  R11G11B10F,  ///< 6 or 5 bits of mantissa and no alpha
  Rgba16F,     ///< 11 significant bits up to 65504: what the scene is drawn into
  Rgba32F,     ///< for sums of many frames and for reference pictures
};
[[nodiscard]] int bytesPerTexel(TargetFormat format) noexcept;

/// One full-screen step between the scene and what is shown.
///
/// The fragment shader (`#version 450 compatibility`) reads its inputs by texelFetch, its own place being
/// ivec2(gl_FragCoord.xy), and writes gl_FragColor: scene-linear light, and in alpha the share of it that tone mapping
/// leaves alone (scenegraph/passes/tone_map.h). A sampler2D uniform is set for each input. `#include "pass.glsl"` has
/// the functions that give metres and positions from depth, and the check that lets no NaN through.
struct PostPass {
  std::string name;             ///< as passes() prints it; also the name of its output
  std::string fragment_source;  ///< GLSL
  /// Sampler uniform and what it reads: "scene" (colour), "depth" (reverse-Z: 1 near, 0 infinity) or an earlier pass.
  std::vector<std::pair<std::string, std::string>> inputs;
  /// Uniforms of the pass; changing their values needs no setPostChain(). May be null.
  osg::ref_ptr<osg::StateSet> parameters = nullptr;
  TargetFormat format = TargetFormat::Rgba16F;  ///< of its output
  int divisor = 1;                              ///< its output has 1/divisor of the picture's rows and columns
  /// Above 1 all before it is drawn so many times, each moved by another part of a pixel, and what the shader writes
  /// (times u_weight) is summed up. What comes after runs once. One pass of a chain may do so.
  int sub_frames = 1;
};

/// All that happens between the scene and what is shown, as plain data. An empty chain is the cheapest.
struct PostChain {
  std::vector<PostPass> passes;                       ///< in order
  int msaa_samples = 0;                               ///< of the scene's target; 0 or 1: none
  TargetFormat scene_format = TargetFormat::Rgba16F;  ///< of the scene's target

  /// Name of the last colour: what the next pass of the chain reads.
  [[nodiscard]] std::string color() const { return passes.empty() ? "scene" : passes.back().name; }
};

/// Whether the two differ in the values of uniforms alone, so that nothing needs to be made anew.
[[nodiscard]] bool isSameStructure(const PostChain& a, const PostChain& b);

/// Bytes of targets for one pixel of the picture, targets that can be used again counted once.
[[nodiscard]] double bytesPerPixel(const PostChain& chain);

}  // namespace stillframe::scenegraph
