#include "scenegraph/pipeline/cpu_points.h"

#include <cstdint>

namespace stillframe::scenegraph {

osg::ref_ptr<osg::Texture2D> makePointTexture(int internal_format) {
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
  texture->setInternalFormat(internal_format);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
  texture->setResizeNonPowerOfTwoHint(false);
  texture->setUnRefImageDataAfterApply(false);
  return texture;
}

CpuPoints::CpuPoints(unsigned threads)
    : raster_(threads),
      color_(new osg::Image),
      depth_(new osg::Image),
      color_texture_(makePointTexture(GL_RGBA16F_ARB)),
      depth_texture_(makePointTexture(GL_R32F)) {
  color_texture_->setImage(color_);
  depth_texture_->setImage(depth_);
}

std::size_t CpuPoints::begin(const PointCollection& points, int width_px, int height_px) {
  batches_ = points.batches;
  raster_.begin(width_px, height_px);
  if (color_->s() != width_px || color_->t() != height_px) {
    color_->allocateImage(width_px, height_px, 1, GL_RGBA, GL_HALF_FLOAT);
    depth_->allocateImage(width_px, height_px, 1, GL_RED, GL_FLOAT);
  }
  return 0;
}

void CpuPoints::draw(const PassRange& passes) { raster_.draw(batches_, passes); }

std::size_t CpuPoints::resolve(const PointShading& shading, const glm::vec4& background) {
  const std::size_t pixels = raster_.keys().size();
  raster_.resolve(shading, {reinterpret_cast<std::uint16_t*>(color_->data()), 4 * pixels},
                  {reinterpret_cast<float*>(depth_->data()), pixels}, background);
  color_->dirty();
  depth_->dirty();
  return std::size_t{color_->getTotalSizeInBytes()} + depth_->getTotalSizeInBytes();
}

PointPixels CpuPoints::pixels() const noexcept {
  const std::size_t pixels = raster_.keys().size();
  return {{reinterpret_cast<const std::uint16_t*>(color_->data()), 4 * pixels},
          {reinterpret_cast<const float*>(depth_->data()), pixels}};
}

}  // namespace stillframe::scenegraph
