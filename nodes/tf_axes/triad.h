#pragma once

#include <osg/Geometry>
#include <osg/ref_ptr>

namespace stillframe::nodes {

/// Three arms from the origin along +x, +y and +z in red, green and blue: `length_m` long, a twelfth of it thick.
/// One is enough for any number of frames. `is_dim`: greyed, for frames that nothing has been heard of for long.
[[nodiscard]] osg::ref_ptr<osg::Geometry> makeTriad(double length_m, bool is_dim = false);

/// A line from the origin to (1, 0, 0).
[[nodiscard]] osg::ref_ptr<osg::Geometry> makeUnitLine();

}  // namespace stillframe::nodes
