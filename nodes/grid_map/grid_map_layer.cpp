#include "nodes/grid_map/grid_map_layer.h"

#include <mutex>
#include <utility>

#include "nodes/osg_math.h"
#include "scenegraph/geometry.h"
#include "scenegraph/placement.h"

namespace stillframe::nodes {

using scenegraph::Status;
using scenegraph::StatusLevel;

/// The settings in use, for the workers: they convert the layers that these name.
struct GridMapLayer::Foresight {
  std::mutex mutex;  // guards settings
  GridMapSettings settings;

  void set(const GridMapSettings& now) {
    const std::scoped_lock lock(mutex);
    settings = now;
  }
  void prepare(const GridSurface& map) {
    Choice choice;
    {
      const std::scoped_lock lock(mutex);
      choice = choose(settings, map);
    }
    if (!choice.height.empty()) {
      (void)map.mesh(choice.height);
    }
    if (choice.mode == MapColorMode::Rgb) {
      (void)map.colors();
    } else if (choice.mode == MapColorMode::Value) {
      (void)map.layer(choice.color);
    }
  }
};

std::unique_ptr<scenegraph::Layer> GridMapLayer::create(std::string_view topic) {
  return std::make_unique<GridMapLayer>(topic);
}

GridMapLayer::GridMapLayer(std::string_view topic) : topic_(topic), foresight_(std::make_shared<Foresight>()) {}

GridMapLayer::~GridMapLayer() = default;

void GridMapLayer::attach(const scenegraph::LayerContext& context) {
  context_.emplace(context);
  loader_.emplace(
      context, scenegraph::ObjectType::GridMap, topic_, "grid map",
      [foresight = foresight_](const scenegraph::AnyObject& object,
                               const scenegraph::Entry&) -> std::expected<GridSurface, Status> {
        auto surface = GridSurface::make(object.get<scenegraph::GridMap>());
        if (surface) {
          foresight->prepare(*surface);
        }
        return surface;
      },
      [](const GridSurface& map) { return map.cells().all.points > 0; });
  geometry_ = scenegraph::makeGeometry();
  geometry_->setName(topic_);
  node_ = new osg::MatrixTransform;
  node_->setName(topic_);
  node_->setStateSet(state_.stateSet());
  node_->addChild(geometry_);
}

void GridMapLayer::detach() {
  if (context_) {
    clear();
  }
  loader_.reset();
  reference_ = nullptr;
  geometry_ = nullptr;
  node_ = nullptr;
  context_.reset();
}

void GridMapLayer::setVisible(bool visible) {
  visible_ = visible;
  if (!visible && context_) {
    clear();
  }
}

void GridMapLayer::clear() {
  show(nullptr);
  hold(std::nullopt);
  status_ = {};
  bounds_.init();
}

void GridMapLayer::update(const scenegraph::Tick& tick) {
  if (!context_ || !visible_) {
    return;
  }
  foresight_->set(settings_);
  (void)loader_->update(tick.time);
  if (loader_->product() != product_) {
    show(loader_->product());
  }
  hold(product_ != nullptr ? std::optional(std::string(tf::stripLeadingSlashes(product_->source().frame_id)))
                           : std::nullopt);
  bounds_.init();
  if (product_ != nullptr) {
    const auto reference = loader_->reference();
    reference_ = reference != nullptr ? reference : product_;
    if (const Choice choice = choose(settings_, *product_); choice != choice_) {
      build(choice);
    }
    paint();
    const auto fixed_from_frame = context_->frames.fixedFromFrame(*held_frame_);
    if (fixed_from_frame && box_.valid()) {
      const tf::RigidTransform fixed_from_map = *fixed_from_frame * product_->source().origin;
      for (unsigned corner = 0; corner < 8; ++corner) {
        const osg::Vec3d at = box_.corner(corner);
        bounds_.expandBy(toOsg(tf::transformPoint(fixed_from_map, {at.x(), at.y(), at.z()})));
      }
    }
  }
  status_ = judge();
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

void GridMapLayer::show(std::shared_ptr<const GridSurface> product) {
  if (product_ != nullptr) {
    product_->releaseGlObjects();
  }
  product_ = std::move(product);
  choice_.reset();
  applied_.reset();
  box_.init();
  triangles_ = 0;
  geometry_->removePrimitiveSet(0, geometry_->getNumPrimitiveSets());
  geometry_->setVertexAttribArray(GridMapState::kNormalAttribute, nullptr);
  geometry_->setVertexArray(nullptr);
  state_.setColor(MapColorMode::Flat, nullptr, {});
  geometry_->dirtyBound();
}

void GridMapLayer::build(const Choice& choice) {
  show(product_);
  choice_ = choice;
  const scenegraph::GridMap& map = product_->source();
  state_.setCells(map.cell_size_m, map.column_count, map.row_count);
  node_->setMatrix(toOsg(map.origin));
  if (product_->cells().all.points == 0) {
    return;
  }
  const double width = map.cell_size_m.x * map.column_count;
  const double height = map.cell_size_m.y * map.row_count;
  if (const MapMesh* const mesh = choice.height.empty() ? nullptr : product_->mesh(choice.height)) {
    if (mesh->triangles->empty()) {
      return;
    }
    geometry_->setVertexArray(mesh->positions);
    geometry_->setVertexAttribArray(GridMapState::kNormalAttribute, mesh->normals);
    geometry_->addPrimitiveSet(mesh->triangles);
    node_->setMatrix(osg::Matrixd::translate(0, 0, mesh->z_origin) * toOsg(map.origin));
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
  osg::Texture2D* texture = nullptr;
  if (choice_->mode == MapColorMode::Rgb) {
    texture = product_->colors();
  } else if (const MapLayer* const layer =
                 choice_->mode == MapColorMode::Value ? product_->layer(choice_->color) : nullptr) {
    texture = layer->texture;
    const MapLayer* const of_reference = settings_.range_mode == "manual" ? nullptr : reference_->layer(choice_->color);
    const bool is_held = of_reference != nullptr && of_reference->limits.finite > 0;
    const ChannelValues& limits = is_held ? of_reference->limits : layer->limits;
    const ValueRange range =
        settings_.range([&] { return ValueRange{limits.low, limits.high}; },
                        [&](double low, double high) {
                          return (is_held ? *reference_ : *product_).percentiles(choice_->color, low, high);
                        });
    map = settings_.map(range, layer->limits.offset);
  }
  if (applied_ != settings_) {
    state_.apply(settings_, !choice_->height.empty(), choice_->mode == MapColorMode::Rgb && product_->cells().alpha);
    applied_ = settings_;
  }
  state_.setColor(choice_->mode, texture, map);
}

void GridMapLayer::hold(const std::optional<std::string>& frame) {
  if (held_frame_ == frame) {
    return;
  }
  if (held_frame_) {
    if (osg::MatrixTransform* const parent = context_->frames.node(*held_frame_)) {
      parent->removeChild(node_);
    }
    context_->frames.release(*held_frame_);
  }
  held_frame_ = frame;
  if (held_frame_) {
    context_->frames.acquire(*held_frame_).addChild(node_);
  }
}

Status GridMapLayer::judge() const {
  if (product_ == nullptr) {
    return loader_->status();
  }
  if (const auto placement = context_->frames.fixedFromFrame(*held_frame_); !placement) {
    return scenegraph::placementStatus(context_->frames, *held_frame_, placement.error());
  }
  if (loader_->status().level != StatusLevel::Ok) {
    return loader_->status();
  }
  if (!choice_->missing.empty()) {
    std::string known = product_->cells().colors ? "rgb" : "";
    for (const ChannelInfo& layer : product_->cells().layers) {
      known += (known.empty() ? "" : ", ") + layer.name;
    }
    return {StatusLevel::Info, "UnknownField",
            "'" + topic_ + "' at " + scenegraph::timeText(loader_->entry()->log_time) + ": no layer '" +
                choice_->missing + "'; there are " + (known.empty() ? "none" : known)};
  }
  return {};
}

scenegraph::LayerCounts GridMapLayer::counts() const {
  if (product_ == nullptr) {
    return {{"cells", 0}, {"triangles", 0}, {"bytes", 0}};
  }
  return {{"cells", product_->cells().all.points},
          {"triangles", triangles_},
          {"bytes", product_->source().data.bytes.size()}};
}

std::vector<scenegraph::SettingSpec> GridMapLayer::settingSpecs() const {
  auto specs = gridMapSettingsTable().specs();
  if (reference_ != nullptr) {
    for (auto& spec : specs) {
      if (spec.key != "height_field" && spec.key != "color_field") {
        continue;
      }
      if (spec.key == "color_field" && reference_->cells().colors) {
        spec.choices.insert(spec.choices.begin() + 1, "rgb");
      }
      for (const ChannelInfo& layer : reference_->cells().layers) {
        spec.choices.push_back(layer.name);
      }
    }
  }
  return specs;
}

scenegraph::SettingTexts GridMapLayer::settings() const { return gridMapSettingsTable().texts(settings_); }

std::expected<void, scenegraph::SettingError> GridMapLayer::applySettings(const scenegraph::SettingTexts& texts) {
  return gridMapSettingsTable().apply(texts, settings_);
}

}  // namespace stillframe::nodes
