#pragma once

#include <osg/ref_ptr>
#include <osgText/Font>

namespace stillframe::nodes {

/// DejaVu or Liberation where Debian installs them; nullptr where there is neither. Reads a file: ask once.
[[nodiscard]] osg::ref_ptr<osgText::Font> findFont();

}  // namespace stillframe::nodes
