#include "scenegraph/pipeline/buffer_uploads.h"

#include <algorithm>
#include <osg/GLExtensions>
#include <osg/Geometry>
#include <osg/TextureBuffer>
#include <osgUtil/StateGraph>

namespace stillframe::scenegraph {
namespace {

// Bound by nobody else: neither OSG's notion of what is bound nor a vertex array object is disturbed.
constexpr GLenum kTarget = GL_COPY_WRITE_BUFFER;

void GL_APIENTRY writeNothing(GLenum /*target*/, GLintptr /*offset*/, GLsizeiptr /*size*/, const GLvoid* /*data*/) {}

std::size_t bytesOf(const osg::BufferObject& buffer) {
  std::size_t bytes = 0;
  for (unsigned i = 0; i < buffer.getNumBufferData(); ++i) {
    const osg::BufferData* const data = buffer.getBufferData(i);
    bytes += data == nullptr ? 0 : data->getTotalDataSize();
  }
  return bytes;
}

/// An image has rows of its own, of which OSG knows.
bool suits(const osg::BufferObject& buffer) {
  for (unsigned i = 0; i < buffer.getNumBufferData(); ++i) {
    if (const osg::BufferData* const data = buffer.getBufferData(i); data != nullptr && data->asImage() != nullptr) {
      return false;
    }
  }
  return bytesOf(buffer) > BufferUploads::kBandBytes;
}

/// As OSG makes it, with room for all, but nothing written: OSG 3.6.5 has no way to do the one without the other.
osg::ref_ptr<osg::GLBufferObject> makeEmpty(const osg::BufferObject& buffer, osg::State& state) {
  osg::ref_ptr<osg::GLBufferObject> object = buffer.getOrCreateGLBufferObject(state.getContextID());
  state.unbindVertexBufferObject();
  state.unbindElementBufferObject();
  auto& write = object->_extensions->glBufferSubData;
  const auto kept = write;
  write = writeNothing;
  // Else Mesa warns of writing to it in parts. OSG tells buffers that may be used again apart by what it made them for.
  const osg::BufferObjectProfile profile = object->getProfile();
  object->setProfile({profile._target, GL_DYNAMIC_DRAW, profile._size});
  object->compileBuffer();
  object->setProfile({profile._target, profile._usage, object->getProfile()._size});
  write = kept;
  object->unbindBuffer();
  return object;
}

}  // namespace

bool BufferUploads::bring(const osgUtil::RenderLeaf& leaf, bool has_indices, osg::State& state,
                          const std::function<bool()>& is_time_up) {
  for (const osgUtil::StateGraph* at = leaf._parent; at != nullptr; at = at->_parent) {
    const osg::StateSet* const set = at->getStateSet();
    for (unsigned unit = 0; set != nullptr && unit < set->getNumTextureAttributeLists(); ++unit) {
      const auto* const texture =
          dynamic_cast<const osg::TextureBuffer*>(set->getTextureAttribute(unit, osg::StateAttribute::TEXTURE));
      if (texture != nullptr && !bringOne(texture->getBufferData(), state, is_time_up)) {
        return false;
      }
    }
  }
  const osg::Geometry* const geometry = leaf._drawable->asGeometry();
  if (geometry == nullptr || !geometry->getUseVertexBufferObjects()) {
    return true;
  }
  osg::Geometry::ArrayList arrays;
  geometry->getArrayList(arrays);
  for (const auto& array : arrays) {
    if (!bringOne(array, state, is_time_up)) {
      return false;
    }
  }
  for (unsigned i = 0; has_indices && i < geometry->getNumPrimitiveSets(); ++i) {
    if (!bringOne(geometry->getPrimitiveSet(i)->getDrawElements(), state, is_time_up)) {
      return false;
    }
  }
  return true;
}

bool BufferUploads::bringOne(const osg::BufferData* data, osg::State& state, const std::function<bool()>& is_time_up) {
  const osg::BufferObject* const buffer = data == nullptr ? nullptr : data->getBufferObject();
  if (buffer == nullptr) {
    return true;
  }
  const osg::GLBufferObject* const there = buffer->getGLBufferObject(state.getContextID());
  const bool is_under_way = under_way_ && under_way_->object == there && under_way_->buffer == buffer;
  if (is_under_way && there->isDirty()) {  // it has changed: what is there may be of before
    drop();
  } else if (!is_under_way && (there != nullptr || !suits(*buffer))) {
    return true;
  }
  if (!under_way_ || under_way_->buffer != buffer) {
    drop();
    under_way_.emplace(Upload{.buffer = const_cast<osg::BufferObject*>(buffer), .object = makeEmpty(*buffer, state)});
  }
  Upload& upload = *under_way_;
  const osg::GLExtensions& gl = *upload.object->_extensions;
  gl.glBindBuffer(kTarget, upload.object->getGLObjectID());
  bool ends = false;
  while (upload.data < buffer->getNumBufferData() && !ends) {
    const osg::BufferData* const from = buffer->getBufferData(upload.data);
    const std::size_t all = from == nullptr ? 0 : from->getTotalDataSize();
    const std::size_t count = std::min(kBandBytes, all - upload.bytes);
    if (count > 0) {
      gl.glBufferSubData(kTarget, upload.object->getOffset(upload.data) + static_cast<GLintptr>(upload.bytes),
                         static_cast<GLsizeiptr>(count),
                         static_cast<const char*>(from->getDataPointer()) + upload.bytes);
    }
    upload.bytes += count;
    if (upload.bytes == all) {
      ++upload.data;
      upload.bytes = 0;
    }
    ends = count > 0 && is_time_up();
  }
  gl.glBindBuffer(kTarget, 0);
  if (upload.data < buffer->getNumBufferData()) {
    return false;
  }
  under_way_.reset();
  return !ends;
}

void BufferUploads::drop() {
  if (under_way_) {
    under_way_->object->clear();
    under_way_.reset();
  }
}

}  // namespace stillframe::scenegraph
