#pragma once

#include <cstdint>
#include <map>
#include <osg/Program>
#include <osgUtil/RenderLeaf>
#include <osgUtil/StateGraph>
#include <utility>

#include "scenegraph/pipeline/mipmap_code.h"

namespace stillframe::scenegraph {

/// Which programs were drawn with in steps: the first use of each takes long, for OpenGL makes code for it, and is in
/// two steps of its own (it is linked, then drawn with). Programs are told apart by the nearest one above a drawable,
/// and by whether its fragments are listed (Transparency). Addresses alone are kept: one used again has its first use
/// taken for another, and its step is the longer. Beside them, what mipmaps are made with. Thread of the context only.
class FirstUses {
 public:
  enum class Is : std::uint8_t { New, Linked, Used };

  [[nodiscard]] Is& of(const osgUtil::RenderLeaf& leaf, bool is_listed) {
    const osg::StateAttribute* program = nullptr;
    for (const osgUtil::StateGraph* at = leaf._parent; at != nullptr && program == nullptr; at = at->_parent) {
      const osg::StateSet* const set = at->getStateSet();
      program = set == nullptr ? nullptr : set->getAttribute(osg::StateAttribute::PROGRAM);
    }
    return uses_[{program, is_listed}];
  }
  /// Of what lays the lists over the picture.
  [[nodiscard]] Is& ofLayingOver() { return uses_[{nullptr, true}]; }
  [[nodiscard]] MipmapCode& mipmaps() { return mipmaps_; }
  void clear() {
    uses_.clear();
    mipmaps_.clear();
  }

 private:
  std::map<std::pair<const osg::StateAttribute*, bool>, Is> uses_;
  MipmapCode mipmaps_;
};

}  // namespace stillframe::scenegraph
