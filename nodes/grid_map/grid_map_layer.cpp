#include "nodes/grid_map/grid_map_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/flat_order.h"
#include "nodes/osg_math.h"
#include "nodes/points/read_value.h"
#include "nodes/points/record_fields.h"
#include "nodes/points/value_histogram.h"

namespace stillframe::nodes {

using scenegraph::Status;
using scenegraph::StatusLevel;

std::unique_ptr<scenegraph::Layer> GridMapLayer::create(std::string_view topic) {
  return std::make_unique<GridMapLayer>(topic);
}

GridMapLayer::GridMapLayer(std::string_view topic)
    : SampleLayer(
          topic,
          {.type = scenegraph::ObjectType::GridMap,
           .tag = "grid map",
           .convert = [](const scenegraph::AnyObject& object,
                         const GridMapSettings&) { return GridSurface::make(object.get<scenegraph::GridMap>()); },
           .is_reference = [](const GridSurface& map) { return map.cells().all.points > 0; },
           .prepare = &GridMapLayer::prepare},
          gridMapSettingsTable()) {}

void GridMapLayer::prepare(const GridSurface& map, const GridMapSettings& settings) {
  const Choice choice = choose(settings, map);
  if (!choice.height.empty()) {
    (void)map.mesh(choice.height);
  }
  if (choice.mode == MapColorMode::Rgb) {
    (void)map.colors();
  } else if (choice.mode == MapColorMode::Value) {
    (void)map.layer(choice.color);
  }
}

void GridMapLayer::open(const scenegraph::LayerContext& context) {
  SampleLayer::open(context);
  geometry_ = addGeometry(state_.stateSet());
}

void GridMapLayer::close() {
  SampleLayer::close();
  geometry_ = nullptr;
}

std::optional<TopicLayer::Anchor> GridMapLayer::load(const scenegraph::Tick& tick) {
  flat_step_ = flatDepthStep(FlatKind::GridMap, tick.order, tick.of_type);
  return SampleLayer::load(tick);
}

TopicLayer::Anchor GridMapLayer::anchorOf(const GridSurface& map) const {
  return {map.source().frame_id, map.source().origin};
}

void GridMapLayer::draw(const Placement& /*fixed_from_data*/) {
  if (const Choice choice = choose(chosen(), *product()); choice != choice_) {
    build(choice);
  }
  state_.setDepthStep(choice_->height.empty() ? flat_step_ : 0.0F);
  paint();
}

GridMapLayer::Choice GridMapLayer::choose(const GridMapSettings& settings, const GridSurface& map) {
  Choice choice;
  if (!settings.flat) {
    const std::string& name = settings.height_field == "auto" ? "elevation" : settings.height_field;
    if (map.hasLayer(name)) {
      choice.height = name;
    } else if (settings.height_field != "auto") {
      choice.missing = name;
    }
  }
  std::string color = settings.color_field;
  if (color == "auto") {
    const auto& layers = map.cells().layers;
    const std::string first = layers.empty() ? "flat" : map.hasLayer("elevation") ? "elevation" : layers.front().name;
    color = map.cells().colors ? "rgb" : !choice.height.empty() ? choice.height : first;
  }
  if (color == "rgb" && map.cells().colors) {
    choice.mode = MapColorMode::Rgb;
  } else if (map.hasLayer(color)) {
    choice.mode = MapColorMode::Value;
    choice.color = color;
  } else if (color != "flat") {
    choice.missing = color;
  }
  return choice;
}

void GridMapLayer::show() {
  choice_.reset();
  range_.reset();
  reapply();
  box_.init();
  triangles_ = 0;
  geometry_->removePrimitiveSet(0, geometry_->getNumPrimitiveSets());
  geometry_->setVertexAttribArray(GridMapState::kNormalAttribute, nullptr);
  geometry_->setVertexArray(nullptr);
  state_.setColor(MapColorMode::Flat, nullptr, {});
  geometry_->dirtyBound();
}

void GridMapLayer::build(const Choice& choice) {
  product()->releaseGlObjects();
  show();
  choice_ = choice;
  const scenegraph::GridMap& map = product()->source();
  state_.setCells(map.cell_size_m, map.column_count, map.row_count);
  node().setMatrix(toOsg(map.origin));
  if (product()->cells().all.points == 0) {
    return;
  }
  const double width = map.cell_size_m.x * map.column_count;
  const double height = map.cell_size_m.y * map.row_count;
  if (const MapMesh* const mesh = choice.height.empty() ? nullptr : product()->mesh(choice.height)) {
    if (mesh->triangles->empty()) {
      return;
    }
    geometry_->setVertexArray(mesh->positions);
    geometry_->setVertexAttribArray(GridMapState::kNormalAttribute, mesh->normals);
    geometry_->addPrimitiveSet(mesh->triangles);
    node().setMatrix(osg::Matrixd::translate(0, 0, mesh->z_origin) * toOsg(map.origin));
    triangles_ = mesh->triangles->size() / 3;
    box_.set(map.cell_size_m.x / 2, map.cell_size_m.y / 2, mesh->low, width - map.cell_size_m.x / 2,
             height - map.cell_size_m.y / 2, mesh->high);
  } else {
    const auto w = static_cast<float>(width);
    const auto h = static_cast<float>(height);
    osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    corners->asVector() = {{0, 0, 0}, {w, 0, 0}, {0, h, 0}, {w, h, 0}};
    osg::ref_ptr<osg::Vec4bArray> normals = new osg::Vec4bArray(osg::Array::BIND_PER_VERTEX);
    normals->setNormalize(true);
    normals->assign(4, osg::Vec4b(0, 0, 127, 0));
    geometry_->setVertexArray(corners);
    geometry_->setVertexAttribArray(GridMapState::kNormalAttribute, normals);
    geometry_->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, 4));
    triangles_ = 2;
    box_.set(0, 0, 0, width, height, 0);
  }
  geometry_->dirtyBound();
}

void GridMapLayer::paint() {
  RangeMap map;
  range_.reset();
  osg::Texture2D* texture = nullptr;
  if (choice_->mode == MapColorMode::Rgb) {
    texture = product()->colors();
  } else if (const MapLayer* const layer =
                 choice_->mode == MapColorMode::Value ? product()->layer(choice_->color) : nullptr) {
    texture = layer->texture;
    const MapLayer* const of_reference = chosen().range_mode == "manual" ? nullptr : reference()->layer(choice_->color);
    const bool is_held = of_reference != nullptr && of_reference->limits.finite > 0;
    const ChannelValues& limits = is_held ? of_reference->limits : layer->limits;
    range_ = chosen().range([&] { return ValueRange{limits.low, limits.high}; },
                            [&](double low, double high) {
                              return (is_held ? *reference() : *product()).percentiles(choice_->color, low, high);
                            });
    map = chosen().map(*range_, layer->limits.offset);
  }
  if (takeSettings()) {
    state_.apply(chosen(), !choice_->height.empty(), choice_->mode == MapColorMode::Rgb && product()->cells().alpha);
  }
  state_.setColor(choice_->mode, texture, map);
}

std::optional<scenegraph::Picked> GridMapLayer::describeData(const scenegraph::PickHit& hit) const {
  if (product() == nullptr) {
    return std::nullopt;
  }
  const scenegraph::GridMap& map = product()->source();
  const glm::dvec3 in_map = tf::transformPoint(tf::inverse(map.origin), scenegraph::surfacePoint(hit));
  const double column = std::floor(in_map.x / map.cell_size_m.x);
  const double row = std::floor(in_map.y / map.cell_size_m.y);
  if (!(column >= 0.0 && column < map.column_count && row >= 0.0 && row < map.row_count)) {
    return std::nullopt;
  }
  const auto x = static_cast<std::size_t>(column);
  const auto y = static_cast<std::size_t>(row);
  scenegraph::Picked picked{.kind = "cell",
                            .id = std::to_string(x) + "," + std::to_string(y),
                            .point_in_frame = {},
                            .stamp = map.stamp,
                            .fields = {},
                            .radius_m = std::max(1.0, 4.0 * std::max(map.cell_size_m.x, map.cell_size_m.y))};
  picked.add("column", x);
  picked.add("row", y);
  addRecordFields(picked, product()->cells().records.fields,
                  recordAt(map.data.bytes, y * map.row_stride + x * map.cell_stride, map.cell_stride), false);
  // The middle of the cell at its own height; between cells with a height the surface is drawn over one without.
  double height = in_map.z;
  for (const ChannelInfo& layer : product()->cells().layers) {
    if (choice_ && layer.name == choice_->height) {
      const auto value = recordAt(map.data.bytes, y * map.row_stride + x * map.cell_stride + layer.offset,
                                  scenegraph::byteSize(layer.type));
      const double own =
          value.size() == scenegraph::byteSize(layer.type) ? valueReader(layer.type, false)(value.data()) : in_map.z;
      height = std::isfinite(own) ? own : in_map.z;
    }
  }
  picked.point_in_frame =
      tf::transformPoint(map.origin, {(column + 0.5) * map.cell_size_m.x, (row + 0.5) * map.cell_size_m.y, height});
  return picked;
}

Status GridMapLayer::remark() const {
  if (!choice_->missing.empty()) {
    return {StatusLevel::Info, "UnknownField",
            loadedText() + "no layer '" + choice_->missing + "'; there are " +
                fieldNames(product()->cells().colors.has_value(), product()->cells().layers)};
  }
  if (product()->cells().all.points == 0) {
    return {StatusLevel::Info, "EmptyGrid", loadedText() + "the map has no cells"};
  }
  if (triangles_ == 0) {
    return {StatusLevel::Info, "NothingDrawn",
            loadedText() + "no four neighbours of its " + std::to_string(product()->cells().all.points) +
                " cells have a height in '" + choice_->height + "'"};
  }
  const MapLayer* const color = choice_->mode == MapColorMode::Value ? product()->layer(choice_->color) : nullptr;
  if (choice_->height.empty() && color != nullptr && color->limits.finite == 0) {
    return {StatusLevel::Info, "NothingDrawn",
            loadedText() + "none of its " + std::to_string(product()->cells().all.points) + " cells has a value of '" +
                choice_->color + "'"};
  }
  return {};
}

std::optional<scenegraph::ColorLegend> GridMapLayer::legend() const {
  if (!range_ || triangles_ == 0) {
    return std::nullopt;
  }
  // A layer that gives the height is in metres; of the others the message does not say.
  return chosen().legend(choice_->color, choice_->color == choice_->height ? "m" : "", *range_);
}

std::function<scenegraph::ValueHistogram()> GridMapLayer::histogramWork() const {
  if (!legend()) {
    return nullptr;
  }
  return [map = product(), name = choice_->color] {
    const MapLayer& layer = *map->layer(name);
    const osg::Image& texels = *layer.texture->getImage();
    return histogramOf({reinterpret_cast<const float*>(texels.data()), texels.getTotalSizeInBytes() / sizeof(float)},
                       layer.limits.offset);
  };
}

scenegraph::LayerCounts GridMapLayer::counts() const {
  if (product() == nullptr) {
    return {{"cells", 0}, {"triangles", 0}, {"bytes", 0}};
  }
  return {{"cells", product()->cells().all.points},
          {"triangles", triangles_},
          {"bytes", product()->source().data.bytes.size()}};
}

std::vector<scenegraph::SettingSpec> GridMapLayer::settingSpecs() const {
  auto specs = SampleLayer::settingSpecs();
  if (reference() != nullptr) {
    for (auto& spec : specs) {
      if (spec.key == "height_field" || spec.key == "color_field") {
        offerFields(spec, spec.key == "color_field" && reference()->cells().colors, reference()->cells().layers);
      }
    }
  }
  return specs;
}

}  // namespace stillframe::nodes
