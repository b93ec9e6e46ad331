#include "nodes/voxel_grid/voxel_block.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>

namespace stillframe::nodes {
namespace {

constexpr GLint kR32ui = 0x8236;  // OSG's headers name it only for some profiles

/// A list pays when it leaves out as much as it takes to read it.
std::size_t mostListed(std::size_t voxels) { return voxels / 2; }

}  // namespace

VoxelWords VoxelWords::make(std::size_t count) {
  VoxelWords made;
  made.words = new osg::UIntArray(static_cast<unsigned>(count));
  made.texture = new osg::TextureBuffer(made.words);
  made.texture->setInternalFormat(kR32ui);
  return made;
}

void VoxelWords::releaseGlObjects() const {
  if (words.valid()) {
    texture->releaseGLObjects();
    words->releaseGLObjects();
  }
}

/// What has been made on demand so far.
struct VoxelBlock::Lazy {
  std::mutex mutex;  // guards everything below
  std::map<std::string, VoxelField, std::less<>> fields;
  std::optional<VoxelColors> colors;
  std::map<std::pair<std::string, bool>, VoxelList> lists;
  std::map<std::tuple<std::string, double, double>, ValueRange> percentiles;
  struct Drawn {
    std::string field;
    VoxelTest test;
    bool with_colors = false;
    std::size_t count = 0;
  };
  std::optional<Drawn> drawn;
};

VoxelBlock::VoxelBlock() : lazy_(std::make_unique<Lazy>()) {}
VoxelBlock::VoxelBlock(VoxelBlock&&) noexcept = default;
VoxelBlock& VoxelBlock::operator=(VoxelBlock&&) noexcept = default;
VoxelBlock::~VoxelBlock() = default;

std::expected<VoxelBlock, scenegraph::Status> VoxelBlock::make(std::shared_ptr<const scenegraph::VoxelGrid> grid) {
  auto cells = readVoxelCells(*grid);
  if (!cells) {
    return std::unexpected(std::move(cells.error()));
  }
  VoxelBlock block;
  block.cells_ = std::move(*cells);
  block.grid_ = std::move(grid);
  return block;
}

bool VoxelBlock::hasField(std::string_view name) const {
  return std::ranges::find(cells_.layers, name, &ChannelInfo::name) != cells_.layers.end();
}

const VoxelField* VoxelBlock::field(std::string_view name) const {
  const std::scoped_lock lock(lazy_->mutex);
  return fieldLocked(name);
}

const VoxelField* VoxelBlock::fieldLocked(std::string_view name) const {
  const auto info = std::ranges::find(cells_.layers, name, &ChannelInfo::name);
  if (info == cells_.layers.end() || voxels() == 0) {
    return nullptr;
  }
  const auto [found, is_new] = lazy_->fields.try_emplace(info->name);
  VoxelField& field = found->second;
  if (is_new) {
    field.info = *info;
    field.format = voxelFormat(info->type);
    field.values = VoxelWords::make(field.format.words(voxels()));
    field.limits = convertVoxels(cells_, *info, field.values.span());
  }
  return &field;
}

const VoxelColors* VoxelBlock::colors() const {
  const std::scoped_lock lock(lazy_->mutex);
  return colorsLocked();
}

const VoxelColors* VoxelBlock::colorsLocked() const {
  if (!cells_.colors || voxels() == 0) {
    return nullptr;
  }
  if (!lazy_->colors) {
    VoxelColors& made = lazy_->colors.emplace();
    made.values = VoxelWords::make(voxels());
    const auto words = made.values.span();
    convertCellColors(cells_, {reinterpret_cast<std::uint8_t*>(words.data()), words.size_bytes()});
    made.is_translucent = cells_.alpha && std::ranges::any_of(words, [](std::uint32_t word) {
                            return word >> 24U != 0 && word >> 24U != 255;
                          });
  }
  return &*lazy_->colors;
}

const VoxelList& VoxelBlock::list(std::string_view field, bool with_colors) const {
  const std::scoped_lock lock(lazy_->mutex);
  const auto [found, is_new] = lazy_->lists.try_emplace({std::string(field), with_colors});
  VoxelList& list = found->second;
  if (is_new) {
    list.voxels = voxels();
    const VoxelField* const values = fieldLocked(field);
    const VoxelColors* const rgba = with_colors ? colorsLocked() : nullptr;
    using Words = std::span<const std::uint32_t>;
    if (const auto exposed =
            exposedVoxels(count(), values != nullptr ? Words(values->values.span()) : Words(),
                          values != nullptr ? values->format : VoxelFormat{},
                          rgba != nullptr ? Words(rgba->values.span()) : Words(), mostListed(voxels()))) {
      list.voxels = exposed->size();
      list.values = VoxelWords::make(exposed->size());
      std::ranges::copy(*exposed, list.values.words->begin());
    }
  }
  return list;
}

std::size_t VoxelBlock::drawn(std::string_view field, const VoxelTest& test, bool with_colors) const {
  const std::scoped_lock lock(lazy_->mutex);
  const auto isSame = [&](const Lazy::Drawn& known) {
    return known.field == field && known.test == test && known.with_colors == with_colors;
  };
  if (!lazy_->drawn || !isSame(*lazy_->drawn)) {
    const VoxelField* const values = fieldLocked(field);
    const VoxelColors* const rgba = with_colors ? colorsLocked() : nullptr;
    std::size_t count = voxels();
    if (rgba != nullptr && cells_.alpha) {
      const auto words = rgba->values.span();
      count = 0;
      for (std::size_t i = 0; i < words.size(); ++i) {
        const bool passes = values == nullptr || isDrawn(rawVoxel(values->values.span(), values->format, i),
                                                         values->format, values->limits, test);
        count += passes && words[i] >> 24U != 0 ? 1U : 0U;
      }
    } else if (values != nullptr) {
      count = countDrawn(values->values.span(), values->format, voxels(), values->limits, test);
    }
    lazy_->drawn = {std::string(field), test, with_colors, count};
  }
  return lazy_->drawn->count;
}

ValueRange VoxelBlock::percentiles(std::string_view field, double low, double high) const {
  const std::scoped_lock lock(lazy_->mutex);
  const VoxelField* const values = fieldLocked(field);
  if (values == nullptr) {
    return {0.0, 0.0};
  }
  const auto [found, is_new] = lazy_->percentiles.try_emplace({std::string(field), low, high});
  if (is_new) {
    std::vector<float> numbers(voxels());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const double value =
          voxelValue(rawVoxel(values->values.span(), values->format, i), values->format, values->limits);
      numbers[i] = std::isnan(value) ? kMissingValue : static_cast<float>(value - values->limits.offset);
    }
    found->second = percentileRange(numbers, values->limits.offset, low, high);
  }
  return found->second;
}

void VoxelBlock::releaseGlObjects() const {
  const std::scoped_lock lock(lazy_->mutex);
  for (const auto& [name, field] : lazy_->fields) {
    field.values.releaseGlObjects();
  }
  for (const auto& [key, list] : lazy_->lists) {
    list.values.releaseGlObjects();
  }
  if (lazy_->colors) {
    lazy_->colors->values.releaseGlObjects();
  }
}

std::size_t VoxelBlock::byteSize() const noexcept {
  const std::scoped_lock lock(lazy_->mutex);
  std::size_t words = 0;
  for (const auto& [name, field] : lazy_->fields) {
    words += field.values.words->size();
  }
  for (const auto& [key, list] : lazy_->lists) {
    words += list.values.words.valid() ? list.values.words->size() : 0;
  }
  words += lazy_->colors ? lazy_->colors->values.words->size() : 0;
  return sizeof(*this) + grid_->byteSize() + words * sizeof(std::uint32_t);
}

}  // namespace stillframe::nodes
