#include "scenegraph/pipeline/point_picture.h"

#include <osg/RenderInfo>
#include <osg/State>

#include "scenegraph/pipeline/gl_target.h"
#include "scenegraph/pipeline/texture_uploads.h"

namespace stillframe::scenegraph {

PointPicture::PointPicture(const PointDrawer& drawer) : drawer_(drawer) {
  setUseDisplayList(false);
  setUseVertexBufferObjects(false);
  setCullingActive(false);
}

void PointPicture::drawImplementation(osg::RenderInfo& info) const {
  const PointPixels pixels = drawer_.pixels();
  const std::uint32_t color = textureId(targets_.color, info.getContextID());
  const std::uint32_t depth = textureId(targets_.depth, info.getContextID());
  const int width_px = targets_.color == nullptr ? 0 : targets_.color->getTextureWidth();
  const int height_px = targets_.color == nullptr ? 0 : targets_.color->getTextureHeight();
  const auto count = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  if (color != 0 && depth != 0 && count > 0 && pixels.depths.size() == count) {
    info.getState()->unbindPixelBufferObject();
    gl::writePixels(color, depth, width_px, height_px, pixels.rgba.data(), pixels.depths.data());
  }
}

}  // namespace stillframe::scenegraph
