#include "nodes/primitives/instanced_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <osg/BufferObject>
#include <osg/TextureBuffer>

#include "generated/stillframe_nodes/shaders.h"
#include "scenegraph/blending.h"
#include "scenegraph/buffer_patches.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {
namespace {

constexpr unsigned kInstanceUnit = 1;  // 0 is for a texture on the mesh

osg::Vec3 toVec3(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

InstancedMesh::InstancedMesh(const TriangleMesh& mesh, const std::string& name, Look look)
    : node_(new osg::MatrixTransform),
      geometry_(scenegraph::makeGeometry()),
      vertices_(new osg::Vec3Array(osg::Array::BIND_PER_VERTEX)),
      triangles_(new osg::DrawElementsUInt(GL_TRIANGLES)),
      texels_(new osg::Vec4Array),
      opacity_(new osg::Uniform("u_opacity", 1.0F)) {
  const osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
  mesh_low_ = mesh_high_ = mesh.positions.empty() ? glm::dvec3(0.0) : glm::dvec3(mesh.positions.front());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3 position(mesh.positions[i]);
    mesh_low_ = glm::min(mesh_low_, position);
    mesh_high_ = glm::max(mesh_high_, position);
    vertices_->push_back(toVec3(position));
    normals->push_back(toVec3(glm::dvec3(mesh.normals[i])));
  }
  triangles_->assign(mesh.triangles.begin(), mesh.triangles.end());
  // OSG 3.6.5 reads no initial bound from a file, and bounds what is drawn: a triangle of no area holds the corners.
  const auto corner = static_cast<GLuint>(vertices_->size());
  for (const GLuint index : {corner, corner + 1, corner + 1}) {
    triangles_->push_back(index);
  }
  for (int i = 0; i < 2; ++i) {
    vertices_->push_back({});
    normals->push_back({0.0F, 0.0F, 1.0F});
  }
  // The corners change with the copies.
  const osg::ref_ptr<osg::VertexBufferObject> buffer_object = new osg::VertexBufferObject;
  buffer_object->setUsage(GL_DYNAMIC_DRAW_ARB);
  vertices_->setVertexBufferObject(buffer_object);
  geometry_->setName(name);
  geometry_->setVertexArray(vertices_);
  geometry_->setNormalArray(normals);
  geometry_->addPrimitiveSet(triangles_);
  const osg::ref_ptr<osg::TextureBuffer> buffer = new osg::TextureBuffer(texels_);
  buffer->setInternalFormat(GL_RGBA32F_ARB);
  osg::StateSet& state = *geometry_->getOrCreateStateSet();
  namespace shaders = shaders::stillframe_nodes;
  state.setAttributeAndModes(
      scenegraph::makeProgram("primitive", shaders::k_primitive_vert, shaders::k_primitive_frag));
  state.setTextureAttribute(kInstanceUnit, buffer);
  state.addUniform(new osg::Uniform("u_instances", static_cast<int>(kInstanceUnit)));
  state.addUniform(new osg::Uniform("u_faces_viewer", look == Look::Square));
  state.addUniform(opacity_);
  scenegraph::setBlended(state, false);
  faces_viewer_ = look == Look::Square;
  node_->setName(name);
  node_->addChild(geometry_);
  is_dirty_ = true;
  commit();
}

const Instance& InstancedMesh::at(std::size_t index) const {
  return reinterpret_cast<const Instance*>(texels_->getDataPointer())[index];
}

void InstancedMesh::setOrigin(const glm::dvec3& origin_in_frame) {
  origin_ = origin_in_frame;
  node_->setMatrix(osg::Matrixd::translate(origin_.x, origin_.y, origin_.z));
}

void InstancedMesh::resize(std::size_t count) {
  const std::size_t before = size();
  if (count == before) {
    return;
  }
  texels_->asVector().resize(kTexels * count);  // OSG's own copies a zero from the stack to each, and stalls
  is_resized_ = true;
  boxes_.resize((count + kBlock - 1) / kBlock);
  is_block_touched_.resize(boxes_.size(), 0);
  std::erase_if(touched_blocks_, [&](std::size_t block) { return block >= boxes_.size(); });
  if (count > 0) {
    touch(std::min(before, count) / kBlock * kBlock, count);  // the last block may have shrunk
  }
  is_dirty_ = true;
}

void InstancedMesh::set(std::size_t first, std::span<const Instance> instances) {
  if (instances.empty()) {
    return;
  }
  std::memcpy((*texels_)[kTexels * first].ptr(), instances.data(), instances.size_bytes());
  touch(first, first + instances.size());
}

void InstancedMesh::hide(std::size_t first, std::size_t count) {
  const std::size_t last = std::min(first + count, size());
  if (first < last) {
    std::fill(texels_->begin() + static_cast<std::ptrdiff_t>(kTexels * first),
              texels_->begin() + static_cast<std::ptrdiff_t>(kTexels * last), osg::Vec4());
    touch(first, last);
  }
}

void InstancedMesh::touch(std::size_t first, std::size_t last) {
  is_dirty_ = true;
  touched_.emplace_back(first, last);
  for (std::size_t block = first / kBlock; block * kBlock < last; ++block) {
    if (is_block_touched_[block] == 0) {
      is_block_touched_[block] = 1;
      touched_blocks_.push_back(block);
    }
  }
}

void InstancedMesh::setBlended(bool is_blended) {
  scenegraph::setBlended(*geometry_->getOrCreateStateSet(), is_blended);
}

void InstancedMesh::setOpacity(double opacity) { opacity_->set(static_cast<float>(opacity)); }

void InstancedMesh::setBufferTexels(std::uint64_t texels) {
  is_dirty_ = is_dirty_ || buffer_texels_ != texels;
  buffer_texels_ = texels;
}

void InstancedMesh::commit() {
  if (!is_dirty_) {
    return;
  }
  is_dirty_ = false;
  const glm::dvec3 centre = 0.5 * (mesh_low_ + mesh_high_);
  const glm::dvec3 half = 0.5 * (mesh_high_ - mesh_low_);
  for (const std::size_t block : touched_blocks_) {
    is_block_touched_[block] = 0;
    osg::BoundingBoxd& box = boxes_[block];
    box.init();
    for (std::size_t i = block * kBlock; i < std::min((block + 1) * kBlock, size()); ++i) {
      const Instance& instance = at(i);
      if (!(instance.alpha > 0.0F)) {
        continue;
      }
      osg::Vec3d low;
      osg::Vec3d high;
      for (int row = 0; row < 3; ++row) {
        const float* const m = &instance.local_from_mesh[std::size_t{4} * static_cast<std::size_t>(row)];
        const double at_centre = m[0] * centre.x + m[1] * centre.y + m[2] * centre.z + m[3];
        double reach = std::abs(m[0]) * half.x + std::abs(m[1]) * half.y + std::abs(m[2]) * half.z;
        if (faces_viewer_) {  // whichever way it is turned
          const auto& all = instance.local_from_mesh;
          reach = std::hypot(all[0] * half.x, all[5] * half.y);
        }
        low[row] = at_centre - reach;
        high[row] = at_centre + reach;
      }
      box.expandBy(low);
      box.expandBy(high);
    }
  }
  touched_blocks_.clear();
  box_.init();
  for (const osg::BoundingBoxd& box : boxes_) {
    box_.expandBy(box);
  }
  if (texelsTooMany() > 0) {
    box_.init();
    is_resized_ = true;  // nothing of it is on the GPU
  }
  triangles_->setNumInstances(static_cast<int>(size()));
  upload();
  setCorners();
  node_->setNodeMask(box_.valid() ? ~0U : 0U);
}

void InstancedMesh::upload() {
  scenegraph::BufferPatches* const patches = is_resized_ ? nullptr : scenegraph::BufferPatches::find(*node_);
  if (patches == nullptr) {
    texels_->dirty();
  }
  for (const auto& [first, last] : touched_) {
    if (patches != nullptr) {
      patches->add(*texels_, first * sizeof(Instance), last * sizeof(Instance));
    }
  }
  touched_.clear();
  is_resized_ = false;
}

void InstancedMesh::setCorners() {
  const osg::Vec3 low(box_.valid() ? osg::Vec3(box_._min) : osg::Vec3());
  const osg::Vec3 high(box_.valid() ? osg::Vec3(box_._max) : osg::Vec3());
  const std::size_t corner = vertices_->size() - 2;
  if ((*vertices_)[corner] != low || (*vertices_)[corner + 1] != high) {
    (*vertices_)[corner] = low;
    (*vertices_)[corner + 1] = high;
    vertices_->dirty();
    geometry_->dirtyBound();
  }
}

}  // namespace stillframe::nodes
