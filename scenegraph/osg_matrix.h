#pragma once

#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>
#include <osg/Matrixd>

namespace stillframe::scenegraph {

/// The same matrix, exactly: OSG's rows, by which it multiplies from the left, are GLM's columns.
[[nodiscard]] inline osg::Matrixd toOsg(const glm::dmat4& matrix) { return osg::Matrixd(glm::value_ptr(matrix)); }

}  // namespace stillframe::scenegraph
