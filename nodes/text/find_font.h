#pragma once

#include <osg/ref_ptr>
#include <osgText/Font>
#include <osgText/String>

namespace stillframe::nodes {

/// DejaVu or Liberation where Debian installs them; nullptr where there is neither. Reads a file: ask once.
[[nodiscard]] osg::ref_ptr<osgText::Font> findFont();

/// Of Chinese, Japanese and Korean too, with Latin letters beside: WenQuanYi or Noto; nullptr where there is neither.
/// Reads a file of megabytes: ask once.
[[nodiscard]] osg::ref_ptr<osgText::Font> findEastAsianFont();

/// Whether a character, by its number in Unicode, is of Chinese, Japanese or Korean, which findFont() has not.
[[nodiscard]] bool isEastAsian(unsigned code) noexcept;

/// Whether a text holds such characters.
[[nodiscard]] bool isEastAsian(const osgText::String& text) noexcept;

}  // namespace stillframe::nodes
