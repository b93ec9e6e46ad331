#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace stillframe::scenegraph::gl {

/// The OpenGL calls of the pipeline that OSG has no words for, on the context that is current.

void bindFramebuffer(std::uint32_t fbo);
/// For textures and, in the compatibility profile, for texture coordinates.
void selectTextureUnits(std::uint32_t unit, std::uint32_t client_unit);
[[nodiscard]] bool isEnabled(std::uint32_t capability);
/// All of a framebuffer's colours.
void clearColor(std::uint32_t fbo, const std::array<float, 4>& rgba);
/// All of a framebuffer's colours to another one of that size.
void copyColors(std::uint32_t from_fbo, std::uint32_t to_fbo, int width_px, int height_px);
/// Waits until all that was asked for is drawn.
void finish();
/// Status of a framebuffer with these two textures; 0 when it can be drawn into.
[[nodiscard]] std::uint32_t incompleteStatus(std::uint32_t color_texture, std::uint32_t depth_texture);
/// Samples a pixel that colour and depth textures can have on this driver.
[[nodiscard]] int maxSamples();
/// A multisampled texture, whose deletion is the caller's.
[[nodiscard]] std::uint32_t makeSampledTexture(std::uint32_t internal_format, int samples, int width_px, int height_px);
void deleteTexture(std::uint32_t texture);
/// A texture of unsigned numbers in layers (a GL_TEXTURE_2D_ARRAY when there are any, else a GL_TEXTURE_2D) with
/// `channels` of 32 bits, 1 or 4; 0 when there is no memory for it. Its deletion is the caller's.
[[nodiscard]] std::uint32_t makeNumbers(int width, int height, int layers, int channels);
void clearNumbers(std::uint32_t texture);
/// To an image unit, all layers, for reading and writing.
void bindNumbers(std::uint32_t unit, std::uint32_t texture, int channels);
/// What shaders wrote to images before is seen by shaders, and by reads and clears, after.
void finishImages();
/// What was drawn into a texture before is read from it after, though it stays the target.
void finishTargets();
/// The first number of a texture of one; waits for the GPU.
[[nodiscard]] std::uint32_t readNumber(std::uint32_t texture);
/// Whole rows of a texture's level 0.
struct Rows {
  int width_px = 0;  ///< of the texture
  int first = 0;     ///< from the bottom
  int count = 0;
};
/// Puts a whole picture of half floats, 4 a pixel, and one of depths into level 0 of textures that may be the targets
/// that are drawn into just now.
void writePixels(std::uint32_t color_texture, std::uint32_t depth_texture, int width_px, int height_px,
                 const std::uint16_t* rgba, const float* depths);
/// Rows of a colour texture as RGBA, bottom row first; waits for the GPU.
[[nodiscard]] std::vector<float> readColor(std::uint32_t texture, const Rows& rows);
/// The same of a 32-bit float depth texture, one float a pixel.
[[nodiscard]] std::vector<float> readDepth(std::uint32_t texture, const Rows& rows);

}  // namespace stillframe::scenegraph::gl
