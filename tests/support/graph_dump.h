#pragma once

#include <osg/Node>
#include <string>

namespace stillframe::test {

/// What is drawn beneath `root`, as text: equal texts mean equal pictures, bit for bit.
///
/// Names, matrices, arrays, primitives, uniforms and state; nothing of nodes that are masked off, of children's order
/// beneath the root (frames come and go) or of bounds. Doubles and floats are written exactly, arrays by their hash.
[[nodiscard]] std::string dumpGraph(osg::Node& root);

/// The graph written as .osgt text with 17 digits and read back by plain OSG; nullptr when either fails.
[[nodiscard]] osg::ref_ptr<osg::Node> writtenAndRead(const osg::Node& root);

/// "library::Class" of every object beneath `root` that stock OSG does not know by name, one a line.
[[nodiscard]] std::string foreignClasses(osg::Node& root);

}  // namespace stillframe::test
