#include "nodes/markers/frame_parts.h"

#include <algorithm>
#include <vector>

#include "nodes/osg_math.h"
#include "nodes/primitives/triangle_mesh.h"

namespace stillframe::nodes {
namespace {

/// How fine round meshes are: the more there are, the smaller each is as a rule.
unsigned detailOf(std::uint32_t size) { return size <= 2000 ? 2 : size <= 20'000 ? 1 : 0; }

TriangleMesh meshOf(ShapeKind kind, unsigned detail) {
  constexpr unsigned kSphereSides[] = {10, 16, 32};
  constexpr unsigned kFrustumSides[] = {10, 16, 32};
  switch (kind) {
    case ShapeKind::Box:
      return boxMesh();
    case ShapeKind::Sphere:
      return sphereMesh(kSphereSides[detail]);
    case ShapeKind::Frustum:
      return frustumMesh(0.5F, 0.5F, kFrustumSides[detail]);
    case ShapeKind::Square:
      break;
  }
  return squareMesh();
}

}  // namespace

FrameParts::FrameParts(const std::string& name, TextMaker& texts)
    : name_(name), node_(new osg::Group), rest_(name, texts) {
  node_->setName(name);
}

bool FrameParts::open(const ShapeBatchKey& key, std::uint32_t size) {
  Batch& batch = batches_[key];
  const bool is_round = key.kind == ShapeKind::Sphere || key.kind == ShapeKind::Frustum;
  const unsigned detail = is_round ? detailOf(size) : 0;
  const bool is_new = batch.mesh == nullptr || batch.detail != detail;
  if (is_new) {
    using Look = InstancedMesh::Look;
    batch.mesh = std::make_unique<InstancedMesh>(meshOf(key.kind, detail), name_,
                                                 key.kind == ShapeKind::Square ? Look::Square : Look::Solid);
    batch.detail = detail;
    batch.mesh->setOrigin(key.origin());
    applyLook(key, *batch.mesh);
    batch.mesh->setBufferTexels(buffer_texels_);
  }
  batch.mesh->resize(size);
  return is_new;
}

InstancedMesh* FrameParts::batch(const ShapeBatchKey& key) const {
  const auto found = batches_.find(key);
  return found == batches_.end() ? nullptr : found->second.mesh.get();
}

void FrameParts::applyLook(const ShapeBatchKey& key, InstancedMesh& mesh) const {
  mesh.setOpacity(opacity_);
  mesh.setBlended(key.is_blended || opacity_ < 1.0);
}

void FrameParts::setLook(double opacity, bool shows_texts) {
  rest_.setLook(opacity, shows_texts);
  if (opacity_ != opacity) {
    opacity_ = opacity;
    for (const auto& [key, batch] : batches_) {
      applyLook(key, *batch.mesh);
    }
  }
}

void FrameParts::setBufferTexels(std::uint64_t texels) {
  if (buffer_texels_ != texels) {
    buffer_texels_ = texels;
    rest_.setBufferTexels(texels);
    for (const auto& [key, batch] : batches_) {
      batch.mesh->setBufferTexels(texels);
    }
  }
}

std::uint64_t FrameParts::texelsTooMany() const {
  std::uint64_t needed = rest_.texelsTooMany();
  for (const auto& [key, batch] : batches_) {
    needed = std::max(needed, batch.mesh->texelsTooMany());
  }
  return needed;
}

void FrameParts::commit() {
  for (const auto& [key, batch] : batches_) {
    batch.mesh->commit();
  }
  rest_.commit();
  std::vector<osg::Node*> wanted;
  for (const auto& [key, batch] : batches_) {
    wanted.push_back(&batch.mesh->node());
  }
  rest_.list(wanted);
  bool is_same = wanted.size() == node_->getNumChildren();
  for (unsigned i = 0; is_same && i < wanted.size(); ++i) {
    is_same = node_->getChild(i) == wanted[i];
  }
  if (!is_same) {
    node_->removeChildren(0, node_->getNumChildren());
    for (osg::Node* const node : wanted) {
      node_->addChild(node);
    }
  }
}

osg::BoundingBoxd FrameParts::box() const {
  osg::BoundingBoxd box = rest_.box();
  for (const auto& [key, batch] : batches_) {
    const osg::BoundingBoxd& part = batch.mesh->box();
    if (part.valid()) {
      const osg::Vec3d origin = toOsg(key.origin());
      box.expandBy(origin + part._min);
      box.expandBy(origin + part._max);
    }
  }
  return box;
}

std::size_t FrameParts::drawCalls() const {
  std::size_t calls = rest_.drawCalls();
  for (const auto& [key, batch] : batches_) {
    calls += batch.mesh->box().valid() ? 1 : 0;
  }
  return calls;
}

}  // namespace stillframe::nodes
