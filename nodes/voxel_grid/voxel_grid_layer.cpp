#include "nodes/voxel_grid/voxel_grid_layer.h"

#include <algorithm>

#include "nodes/buffer_limit.h"
#include "nodes/osg_math.h"
#include "nodes/points/record_fields.h"
#include "nodes/points/value_histogram.h"

namespace stillframe::nodes {

using scenegraph::Status;
using scenegraph::StatusLevel;

std::unique_ptr<scenegraph::Layer> VoxelGridLayer::create(std::string_view topic) {
  return std::make_unique<VoxelGridLayer>(topic);
}

VoxelGridLayer::VoxelGridLayer(std::string_view topic)
    : SampleLayer(
          topic,
          {.type = scenegraph::ObjectType::VoxelGrid,
           .tag = "voxels",
           .convert = [](const scenegraph::AnyObject& object,
                         const VoxelGridSettings&) { return VoxelBlock::make(object.get<scenegraph::VoxelGrid>()); },
           .is_reference = [](const VoxelBlock& block) { return block.voxels() > 0; },
           .prepare = &VoxelGridLayer::prepare},
          voxelGridSettingsTable()) {}

void VoxelGridLayer::prepare(const VoxelBlock& block, const VoxelGridSettings& settings) {
  const Choice choice = choose(settings, block);
  const bool is_rgb = choice.mode == VoxelColorMode::Rgb;
  (void)block.list(choice.drawn_by, is_rgb);
  (void)block.field(choice.color);
  (void)block.drawn(choice.drawn_by, testOf(settings, block.field(choice.drawn_by)), is_rgb);
}

void VoxelGridLayer::open(const scenegraph::LayerContext& context) {
  SampleLayer::open(context);
  geometry_ = addGeometry(state_.stateSet());
}

void VoxelGridLayer::close() {
  SampleLayer::close();
  geometry_ = nullptr;
}

TopicLayer::Anchor VoxelGridLayer::anchorOf(const VoxelBlock& block) const {
  return {block.source().frame_id, block.source().origin};
}

VoxelGridLayer::Choice VoxelGridLayer::choose(const VoxelGridSettings& settings, const VoxelBlock& block) {
  Choice choice;
  const auto& fields = block.cells().layers;
  if (settings.draw_field != "auto") {
    (block.hasField(settings.draw_field) ? choice.drawn_by : choice.missing) = settings.draw_field;
  }
  if (choice.drawn_by.empty() && !fields.empty()) {
    choice.drawn_by = fields.front().name;
  }
  std::string color = settings.color_field;
  if (color == "auto") {
    color = block.cells().colors ? "rgb" : choice.drawn_by;
  }
  if (color == "x" || color == "y" || color == "z") {
    choice.mode = VoxelColorMode::Axis;
    choice.axis = color[0] - 'x';
  } else if (color == "rgb" && block.cells().colors) {
    choice.mode = VoxelColorMode::Rgb;
  } else if (block.hasField(color)) {
    choice.mode = VoxelColorMode::Value;
    choice.color = color;
  } else if (color != "flat" && block.voxels() > 0) {
    choice.missing = color;
  }
  return choice;
}

VoxelTest VoxelGridLayer::testOf(const VoxelGridSettings& settings, const VoxelField* field) {
  using Mode = VoxelRule::Mode;
  const std::string& name = settings.draw_if;
  const Mode mode = name == "range"    ? Mode::Range
                    : name == "equals" ? Mode::Equals
                    : name == "bits"   ? Mode::Bits
                    : name == "all"    ? Mode::All
                                       : Mode::Above;
  return field == nullptr ? VoxelTest{}
                          : makeVoxelTest({.mode = mode,
                                           .from = settings.draw_from,
                                           .to = settings.draw_to,
                                           .bits = static_cast<std::uint32_t>(settings.draw_bits)},
                                          field->info.type, field->limits);
}

void VoxelGridLayer::show() {
  choice_.reset();
  range_.reset();
  reapply();
  listed_ = 0;
  needed_texels_ = 0;
  geometry_->removePrimitiveSet(0, geometry_->getNumPrimitiveSets());
  geometry_->setVertexArray(nullptr);
  rays_ = nullptr;
  geometry_->setUserData(nullptr);
  geometry_->dirtyBound();
  state_.clearBuffers();
}

std::optional<TopicLayer::Anchor> VoxelGridLayer::load(const scenegraph::Tick& tick) {
  if (buffer_texels_ != tick.buffer_texels) {
    buffer_texels_ = tick.buffer_texels;
    choice_.reset();
  }
  return SampleLayer::load(tick);
}

void VoxelGridLayer::build(const Choice& choice) {
  product()->releaseGlObjects();
  show();
  choice_ = choice;
  const VoxelBlock& block = *product();
  node().setMatrix(toOsg(block.source().origin));
  if (block.voxels() == 0) {
    return;
  }
  const bool is_rgb = choice.mode == VoxelColorMode::Rgb;
  const VoxelList& list = block.list(choice.drawn_by, is_rgb);
  const VoxelBuffers buffers{.drawn_by = block.field(choice.drawn_by),
                             .colored_by = block.field(choice.color),
                             .colors = is_rgb ? block.colors() : nullptr,
                             .list = &list};
  needed_texels_ = buffers.largest();
  listed_ = needed_texels_ <= buffer_texels_ ? list.voxels : 0;
  if (listed_ == 0) {
    return;
  }
  state_.setBuffers(block, buffers);
  // The vertices only hold the bound: the shader goes by their number.
  const osg::BoundingBox bound(box());
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
  osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
  for (unsigned side = 0; side < 3; ++side) {
    for (unsigned corner = 0; corner < 4; ++corner) {
      vertices->push_back(bound.corner((4 * side + corner) % 8));
    }
    for (const unsigned corner : {0U, 1U, 2U, 2U, 1U, 3U}) {
      triangles->push_back(static_cast<GLushort>(4 * side + corner));
    }
  }
  triangles->setNumInstances(static_cast<int>(listed_));
  geometry_->setVertexArray(vertices);
  geometry_->addPrimitiveSet(triangles);
  rays_ = new VoxelRays(product(), choice.drawn_by, is_rgb);
  geometry_->setUserData(rays_);
  geometry_->dirtyBound();
}

osg::BoundingBoxd VoxelGridLayer::box() const {
  const glm::dvec3 size = product()->source().cell_size_m * glm::dvec3(product()->count());
  return listed_ > 0 ? osg::BoundingBoxd(osg::Vec3d(), toOsg(size)) : osg::BoundingBoxd();
}

ValueRange VoxelGridLayer::fieldRange(const VoxelField& field) const {
  const VoxelField* const held = chosen().range_mode == "manual" ? nullptr : reference()->field(field.info.name);
  const bool is_held = held != nullptr && held->limits.finite > 0;
  const ChannelValues& limits = is_held ? held->limits : field.limits;
  return chosen().range([&] { return ValueRange{limits.low, limits.high}; },
                        [&](double low, double high) {
                          return (is_held ? *reference() : *product()).percentiles(field.info.name, low, high);
                        });
}

ValueRange VoxelGridLayer::axisRange(const tf::RigidTransform& fixed_from_grid) const {
  const glm::dvec3 size = product()->source().cell_size_m * glm::dvec3(product()->count());
  const ValueRange all = extentAlong(choice_->axis, fixed_from_grid, glm::dvec3(0.0), size);
  const auto at = [&](double percent) { return all.low + (all.high - all.low) * percent / 100.0; };
  return chosen().range([&] { return all; }, [&](double low, double high) { return ValueRange{at(low), at(high)}; });
}

void VoxelGridLayer::draw(const Placement& fixed_from_grid) {
  if (const Choice choice = choose(chosen(), *product()); choice != choice_) {
    build(choice);
  }
  const VoxelBlock& block = *product();
  const bool is_rgb = choice_->mode == VoxelColorMode::Rgb;
  if (takeSettings()) {
    const VoxelColors* const colors = is_rgb ? block.colors() : nullptr;
    state_.apply(chosen(), colors != nullptr && colors->is_translucent);
    test_ = testOf(chosen(), block.field(choice_->drawn_by));
    state_.setTest(test_);
    if (rays_.valid()) {
      rays_->setTest(test_);
      rays_->setSeen(chosen().opacity > 0.0);
    }
  }
  RangeMap value_map;
  glm::dvec4 axis_map{0.0};
  range_.reset();
  if (const VoxelField* const field = block.field(choice_->color)) {
    range_ = fieldRange(*field);
    value_map = chosen().map(*range_, field->limits.offset);
  } else if (choice_->mode == VoxelColorMode::Axis && fixed_from_grid) {
    range_ = axisRange(*fixed_from_grid);
    axis_map = axisMap(chosen(), *range_, choice_->axis, *fixed_from_grid);
  }
  state_.setColor(choice_->mode, value_map);
  state_.setAxisMap(axis_map);
}

std::optional<scenegraph::Picked> VoxelGridLayer::describeData(const scenegraph::PickHit& hit) const {
  if (product() == nullptr || !choice_ || hit.instance >= listed_) {
    return std::nullopt;
  }
  const VoxelBlock& block = *product();
  const osg::UIntArray* const listed =
      block.list(choice_->drawn_by, choice_->mode == VoxelColorMode::Rgb).values.words.get();
  const bool is_listed = listed != nullptr && !listed->empty();
  const std::size_t i = is_listed ? (*listed)[hit.instance] : hit.instance;
  const glm::uvec3 count = block.count();
  if (i >= block.voxels()) {
    return std::nullopt;
  }
  const scenegraph::VoxelGrid& grid = block.source();
  const std::size_t in_slice = std::size_t{count.x} * count.y;
  const std::size_t column = i % count.x;
  const std::size_t row = i / count.x % count.y;
  const std::size_t slice = i / in_slice;
  const glm::dvec3 cell(static_cast<double>(column), static_cast<double>(row), static_cast<double>(slice));
  scenegraph::Picked picked{.kind = "voxel",
                            .id = std::to_string(column) + "," + std::to_string(row) + "," + std::to_string(slice),
                            .point_in_frame = tf::transformPoint(grid.origin, (cell + 0.5) * grid.cell_size_m),
                            .stamp = grid.stamp,
                            .fields = {},
                            .radius_m = 4.0 * std::max({grid.cell_size_m.x, grid.cell_size_m.y, grid.cell_size_m.z})};
  picked.add("column", column);
  picked.add("row", row);
  picked.add("slice", slice);
  const std::size_t offset = slice * grid.slice_stride + row * grid.row_stride + column * grid.cell_stride;
  addRecordFields(picked, block.cells().records.fields, recordAt(grid.data.bytes, offset, grid.cell_stride), false);
  return picked;
}

std::optional<scenegraph::ColorLegend> VoxelGridLayer::legend() const {
  if (!range_ || listed_ == 0) {
    return std::nullopt;
  }
  return choice_->mode == VoxelColorMode::Axis
             ? chosen().legend(axisTitle(choice_->axis, context().frames.fixedFrame()), "m", *range_)
             : chosen().legend(choice_->color, "", *range_);
}

std::function<scenegraph::ValueHistogram()> VoxelGridLayer::histogramWork() const {
  if (!legend() || choice_->mode == VoxelColorMode::Axis) {
    return nullptr;
  }
  return [block = product(), name = choice_->color] {
    const VoxelField& field = *block->field(name);
    const std::span<const std::uint32_t> words = field.values.span();
    std::vector<float> values(block->voxels());
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = static_cast<float>(voxelValue(rawVoxel(words, field.format, i), field.format, field.limits) -
                                     field.limits.offset);
    }
    return histogramOf(values, field.limits.offset);
  };
}

Status VoxelGridLayer::remark() const {
  if (!choice_->missing.empty()) {
    return {StatusLevel::Info, "UnknownField",
            loadedText() + "no field '" + choice_->missing + "'; there are " +
                fieldNames(product()->cells().colors.has_value(), product()->cells().layers)};
  }
  if (product()->voxels() == 0) {
    return {StatusLevel::Info, "EmptyGrid", loadedText() + "the grid has no voxels"};
  }
  if (needed_texels_ > buffer_texels_) {
    return bufferTooLarge(loadedText() + "its " + std::to_string(product()->voxels()) + " voxels", needed_texels_,
                          buffer_texels_);
  }
  if (product()->drawn(choice_->drawn_by, test_, choice_->mode == VoxelColorMode::Rgb) == 0) {
    return {StatusLevel::Info, "NothingDrawn",
            loadedText() + "none of its " + std::to_string(product()->voxels()) +
                " voxels is drawn by the present settings of draw_field and draw_if"};
  }
  return {};
}

scenegraph::LayerCounts VoxelGridLayer::counts() const {
  if (product() == nullptr || !choice_) {
    return {{"voxels", 0}, {"drawn", 0}, {"listed", 0}, {"bytes", 0}};
  }
  return {{"voxels", product()->voxels()},
          {"drawn", listed_ > 0 ? product()->drawn(choice_->drawn_by, test_, choice_->mode == VoxelColorMode::Rgb) : 0},
          {"listed", listed_},
          {"bytes", product()->source().data.bytes.size()}};
}

std::vector<scenegraph::SettingSpec> VoxelGridLayer::settingSpecs() const {
  auto specs = SampleLayer::settingSpecs();
  if (reference() != nullptr) {
    for (auto& spec : specs) {
      if (spec.key == "draw_field" || spec.key == "color_field") {
        offerFields(spec, spec.key == "color_field" && reference()->cells().colors, reference()->cells().layers);
      }
    }
  }
  return specs;
}

}  // namespace stillframe::nodes
