#pragma once

#include <cstddef>
#include <osg/Node>
#include <osg/ref_ptr>
#include <string_view>

#include "nodes/text/text_parts.h"
#include "scenegraph/settings.h"

namespace stillframe::nodes {

/// How a text stands in the picture.
struct TextStyle {
  double height = 16.0;  ///< of a line; pixels or metres
  bool is_in_pixels = true;
  bool faces_viewer = true;  ///< else in the plane z = 0, running along +x
  bool is_centred = false;   ///< about the origin; else with its lower left corner there
  scenegraph::Color color = {};
};

/// Makes texts: UTF-8, any number of lines, sharp up to the height of its glyphs in their texture.
/// GUI thread.
class TextMaker {
 public:
  /// Height of the glyphs of texts in metres, which may come near; OSG's own, 32, for texts in pixels.
  static constexpr unsigned kGlyphTexels = 96;
  /// What is drawn of a text at most, in bytes.
  static constexpr std::size_t kMostBytes = 4096;

  /// About the origin of its parent. Never culled: its extent depends on the camera.
  [[nodiscard]] osg::ref_ptr<osg::Node> make(std::string_view utf8, const TextStyle& style);

 private:
  TextParts parts_{TextParts::Place::InScene};
};

}  // namespace stillframe::nodes
