#pragma once

#include <cstdint>
#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/Uniform>
#include <unordered_set>

namespace stillframe::bench {

/// How often anything beneath a node was written that a frame would take to the driver: what two of these differ by is
/// what was touched in between, whoever did it. What is masked off counts too, and what hangs in many places once:
/// showing and hiding writes nothing.
class GraphWrites : public osg::NodeVisitor {
 public:
  explicit GraphWrites(osg::Node& root) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {
    setNodeMaskOverride(~0U);
    root.accept(*this);
  }

  void apply(osg::Node& node) override {
    const osg::StateSet* const state = node.getStateSet();
    if (state != nullptr && seen_.insert(state).second) {
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
      if (!seen_.insert(array.get()).second) {
        continue;
      }
      arrays += array->getModifiedCount();
      addresses ^= reinterpret_cast<std::uintptr_t>(array->getDataPointer());
    }
    apply(static_cast<osg::Node&>(geometry));
  }

  std::size_t uniforms = 0;
  std::size_t arrays = 0;
  std::uintptr_t addresses = 0;

 private:
  std::unordered_set<const osg::Referenced*> seen_;
};

}  // namespace stillframe::bench
