#pragma once

#include <cstdint>
#include <osg/Node>
#include <osg/StateSet>
#include <osg/ref_ptr>
#include <osgText/Font>
#include <osgText/Text>

namespace stillframe::nodes {

/// What texts are made of, whatever they say and wherever they stand: font, shader, blending. One a maker of texts,
/// whose texts share the state.
///
/// The font is looked for with the first text: DejaVu or Liberation where Debian installs them, else the one built into
/// OSG. GUI thread.
class TextParts {
 public:
  enum class Place : std::uint8_t {
    InScene,  ///< hidden by what is nearer
    OverAll,  ///< drawn last, without a test of depth
  };
  explicit TextParts(Place place) : place_(place) {}

  /// A text in the font, empty as yet. Never culled: its extent depends on the camera.
  [[nodiscard]] osg::ref_ptr<osgText::Text> makeText();
  /// `text` with the state that draws it, ready to be hung somewhere.
  [[nodiscard]] osg::ref_ptr<osg::Node> makeLabel(const osg::ref_ptr<osgText::Text>& text);

 private:
  void look();

  Place place_;
  osg::ref_ptr<osgText::Font> font_;
  osg::ref_ptr<osg::StateSet> state_;  // none before the first text
};

}  // namespace stillframe::nodes
