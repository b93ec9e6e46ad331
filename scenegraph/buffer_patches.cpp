#include "scenegraph/buffer_patches.h"

#include <algorithm>
#include <osg/BufferObject>
#include <osg/GLExtensions>
#include <osg/GraphicsContext>

namespace stillframe::scenegraph {
namespace {

// A call costs about as much as so many bytes: ranges nearer than that go together.
constexpr std::size_t kGap = 1024;
constexpr std::size_t kMostRanges = 8192;  // of frames that nobody draws

/// Sorts, and joins what touches or nearly so. Returns the bytes in all.
std::size_t join(std::vector<std::pair<std::size_t, std::size_t>>& ranges) {
  std::ranges::sort(ranges);
  std::size_t kept = 0;
  for (std::size_t i = 1; i < ranges.size(); ++i) {
    if (ranges[i].first <= ranges[kept].second + kGap) {
      ranges[kept].second = std::max(ranges[kept].second, ranges[i].second);
    } else {
      ranges[++kept] = ranges[i];
    }
  }
  ranges.resize(std::min(ranges.size(), kept + 1));
  std::size_t bytes = 0;
  for (const auto& [first, last] : ranges) {
    bytes += last - first;
  }
  return bytes;
}

bool isDrawnElsewhere(const osg::BufferObject& buffer, unsigned context_id) {
  for (unsigned other = 0; other <= osg::GraphicsContext::getMaxContextID(); ++other) {
    if (other != context_id && buffer.getGLBufferObject(other) != nullptr) {
      return true;
    }
  }
  return false;
}

}  // namespace

void BufferPatches::hangOn(osg::Group& root) {
  if (dynamic_cast<BufferPatches*>(root.getUserData()) == nullptr) {
    root.setUserData(new BufferPatches);
  }
}

BufferPatches* BufferPatches::find(osg::Node& node) {
  for (osg::Node* at = &node; at != nullptr; at = at->getNumParents() > 0 ? at->getParent(0) : nullptr) {
    if (auto* const patches = dynamic_cast<BufferPatches*>(at->getUserData())) {
      return patches;
    }
  }
  return nullptr;
}

void BufferPatches::add(osg::Array& array, std::size_t first, std::size_t last) {
  const auto known = std::ranges::find_if(patches_, [&](const Patch& patch) { return patch.array == &array; });
  Patch& patch = known != patches_.end() ? *known : patches_.emplace_back(Patch{&array, {}});
  if (!patch.ranges.empty() && patch.ranges.back().second == first) {
    patch.ranges.back().second = last;
  } else {
    patch.ranges.emplace_back(first, last);
  }
  if (patch.ranges.size() > kMostRanges && (join(patch.ranges), patch.ranges.size() > kMostRanges / 2)) {
    patch.ranges = {{patch.ranges.front().first, patch.ranges.back().second}};
  }
}

void BufferPatches::upload(unsigned context_id) {
  uploaded_bytes_ = 0;
  for (Patch& patch : std::exchange(patches_, {})) {
    osg::Array& array = *patch.array;
    const osg::BufferObject* const buffer = array.getBufferObject();
    osg::GLBufferObject* const gl_buffer = buffer != nullptr ? buffer->getGLBufferObject(context_id) : nullptr;
    const std::size_t total = array.getTotalDataSize();
    const std::size_t bytes = join(patch.ranges);
    if (gl_buffer == nullptr || gl_buffer->isDirty() || 2 * bytes > total || patch.ranges.back().second > total ||
        isDrawnElsewhere(*buffer, context_id)) {
      array.dirty();
      continue;
    }
    const GLsizeiptr offset = gl_buffer->getOffset(array.getBufferIndex());
    const auto* const data = static_cast<const char*>(array.getDataPointer());
    gl_buffer->bindBuffer();
    for (const auto& [first, last] : patch.ranges) {
      gl_buffer->_extensions->glBufferSubData(gl_buffer->getProfile()._target, offset + static_cast<GLintptr>(first),
                                              static_cast<GLsizeiptr>(last - first), data + first);
    }
    gl_buffer->unbindBuffer();
    uploaded_bytes_ += bytes;
  }
}

}  // namespace stillframe::scenegraph
