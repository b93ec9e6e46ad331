#pragma once

#include <cstddef>
#include <osg/Array>
#include <osg/Group>
#include <osg/Referenced>
#include <osg/ref_ptr>
#include <utility>
#include <vector>

namespace stillframe::scenegraph {

/// Parts of arrays that changed in place since they were uploaded, so that a frame uploads these alone: stock OSG
/// uploads an array whole.
///
/// One hangs on the root of a graph as its user data (which no file keeps); the view pipeline calls upload() before it
/// draws. Whoever draws the graph without that must not have drawn it before: a first upload is whole. GUI thread.
class BufferPatches : public osg::Referenced {
 public:
  ~BufferPatches() override = default;
  /// Makes those of `root`, unless it has some.
  static void hangOn(osg::Group& root);
  /// Those of the graph that `node` is the root of, or hangs in; nullptr when there are none.
  static BufferPatches* find(osg::Node& node);

  /// Bytes [first, last) of the array's data were written, and its size is as before. `array` is not to be dirtied.
  void add(osg::Array& array, std::size_t first, std::size_t last);
  /// Takes what was added to the context that is current. What it has not got yet is left to OSG, and so is all where
  /// others drew the array too, or where most of it changed.
  void upload(unsigned context_id);

  /// What the last upload() wrote itself.
  [[nodiscard]] std::size_t uploadedBytes() const noexcept { return uploaded_bytes_; }

 private:
  struct Patch {
    osg::ref_ptr<osg::Array> array;
    std::vector<std::pair<std::size_t, std::size_t>> ranges;
  };
  std::vector<Patch> patches_;
  std::size_t uploaded_bytes_ = 0;
};

}  // namespace stillframe::scenegraph
