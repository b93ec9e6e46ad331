#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <osg/Geometry>
#include <osg/StateSet>
#include <osg/Texture>
#include <osg/ref_ptr>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderBin>
#include <span>
#include <vector>

#include "scenegraph/pipeline/blend_limits.h"

namespace stillframe::scenegraph {

/// Draws what is blended (setBlended()) without regard to the order it comes in.
///
/// Its fragments are not blended as they come but kept in lists, one for each sample, by the shaders as they are with
/// SF_LISTED defined; a full-screen step then puts each list in order of depth and lays it over the picture. So things
/// that run through each other come out right, and no order of layers or of triangles changes a pixel; depth is that of
/// the nearest. Flat layers, which bins 1 to 9 keep in their order (nodes/flat_order.h), go into the lists too, with
/// the depth they write themselves; without anything else that is blended they stay as they are. A frame without them
/// costs nothing: not a target, not a shader. With them 16 bytes a fragment, from 4 MiB to 256 MiB; a picture with more
/// is drawn in bands. The nearest fragments of a sample are exact, beyond BlendLimits the rest counts by its mean:
/// `stillframe accuracy transparency` has the curve. A wait for the GPU a frame. Thread of the context only.
// NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor): OSG counts references
class Transparency : public osgUtil::RenderBin::DrawCallback {
 public:
  /// `depths`: the target of the scene's depth, with as many samples.
  Transparency(int width_px, int height_px, int samples, const osg::ref_ptr<osg::Texture>& depths,
               const BlendLimits& limits);

  /// To be called when `cull` has been through the scene: takes over the bin of what is blended, if there is one.
  void adopt(osgUtil::CullVisitor& cull);
  /// All of it.
  void drawImplementation(osgUtil::RenderBin* bin, osg::RenderInfo& render_info,
                          osgUtil::RenderLeaf*& previous) override;
  /// What is collected at a time; no leaf: the whole bin.
  struct Piece {
    osgUtil::RenderLeaf* leaf = nullptr;
    std::optional<std::size_t> slice = {};
  };
  /// Those of a bin: a drawable each, of large ones, where `slices`, a slice. Good as long as the bin.
  [[nodiscard]] static std::vector<Piece> piecesOf(const osgUtil::RenderBin& bin, bool slices);
  /// All of it in pieces, over several frames, and at last what lays the lists over the picture.
  void begin() noexcept { collected_ = pieces_ = 0, is_begun_ = false; }
  void drawPiece(osgUtil::RenderBin& bin, std::span<const Piece> pieces, osg::RenderInfo& render_info,
                 osgUtil::RenderLeaf*& previous);
  /// Links the program of the next of them, which has a leaf.
  void linkPiece(std::span<const Piece> pieces, osg::RenderInfo& render_info, osgUtil::RenderLeaf*& previous);
  /// What the next of them draws; nullptr for none or many.
  [[nodiscard]] osgUtil::RenderLeaf* nextLeaf(std::span<const Piece> pieces) const {
    return collected_ < pieces.size() ? pieces[collected_].leaf : nullptr;
  }
  /// That are drawn since begin().
  [[nodiscard]] std::size_t pieces() const noexcept { return pieces_; }
  [[nodiscard]] bool isDone() const noexcept { return is_begun_ && to_do_.empty(); }
  /// Whether the last frame had anything blended.
  [[nodiscard]] bool isInUse() const noexcept { return is_in_use_; }
  /// Bands that the last frame was drawn in; 0 without anything blended.
  [[nodiscard]] int bands() const noexcept { return bands_; }
  /// The context must be current.
  void release(osg::State& state);

 protected:
  ~Transparency() override = default;

 private:
  struct Rows {
    int first = 0;
    int count = 0;
  };
  void makeLists();
  bool grow(std::uint32_t fragments);
  void start();
  void clearLists();
  void collect(osgUtil::RenderBin& bin, osg::RenderInfo& render_info, osgUtil::RenderLeaf*& previous);
  void endRows(osg::RenderInfo& render_info);
  void layOver(osg::RenderInfo& render_info, const Rows& rows);

  int width_px_;
  int height_px_;
  int samples_;
  std::uint32_t most_fragments_;
  bool is_in_use_ = false;
  int bands_ = 0;
  bool is_begun_ = false;
  std::vector<Rows> to_do_;    // of the picture; the last are being collected
  std::size_t collected_ = 0;  // drawables and slices of them
  std::size_t pieces_ = 0;
  osg::ref_ptr<osg::StateSet> collecting_;
  osg::ref_ptr<osg::Geometry> laying_over_;
  // Names of textures, 0 before they are needed.
  std::uint32_t heads_ = 0;
  std::uint32_t count_ = 0;
  std::uint32_t fragments_ = 0;
  std::uint32_t capacity_ = 0;  // fragments
};

}  // namespace stillframe::scenegraph
