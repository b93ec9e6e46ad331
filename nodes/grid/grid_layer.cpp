#include "nodes/grid/grid_layer.h"

#include <array>
#include <osg/Array>
#include <osg/PrimitiveSet>

#include "generated/stillframe_nodes/shaders.h"
#include "nodes/flat_order.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {
namespace {

using scenegraph::SettingKind;
using scenegraph::SettingsTable;

const SettingsTable<GridLayer::Settings>& table() {
  using S = GridLayer::Settings;
  static const SettingsTable<S> kTable{
      {{.key = "cell_size",
        .label = "Cell size (m)",
        .help = "Side of one cell.",
        .kind = SettingKind::Double,
        .minimum = 1e-3,
        .maximum = 1e6},
       &S::cell_size_m},
      {{.key = "cells",
        .label = "Cells",
        .help = "Cells along each side.",
        .kind = SettingKind::Int,
        .minimum = 1,
        .maximum = 1000},
       &S::cells},
      {{.key = "plane",
        .label = "Plane",
        .help = "Plane of the fixed frame that the grid lies on.",
        .kind = SettingKind::Text,
        .choices = {"xy", "xz", "yz"},
        .choices_only = true},
       &S::plane},
      {{.key = "color", .label = "Colour", .help = "Colour of the lines.", .kind = SettingKind::Color}, &S::color}};
  return kTable;
}

/// The axes of the fixed frame along the two sides.
std::array<unsigned, 2> sides(const std::string& plane) {
  return plane == "xz" ? std::array{0U, 2U} : plane == "yz" ? std::array{1U, 2U} : std::array{0U, 1U};
}

double halfSide(const GridLayer::Settings& settings) {
  return 0.5 * settings.cell_size_m * static_cast<double>(settings.cells);
}

osg::ref_ptr<osg::Vec3Array> gridVertices(const GridLayer::Settings& settings) {
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  const auto [a, b] = sides(settings.plane);
  const double half = halfSide(settings);
  for (std::int64_t i = 0; i <= settings.cells; ++i) {
    const double at = -half + settings.cell_size_m * static_cast<double>(i);
    for (const auto& [u, v] : {std::pair{at, -half}, {at, half}, {-half, at}, {half, at}}) {
      osg::Vec3d vertex;
      vertex[a] = u;
      vertex[b] = v;
      vertices->push_back(vertex);
    }
  }
  return vertices;
}

}  // namespace

std::unique_ptr<scenegraph::Layer> GridLayer::create(std::string_view) { return std::make_unique<GridLayer>(); }

GridLayer::GridLayer()
    : color_(new osg::Uniform("u_color", osg::Vec4())), normal_(new osg::Uniform("u_normal", osg::Vec3(0, 0, 1))) {}

void GridLayer::attach(const scenegraph::LayerContext& context) {
  context_.emplace(context);
  geometry_ = scenegraph::makeGeometry();
  geometry_->setName("grid");
  geometry_->setNodeMask(scenegraph::kReference);
  namespace shaders = shaders::stillframe_nodes;
  osg::StateSet& state = *geometry_->getOrCreateStateSet();
  state.setAttributeAndModes(
      scenegraph::makeProgram("reference_grid", shaders::k_reference_grid_vert, shaders::k_reference_grid_frag));
  state.addUniform(color_);
  state.addUniform(normal_);
  state.addUniform(new osg::Uniform("u_depth_step", flatDepthStep(FlatKind::ReferenceGrid, 0, 1)));
  applied_.reset();
}

void GridLayer::update(const scenegraph::Tick&) {
  if (!context_) {
    return;
  }
  if (!visible_) {
    unhang();
    return;
  }
  applyChanges();
  hang();
}

void GridLayer::applyChanges() {
  if (applied_ == settings_) {
    return;
  }
  if (!applied_ || Settings{settings_.cell_size_m, settings_.cells, settings_.plane, applied_->color} != *applied_) {
    const osg::ref_ptr<osg::Vec3Array> vertices = gridVertices(settings_);
    geometry_->setVertexArray(vertices);
    geometry_->removePrimitiveSet(0, geometry_->getNumPrimitiveSets());
    geometry_->addPrimitiveSet(new osg::DrawArrays(GL_LINES, 0, static_cast<GLsizei>(vertices->size())));
    geometry_->dirtyBound();
    const auto [a, b] = sides(settings_.plane);
    osg::Vec3 normal;
    normal[3 - a - b] = 1.0F;
    normal_->set(normal);
  }
  color_->set(osg::Vec4(settings_.color.r, settings_.color.g, settings_.color.b, 1.0F));
  applied_ = settings_;
}

void GridLayer::hang() {
  const std::string frame = context_->frames.fixedFrame();
  if (held_frame_ == frame) {
    return;
  }
  unhang();
  held_frame_ = frame;
  context_->frames.hang(heldNode(), *geometry_);
}

void GridLayer::unhang() {
  if (held_frame_) {
    context_->frames.unhang(heldNode(), *geometry_);
    held_frame_.reset();
  }
}

std::optional<std::string_view> GridLayer::heldNode() const {
  return held_frame_->empty() ? std::nullopt : std::optional<std::string_view>(*held_frame_);
}

void GridLayer::detach() {
  if (context_) {
    unhang();
  }
  geometry_ = nullptr;
  applied_.reset();
  context_.reset();
}

void GridLayer::changeVisible(bool visible) {
  visible_ = visible;
  if (!visible && context_) {
    unhang();
  }
}

void GridLayer::collectNodes(std::vector<osg::Node*>& nodes) const {
  if (held_frame_) {
    nodes.push_back(geometry_);
  }
}

scenegraph::LayerCounts GridLayer::counts() const {
  return {{"cells", static_cast<std::uint64_t>(settings_.cells * settings_.cells)}};
}

std::vector<scenegraph::SettingSpec> GridLayer::settingSpecs() const { return table().specs(); }

scenegraph::SettingTexts GridLayer::settings() const { return table().texts(settings_); }

std::expected<void, scenegraph::SettingError> GridLayer::changeSettings(const scenegraph::SettingTexts& texts) {
  return table().apply(texts, settings_);
}

}  // namespace stillframe::nodes
