#pragma once

#include <cstdint>
#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/Uniform>

namespace stillframe::bench {

/// How often anything beneath a node was written that a frame would take to the driver: what two of these differ by is
/// what was touched in between, whoever did it.
class GraphWrites : public osg::NodeVisitor {
 public:
  explicit GraphWrites(osg::Node& root) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { root.accept(*this); }

  void apply(osg::Node& node) override {
    if (const osg::StateSet* const state = node.getStateSet()) {
      for (const auto& [name, uniform] : state->getUniformList()) {
        uniforms += uniform.first->getModifiedCount();
      }
    }
    traverse(node);
  }
  void apply(osg::Geometry& geometry) override {
    osg::Geometry::ArrayList all;
    geometry.getArrayList(all);
    for (const auto& array : all) {
      arrays += array->getModifiedCount();
      addresses ^= reinterpret_cast<std::uintptr_t>(array->getDataPointer());
    }
    apply(static_cast<osg::Node&>(geometry));
  }

  std::size_t uniforms = 0;
  std::size_t arrays = 0;
  std::uintptr_t addresses = 0;
};

}  // namespace stillframe::bench
