#include "nodes/voxel_grid/voxel_state.h"

#include <algorithm>
#include <array>

#include "generated/stillframe_nodes/shaders.h"
#include "scenegraph/blending.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {
namespace {

constexpr int kNoField = -1;
constexpr std::array<const char*, 4> kSamplers{"u_drawn_by", "u_colored_by", "u_rgba", "u_list"};  // units 0 to 3

void setForm(osg::Uniform& uniform, const VoxelField* field) {
  if (field == nullptr) {
    uniform.set(kNoField, 0, 0);
  } else {
    // An offset of integers is within int32: it lies between two values of them, or amid those of uint32.
    uniform.set(static_cast<int>(field->format.kind), static_cast<int>(field->format.shift),
                std::abs(field->limits.offset) < 2147483648.0 ? static_cast<int>(field->limits.offset) : 0);
  }
}

}  // namespace

std::size_t VoxelBuffers::largest() const {
  std::size_t most = 0;
  for (const VoxelWords* const buffer :
       {drawn_by != nullptr ? &drawn_by->values : nullptr, colored_by != nullptr ? &colored_by->values : nullptr,
        colors != nullptr ? &colors->values : nullptr, list != nullptr ? &list->values : nullptr}) {
    if (buffer != nullptr && buffer->words.valid()) {
      most = std::max(most, static_cast<std::size_t>(buffer->words->size()));
    }
  }
  return most;
}

VoxelState::VoxelState()
    : state_(new osg::StateSet),
      coloring_(*state_),
      is_listed_(new osg::Uniform("u_is_listed", false)),
      voxels_(new osg::Uniform("u_voxels", 0, 0, 0)),
      cell_size_(new osg::Uniform("u_cell_size", osg::Vec3())),
      drawn_form_(new osg::Uniform("u_drawn_form", kNoField, 0, 0)),
      colored_form_(new osg::Uniform("u_colored_form", kNoField, 0, 0)),
      test_(new osg::Uniform("u_test", 0, 0, 0, 0)),
      axis_(new osg::Uniform("u_axis", osg::Vec4())),
      shading_(new osg::Uniform("u_shading", true)),
      opacity_(new osg::Uniform("u_opacity", 1.0F)) {
  namespace shaders = shaders::stillframe_nodes;
  state_->setAttributeAndModes(
      scenegraph::makeProgram("voxel_grid", shaders::k_voxel_grid_vert, shaders::k_voxel_grid_frag));
  for (unsigned unit = 0; unit < kSamplers.size(); ++unit) {
    state_->getOrCreateUniform(kSamplers[unit], osg::Uniform::UNSIGNED_INT_SAMPLER_BUFFER)->set(static_cast<int>(unit));
  }
  for (const auto& uniform :
       {is_listed_, voxels_, cell_size_, drawn_form_, colored_form_, test_, axis_, shading_, opacity_}) {
    state_->addUniform(uniform);
  }
  apply({}, false);
}

void VoxelState::setBuffers(const VoxelBlock& block, const VoxelBuffers& buffers) {
  // Every sampler has a buffer, whether or not it is read: some drivers warn of those without.
  osg::TextureBuffer* const any = buffers.drawn_by != nullptr     ? buffers.drawn_by->values.texture.get()
                                  : buffers.colored_by != nullptr ? buffers.colored_by->values.texture.get()
                                                                  : block.colors()->values.texture.get();
  const auto bind = [&](unsigned unit, osg::TextureBuffer* texture) {
    state_->setTextureAttribute(unit, texture != nullptr ? texture : any);
  };
  bind(0, buffers.drawn_by != nullptr ? buffers.drawn_by->values.texture.get() : nullptr);
  bind(1, buffers.colored_by != nullptr ? buffers.colored_by->values.texture.get() : nullptr);
  bind(2, buffers.colors != nullptr ? buffers.colors->values.texture.get() : nullptr);
  bind(3, buffers.list->values.texture.get());
  is_listed_->set(buffers.list->values.texture.valid());
  const glm::uvec3 count = block.count();
  voxels_->set(static_cast<int>(count.x), static_cast<int>(count.y), static_cast<int>(count.z));
  const glm::dvec3& size_m = block.source().cell_size_m;
  cell_size_->set(osg::Vec3(osg::Vec3d(size_m.x, size_m.y, size_m.z)));
  setForm(*drawn_form_, buffers.drawn_by);
  setForm(*colored_form_, buffers.colored_by);
}

void VoxelState::clearBuffers() {
  for (unsigned unit = 0; unit < kSamplers.size(); ++unit) {
    state_->removeTextureAttribute(unit, osg::StateAttribute::TEXTURE);
  }
  // The state must not tell what was here before.
  is_listed_->set(false);
  voxels_->set(0, 0, 0);
  cell_size_->set(osg::Vec3());
  setForm(*drawn_form_, nullptr);
  setForm(*colored_form_, nullptr);
}

void VoxelState::apply(const VoxelGridSettings& settings, bool is_translucent) {
  coloring_.setColormap(settings.colormap);
  coloring_.setFlatColor(settings.flat_color);
  coloring_.setMissingColor(settings.missing_color);
  shading_->set(settings.shading);
  opacity_->set(static_cast<float>(settings.opacity));
  scenegraph::setBlended(*state_, settings.opacity < 1.0 || is_translucent);
}

void VoxelState::setTest(const VoxelTest& test) {
  test_->set(static_cast<int>(test.mode), static_cast<int>(test.first), static_cast<int>(test.last),
             static_cast<int>(test.bits));
}

void VoxelState::setColor(VoxelColorMode mode, const RangeMap& map) { coloring_.setMode(static_cast<int>(mode), map); }

void VoxelState::setAxisMap(const glm::dvec4& coefficients) {
  axis_->set(osg::Vec4(osg::Vec4d(coefficients.x, coefficients.y, coefficients.z, coefficients.w)));
}

}  // namespace stillframe::nodes
