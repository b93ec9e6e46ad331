#include "nodes/depth_image/depth_frame.h"

#include <cstring>
#include <string>

#include "nodes/images/color_image.h"
#include "nodes/images/depth_map.h"
#include "nodes/own_buffer.h"

namespace stillframe::nodes {
namespace {

using scenegraph::Status;
using scenegraph::StatusLevel;

template <typename Array, typename T>
osg::ref_ptr<Array> arrayOf(const std::vector<T>& values) {
  using Element = typename Array::ElementDataType;
  auto array = makeArray<Array>(values.size() * sizeof(T) / sizeof(Element));
  if (!values.empty()) {
    std::memcpy(static_cast<void*>(&array->front()), values.data(), values.size() * sizeof(T));
  }
  return array;
}

std::unexpected<Status> refused(const ImageError& error) {
  const StatusLevel level = error.code == ImageFault::NotDepth ? StatusLevel::Info : StatusLevel::Error;
  return std::unexpected(Status{level, std::string(toString(error.code)), error.message});
}

}  // namespace

std::expected<DepthFrame, Status> DepthFrame::make(std::shared_ptr<const scenegraph::Image> image) {
  auto map = decodeDepth(*image);
  if (!map) {
    return refused(map.error());
  }
  DepthFrame frame;
  frame.width = map->width;
  frame.height = map->height;
  frame.valid = map->valid;
  frame.nearest_m = map->nearest_m;
  frame.farthest_m = map->farthest_m;
  frame.depths = makeArray<osg::FloatArray>(0);
  map->metres.push_back(DepthMap::kHole);
  frame.depths->asVector().swap(map->metres);
  frame.source = std::move(image);
  return frame;
}

std::size_t DepthFrame::byteSize() const { return sizeof(*this) + source->byteSize() + pixels() * sizeof(float); }

CameraRays CameraRays::make(const CameraModel& model, std::uint32_t width, std::uint32_t height) {
  RayTable table = makeRays(model, width, height);
  CameraRays rays;
  rays.width = width;
  rays.height = height;
  table.xyz.insert(table.xyz.end(), {0.0F, 0.0F, 0.0F});
  rays.rays = arrayOf<osg::Vec3Array>(table.xyz);
  rays.without_ray = table.without_ray;
  rays.largest_residual_px = table.largest_residual_px;
  return rays;
}

std::size_t CameraRays::byteSize() const { return sizeof(*this) + std::size_t{12} * width * height; }

std::expected<ColorFrame, Status> ColorFrame::make(const scenegraph::Image& image) {
  auto color = decodeColor(image);
  if (!color) {
    return refused(color.error());
  }
  ColorFrame frame;
  frame.width = color->width;
  frame.height = color->height;
  color->rgba.insert(color->rgba.end(), {0, 0, 0, 0});
  frame.colors = arrayOf<osg::Vec4ubArray>(color->rgba);
  frame.colors->setNormalize(true);
  return frame;
}

std::size_t ColorFrame::byteSize() const { return sizeof(*this) + std::size_t{4} * width * height; }

}  // namespace stillframe::nodes
