#pragma once

#include <osg/Node>
#include <string>

namespace stillframe::test {

/// What is drawn beneath `root`, as text: equal texts mean equal pictures, bit for bit.
///
/// Names, matrices, arrays, primitives, uniforms and state, in the order in which they are drawn; nothing of nodes that
/// are masked off, or of bounds. Doubles and floats are written exactly, arrays by their hash.
[[nodiscard]] std::string dumpGraph(osg::Node& root);

/// How a graph is written: as .osgb bytes, which keep every bit, or as .osgt text with 17 digits, which OSG 3.6.5 reads
/// back a few units in the last place off.
enum class GraphFile { Binary, Text };
/// The graph written and read back by plain OSG; nullptr when either fails.
[[nodiscard]] osg::ref_ptr<osg::Node> writtenAndRead(const osg::Node& root, GraphFile file);
/// The first word in which two dumps differ by more than 2e-15 of its value; "" when there is none.
[[nodiscard]] std::string firstRealDifference(const std::string& one, const std::string& other);

/// "library::Class" of every object beneath `root` that stock OSG does not know by name, one a line.
[[nodiscard]] std::string foreignClasses(osg::Node& root);

}  // namespace stillframe::test
