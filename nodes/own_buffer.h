#pragma once

#include <algorithm>
#include <cstddef>
#include <osg/Array>
#include <osg/BufferObject>
#include <osg/ref_ptr>

#include "scenegraph/raster/background_tasks.h"
#include "scenegraph/store/large_pages.h"

namespace stillframe::nodes {

/// Writes to each page of a block that nobody has written to yet. The system clears a page when it is first written to,
/// which costs more than what then is: by all cores at once.
inline void touchPages(std::byte* block, std::size_t bytes) {
  constexpr std::size_t kPiece = std::size_t{2} << 20;
  constexpr std::size_t kPage = 4096;
  scenegraph::runInBackground((bytes + kPiece - 1) / kPiece, [=](std::size_t piece) {
    const std::size_t end = std::min(bytes, (piece + 1) * kPiece);
    for (std::size_t at = piece * kPiece; at < end; at += kPage) {
      block[at] = std::byte{0};
    }
  });
}

/// Makes an empty array as large as `size` elements, all zero. Any thread.
template <typename Array>
void makeRoom(Array& array, std::size_t size) {
  auto& elements = array.asVector();
  elements.reserve(size);
  const std::size_t bytes = size * sizeof(elements.front());
  scenegraph::useLargePages(elements.data(), bytes);
  touchPages(reinterpret_cast<std::byte*>(elements.data()), bytes);
  elements.resize(size);  // OSG's own copies a zero from the stack to each, which stalls a dozen cycles
}

/// An array with a buffer of its own: OSG would put all arrays of a geometry into one, and upload all when one changes.
template <typename Array>
[[nodiscard]] osg::ref_ptr<Array> makeArray(std::size_t size) {
  osg::ref_ptr<Array> array = new Array(osg::Array::BIND_PER_VERTEX);
  makeRoom(*array, size);
  array->setVertexBufferObject(new osg::VertexBufferObject);
  return array;
}

}  // namespace stillframe::nodes
