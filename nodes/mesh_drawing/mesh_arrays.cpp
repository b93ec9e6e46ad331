#include "nodes/mesh_drawing/mesh_arrays.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <osg/Geometry>
#include <osg/Image>

#include "generated/stillframe_nodes/shaders.h"
#include "nodes/own_buffer.h"
#include "scenegraph/blending.h"
#include "scenegraph/geometry.h"
#include "scenegraph/known_bound.h"
#include "scenegraph/pipeline/triangle_boxes.h"

namespace stillframe::nodes {
namespace {

constexpr unsigned kUvAttribute = 7;  // the shader's a_uv

/// An array of its own buffer with these elements, whose memory is laid out alike.
template <typename Array, typename T>
osg::ref_ptr<Array> copyOf(std::span<const T> from, bool is_normalized = false) {
  static_assert(sizeof(T) == sizeof(typename Array::ElementDataType));
  auto array = makeArray<Array>(from.size());
  if (!from.empty()) {
    std::memcpy(static_cast<void*>(array->asVector().data()), from.data(), from.size_bytes());
  }
  array->setNormalize(is_normalized);
  return array;
}

osg::ref_ptr<osg::DrawElementsUInt> trianglesOf(std::span<const std::uint32_t> indices) {
  osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
  triangles->asVector().assign(indices.begin(), indices.end());
  triangles->setElementBufferObject(new osg::ElementBufferObject);
  return triangles;
}

osg::ref_ptr<osg::Texture2D> makeTexture(const MeshTexture& from) {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(static_cast<int>(from.width), static_cast<int>(from.height), 1, GL_RGBA, GL_UNSIGNED_BYTE);
  image->setInternalTextureFormat(GL_RGBA8);
  std::memcpy(image->data(), from.rgba.data(), from.rgba.size());
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
  texture->setResizeNonPowerOfTwoHint(false);
  return texture;
}

}  // namespace

MeshArrays::MeshArrays(const MeshData& mesh) {
  setVertices(mesh.positions, mesh.normals);
  if (!mesh.uvs.empty() && !mesh.textures.empty()) {
    uvs_ = copyOf<osg::Vec2Array>(std::span<const glm::vec2>(mesh.uvs));
  }
  if (!mesh.colors.empty()) {
    colors_ = copyOf<osg::Vec4ubArray>(std::span<const std::array<std::uint8_t, 4>>(mesh.colors), true);
    has_translucent_colors_ = std::ranges::any_of(mesh.colors, [](const auto& color) { return color[3] < 255; });
  }
  std::vector<osg::ref_ptr<osg::Texture2D>> textures;
  for (const MeshTexture& texture : mesh.textures) {
    textures.push_back(texture.width > 0 && texture.height > 0 ? makeTexture(texture) : nullptr);
  }
  for (const Submesh& submesh : mesh.submeshes) {
    const MeshMaterial& material = mesh.materials[submesh.material];
    Part part;
    part.triangles = trianglesOf(std::span(mesh.indices).subspan(submesh.first_index, submesh.index_count));
    part.box = scenegraph::findTriangleBoxes(*part.triangles, *positions_);
    part.color = {material.color[0], material.color[1], material.color[2], material.color[3]};
    part.has_own_color = material.is_from_file || colors_.valid();
    if (material.texture >= 0 && uvs_.valid()) {
      part.texture = textures[static_cast<std::size_t>(material.texture)];
    }
    parts_.push_back(std::move(part));
  }
  triangles_ = mesh.triangleCount();
  bytes_ = sizeof(*this) + mesh.byteSize();
}

MeshArrays::MeshArrays(const TriangleMesh& mesh)
    : triangles_(mesh.triangles.size() / 3),
      bytes_(sizeof(*this) + mesh.positions.size() * 2 * sizeof(glm::vec3) + mesh.triangles.size() * 4) {
  setVertices(mesh.positions, mesh.normals);
  Part part;
  part.triangles = trianglesOf(mesh.triangles);
  part.box = scenegraph::findTriangleBoxes(*part.triangles, *positions_);
  parts_.push_back(std::move(part));
}

void MeshArrays::setVertices(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals) {
  positions_ = copyOf<osg::Vec3Array>(positions);
  normals_ = copyOf<osg::Vec3Array>(normals);
  white_ = new osg::Vec4ubArray(osg::Array::BIND_OVERALL, 1);
  white_->front() = {255, 255, 255, 255};
  white_->setNormalize(true);
  for (const glm::vec3& position : positions) {
    box_.expandBy(static_cast<double>(position.x), static_cast<double>(position.y), static_cast<double>(position.z));
  }
}

osg::ref_ptr<osg::Group> MeshArrays::makeNode(const scenegraph::Color& color, bool is_overriding) const {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  for (const Part& part : parts_) {
    const bool is_own = part.has_own_color && !is_overriding;
    const osg::ref_ptr<osg::Geometry> geometry = scenegraph::makeGeometry();
    geometry->setVertexArray(positions_);
    geometry->setNormalArray(normals_);
    geometry->setColorArray(is_own && colors_.valid() ? colors_.get() : white_.get());
    geometry->addPrimitiveSet(part.triangles);
    scenegraph::setKnownBound(*geometry, part.box);
    osg::StateSet& state = *geometry->getOrCreateStateSet();
    const float alpha = (is_overriding ? 1.0F : part.color.a) * color.a;
    const scenegraph::Color& shown = is_own ? part.color : color;
    state.addUniform(new osg::Uniform("u_color", osg::Vec4(shown.r, shown.g, shown.b, alpha)));
    const bool is_textured = part.texture.valid() && !is_overriding;
    state.addUniform(new osg::Uniform("u_is_textured", is_textured));
    if (is_textured) {
      geometry->setVertexAttribArray(kUvAttribute, uvs_);
      state.setTextureAttribute(0, part.texture);
    }
    if (alpha < 1.0F || (is_own && has_translucent_colors_)) {
      scenegraph::setBlended(state, true);
    }
    group->addChild(geometry);
  }
  return group;
}

void MeshArrays::releaseGlObjects() const {
  positions_->releaseGLObjects();
  normals_->releaseGLObjects();
  for (osg::Array* const array : {static_cast<osg::Array*>(uvs_.get()), static_cast<osg::Array*>(colors_.get())}) {
    if (array != nullptr) {
      array->releaseGLObjects();
    }
  }
  for (const Part& part : parts_) {
    part.triangles->releaseGLObjects();
    if (part.texture.valid()) {
      part.texture->releaseGLObjects();
    }
  }
}

MeshState::MeshState() : state_(new osg::StateSet), opacity_(new osg::Uniform("u_opacity", 1.0F)) {
  namespace shaders = shaders::stillframe_nodes;
  state_->setAttributeAndModes(scenegraph::makeProgram("mesh", shaders::k_mesh_vert, shaders::k_mesh_frag));
  state_->addUniform(new osg::Uniform("u_texture", 0));
  state_->addUniform(opacity_);
  scenegraph::setBlended(*state_, false);
}

void MeshState::setOpacity(double opacity) {
  opacity_->set(static_cast<float>(opacity));
  scenegraph::setBlended(*state_, opacity < 1.0);
}

}  // namespace stillframe::nodes
