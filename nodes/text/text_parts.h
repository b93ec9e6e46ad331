#pragma once

#include <cstdint>
#include <osg/Node>
#include <osg/StateSet>
#include <osg/ref_ptr>
#include <osgText/Font>
#include <osgText/Text>
#include <set>
#include <string>
#include <utility>

namespace stillframe::nodes {

/// What texts are made of, whatever they say and wherever they stand: font, shader, blending. One a maker of texts,
/// whose texts share the state.
///
/// The font is looked for with the first text: DejaVu or Liberation where Debian installs them, else the one built into
/// OSG. OSG draws a text in one font: one with Chinese, Japanese or Korean is drawn in one that has them, where there
/// is such a font. GUI thread.
class TextParts {
 public:
  enum class Place : std::uint8_t {
    InScene,  ///< hidden by what is nearer
    OverAll,  ///< drawn last, without a test of depth
  };
  explicit TextParts(Place place) : place_(place) {}

  /// A text that says this, in a font that has its characters, of glyphs made in so many texels. Never culled: its
  /// extent depends on the camera.
  ///
  /// Where a glyph lies in the font's texture follows from the order in which glyphs are asked for, and what is sampled
  /// between texels follows from where it lies. So that equal scenes give equal pictures, whatever was shown before,
  /// the characters of ASCII are placed first, all of them: some milliseconds, once in a process.
  [[nodiscard]] osg::ref_ptr<osgText::Text> makeText(const std::string& utf8, unsigned texels = kUsualTexels);
  static constexpr unsigned kUsualTexels = 32;  // OSG's own
  /// `text` with the state that draws it, ready to be hung somewhere.
  [[nodiscard]] osg::ref_ptr<osg::Node> makeLabel(const osg::ref_ptr<osgText::Text>& text);

 private:
  void look();
  void placeAscii(osgText::Font& font, unsigned texels);
  osg::ref_ptr<osgText::Font> fontFor(const osgText::String& characters);

  Place place_;
  osg::ref_ptr<osgText::Font> font_;
  osg::ref_ptr<osgText::Font> east_asian_;  // none before the first such text
  bool has_looked_east_ = false;
  std::set<std::pair<const osgText::Font*, unsigned>> placed_;  // fonts, held above, and texels whose glyphs are
  osg::ref_ptr<osg::StateSet> state_;                           // none before the first text
};

}  // namespace stillframe::nodes
