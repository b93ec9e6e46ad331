#pragma once

#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/Program>
#include <osg/ref_ptr>
#include <string>

namespace stillframe::scenegraph {

/// A geometry as every layer and pass must draw it: vertex buffers on, display list off, free of VAOs.
///
/// Display lists do not hold vertex attributes, and VAOs mixed with other drawables corrupt attribute bindings in a
/// compatibility context. The bound follows the vertex array (call dirtyBound() after changing it). GUI thread.
[[nodiscard]] osg::ref_ptr<osg::Geometry> makeGeometry();
/// For geometry whose vertices do not tell where it is drawn (instances): `bound` counts besides the vertices' own.
[[nodiscard]] osg::ref_ptr<osg::Geometry> makeGeometry(const osg::BoundingBox& bound);

/// Node mask of geometries that a rasteriser of points may draw in OpenGL's stead: opaque points whose vertices are
/// drawn as they are, with the uniforms of nodes/point_cloud's shader. OpenGL draws them too where it is not told
/// otherwise, in a stock viewer for one.
inline constexpr osg::Node::NodeMask kOpaquePoints = 0x2;

/// Node mask of mere reference, a ground grid: never what somebody means who points at the picture.
inline constexpr osg::Node::NodeMask kReference = 0x4;

/// The program of these two shaders, the same object for every caller with the same name and text, for as long as
/// somebody uses it: OSG then sorts by it and compiles it once a context. Any thread.
///
/// `name` is what compile errors and exported files call it.
[[nodiscard]] osg::ref_ptr<osg::Program> makeProgram(const std::string& name, const std::string& vertex_source,
                                                     const std::string& fragment_source);

}  // namespace stillframe::scenegraph
