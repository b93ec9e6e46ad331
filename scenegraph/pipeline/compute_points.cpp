#include "scenegraph/pipeline/compute_points.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <osg/BufferObject>
#include <osg/Notify>

#include "generated/stillframe_render/shaders.h"
#include "scenegraph/pipeline/texture_uploads.h"
#include "scenegraph/raster/points_in_view.h"

namespace stillframe::scenegraph {
namespace {

namespace glsl = shaders::stillframe_render;

// Where the shaders look for their buffers.
constexpr GLuint kPositions = 0;
constexpr GLuint kDepthsOrValues = 1;
constexpr GLuint kGroupsOrColors = 2;
constexpr GLuint kNearest = 3;
constexpr GLuint kNumbers = 4;
constexpr GLuint kTable = 5;
constexpr GLuint kBytes = 6;
// Buffers of our own.
constexpr std::size_t kGroupsBuffer = 0;
constexpr std::size_t kNearestBuffer = 1;
constexpr std::size_t kNumbersBuffer = 2;
constexpr std::size_t kTableBuffer = 3;
constexpr std::size_t kBytesBuffer = 4;
constexpr std::size_t kOwnBuffers = 5;

constexpr GLuint kMostWorkGroups = 32768;  // on an axis; every driver has 65535
constexpr std::size_t kMostBytesAPoint = 12;
constexpr GLuint kPixelsAWorkGroup = 64;

GLuint makeProgramOf(const char* name, const char* source) {
  const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  const GLuint program = glCreateProgram();
  glAttachShader(program, shader);
  glLinkProgram(program);
  glDeleteShader(shader);
  GLint is_linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &is_linked);
  if (is_linked != GL_TRUE) {
    std::array<char, 1024> log{};
    glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
    OSG_WARN << name << ": " << log.data() << "\n";
  }
  return program;
}

/// Uniforms of a program, by name.
class UniformSetter {
 public:
  explicit UniformSetter(GLuint program) : program_(program) { glUseProgram(program); }

  void set(const char* name, bool value) const { glUniform1i(at(name), value ? 1 : 0); }
  void set(const char* name, int value) const { glUniform1i(at(name), value); }
  void set(const char* name, std::uint32_t value) const { glUniform1ui(at(name), value); }
  void set(const char* name, float value) const { glUniform1f(at(name), value); }
  void set(const char* name, std::uint32_t x, std::uint32_t y) const { glUniform2ui(at(name), x, y); }
  void set(const char* name, int x, int y) const { glUniform2i(at(name), x, y); }
  void set(const char* name, const glm::vec2& value) const { glUniform2f(at(name), value.x, value.y); }
  void set(const char* name, const glm::vec3& value) const { glUniform3f(at(name), value.x, value.y, value.z); }
  void set(const char* name, const glm::vec4& value) const { glUniform4fv(at(name), 1, glm::value_ptr(value)); }
  void set(const char* name, const glm::mat4& value) const {
    glUniformMatrix4fv(at(name), 1, GL_FALSE, glm::value_ptr(value));
  }

 private:
  [[nodiscard]] GLint at(const char* name) const { return glGetUniformLocation(program_, name); }
  GLuint program_;
};

void dispatch(std::uint32_t work_groups) {
  if (work_groups > 0) {
    const GLuint columns = std::min(work_groups, kMostWorkGroups);
    glDispatchCompute(columns, (work_groups + columns - 1) / columns, 1);
  }
}

osg::GLBufferObject* bufferOf(const osg::Array* array, unsigned context_id) {
  return array == nullptr ? nullptr : const_cast<osg::Array*>(array)->getOrCreateGLBufferObject(context_id);
}

}  // namespace

ComputePoints::ComputePoints(osg::State& state)
    : state_(state),
      draw_program_(makeProgramOf("points_draw", glsl::k_points_draw_comp)),
      resolve_program_(makeProgramOf("points_resolve", glsl::k_points_resolve_comp)),
      buffers_(kOwnBuffers),
      color_(makePointTexture(GL_RGBA16F_ARB)),
      depth_(makePointTexture(GL_R32F)) {
  state_.initializeExtensionProcs();  // OSG's first picture would do it, and this may come before
  glCreateBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
  const std::array<float, 256>& bytes = PointShading::linearOfBytes();
  glNamedBufferData(buffers_[kBytesBuffer], sizeof bytes, bytes.data(), GL_STATIC_DRAW);
  GLint most_bytes = 0;
  glGetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most_bytes);
  // Whole groups, so that the parts of every array begin where a driver may want them to: at multiples of 256 bytes.
  largest_slice_ =
      static_cast<std::size_t>(std::max(most_bytes, 1 << 24)) / (kMostBytesAPoint * kPassesOfSample) * kPassesOfSample;
  color_->setSourceFormat(GL_RGBA);
  color_->setSourceType(GL_HALF_FLOAT);
  depth_->setSourceFormat(GL_RED);
  depth_->setSourceType(GL_FLOAT);
}

ComputePoints::~ComputePoints() {
  glDeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
  glDeleteProgram(draw_program_);
  glDeleteProgram(resolve_program_);
}

bool ComputePoints::suits(const PointCollection& points) {
  constexpr float kLargestPx = 4.0F;
  return std::ranges::all_of(
      points.batches, [](const PointBatch& batch) { return !batch.is_size_in_metres && batch.size <= kLargestPx; });
}

std::size_t ComputePoints::upload(const osg::Array* array) const {
  osg::GLBufferObject* const buffer = bufferOf(array, state_.getContextID());
  if (buffer == nullptr || !buffer->isDirty()) {
    return 0;
  }
  buffer->compileBuffer();
  state_.unbindVertexBufferObject();
  return array->getTotalDataSize();
}

std::vector<ComputePoints::Group> ComputePoints::cut(const PointCollection& points, int width_px, int height_px) {
  std::vector<Group> groups;
  slices_.clear();
  std::uint32_t first_number = 0;
  for (std::size_t i = 0; i < points.batches.size(); ++i) {
    const PointBatch& batch = points.batches[i];
    const BoxCull cull(batch.clip_from_points);
    const BoxProjector projector(batch.clip_from_points, width_px, height_px);
    for (std::size_t first = 0; first < batch.count(); first += largest_slice_) {
      Slice slice{.batch = i,
                  .first_number = first_number,
                  .first_group = static_cast<std::uint32_t>(first / kPassesOfSample),
                  .points = static_cast<std::uint32_t>(std::min(largest_slice_, batch.count() - first)),
                  .first_in_view = static_cast<std::uint32_t>(groups.size())};
      const std::uint32_t end = slice.first_group + (slice.points + kPassesOfSample - 1) / kPassesOfSample;
      for (std::uint32_t group = slice.first_group; group < end; ++group) {
        if (group >= batch.boxes.size()) {
          groups.push_back({group, kPassesOfSample});
        } else if (cull.mayBeSeen(batch.boxes[group])) {
          groups.push_back({group, pointsWorthDrawing(batch, projector.project(batch.boxes[group]))});
        }
      }
      slice.groups_in_view = static_cast<std::uint32_t>(groups.size()) - slice.first_in_view;
      slices_.push_back(slice);
    }
    first_number += static_cast<std::uint32_t>(batch.count());
  }
  return groups;
}

std::size_t ComputePoints::fit(int width_px, int height_px) {
  const auto pixels = static_cast<GLsizeiptr>(width_px) * height_px;
  if (width_px != width_px_ || height_px != height_px_) {
    width_px_ = width_px;
    height_px_ = height_px;
    for (const std::size_t buffer : {kNearestBuffer, kNumbersBuffer}) {
      glNamedBufferData(buffers_[buffer], 4 * pixels, nullptr, GL_DYNAMIC_COPY);
    }
    for (const auto& texture : {color_, depth_}) {
      texture->setTextureSize(width_px, height_px);
      texture->dirtyTextureObject();
    }
  }
  const GLuint nothing = 0;
  const GLuint nobody = ~0U;
  glClearNamedBufferData(buffers_[kNearestBuffer], GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &nothing);
  glClearNamedBufferData(buffers_[kNumbersBuffer], GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &nobody);
  return 0;
}

std::size_t ComputePoints::begin(const PointCollection& points, int width_px, int height_px) {
  points_ = points;
  const std::vector<Group> groups = cut(points, width_px, height_px);
  std::size_t uploaded = groups.size() * sizeof(Group);
  const Group none;
  glNamedBufferData(buffers_[kGroupsBuffer], static_cast<GLsizeiptr>(std::max<std::size_t>(uploaded, sizeof none)),
                    groups.empty() ? &none : groups.data(), GL_DYNAMIC_DRAW);
  for (const PointArrays& arrays : points.arrays) {
    uploaded += upload(arrays.positions.get());
    uploaded += upload(arrays.values.get());
  }
  return uploaded + fit(width_px, height_px);
}

void ComputePoints::bindSlice(unsigned binding, const osg::Array* array, const Slice& slice,
                              std::size_t bytes_a_point) const {
  osg::GLBufferObject* const buffer = bufferOf(array, state_.getContextID());
  if (buffer == nullptr) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffers_[kBytesBuffer]);  // nobody reads it
    return;
  }
  const std::size_t first =
      buffer->getOffset(array->getBufferIndex()) + std::size_t{slice.first_group} * kPassesOfSample * bytes_a_point;
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, buffer->getGLObjectID(), static_cast<GLintptr>(first),
                    static_cast<GLsizeiptr>(slice.points * bytes_a_point));
}

/// OSG knows nothing of what was bound here; of the program it must.
void ComputePoints::leave() const {
  glUseProgram(0);
  state_.setLastAppliedProgramObject(nullptr);
}

void ComputePoints::draw(const PassRange& passes) {
  const UniformSetter uniforms(draw_program_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kGroupsOrColors, buffers_[kGroupsBuffer]);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kNearest, buffers_[kNearestBuffer]);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kNumbers, buffers_[kNumbersBuffer]);
  uniforms.set("u_size_px", width_px_, height_px_);
  uniforms.set("u_passes", passes.first, passes.end);
  for (const int step : {0, 1}) {
    uniforms.set("u_step", step);
    for (const Slice& slice : slices_) {
      const PointBatch& batch = points_.batches[slice.batch];
      const PointArrays& arrays = points_.arrays[slice.batch];
      bindSlice(kPositions, arrays.positions.get(), slice, 12);
      bindSlice(kDepthsOrValues, batch.depths.empty() ? nullptr : arrays.values.get(), slice, 4);
      uniforms.set("u_clip_from_points", glm::mat4(batch.clip_from_points));
      uniforms.set("u_group_range", slice.first_in_view, slice.groups_in_view);
      uniforms.set("u_slice_group", slice.first_group);
      uniforms.set("u_point_count", static_cast<std::uint32_t>(batch.count()));
      uniforms.set("u_first_number", slice.first_number);
      uniforms.set("u_point_size", batch.size);
      uniforms.set("u_size_in_metres", batch.is_size_in_metres);
      uniforms.set("u_round", batch.is_round);
      uniforms.set("u_has_depths", !batch.depths.empty());
      uniforms.set("u_unit", batch.unit);
      uniforms.set("u_farthest", batch.farthest);
      dispatch(slice.groups_in_view);
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  leave();
  glFinish();  // or nobody knew how many points a frame has time for
}

std::size_t ComputePoints::resolve(const PointShading& shading, const glm::vec4& /*background*/) {
  state_.setActiveTextureUnit(0);
  for (const auto& texture : {color_, depth_}) {
    texture->apply(state_);
    state_.haveAppliedTextureAttribute(0, texture.get());
  }
  const GLuint color = textureId(color_, state_.getContextID());
  const GLuint depth = textureId(depth_, state_.getContextID());
  std::size_t uploaded = 0;
  const UniformSetter uniforms(resolve_program_);
  glBindImageTexture(0, color, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA16F);
  glBindImageTexture(1, depth, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kNearest, buffers_[kNearestBuffer]);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kNumbers, buffers_[kNumbersBuffer]);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kTable, buffers_[kTableBuffer]);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kBytes, buffers_[kBytesBuffer]);
  uniforms.set("u_size_px", width_px_, height_px_);
  for (std::size_t i = 0; i < slices_.size(); ++i) {
    const Slice& slice = slices_[i];
    const PointShading::Batch& batch = shading.batches()[slice.batch];
    const PointArrays& arrays = points_.arrays[slice.batch];
    const PointColors::Mode mode = batch.colors.mode;
    const bool is_rgb = mode == PointColors::Mode::Rgb;
    const bool is_value = mode == PointColors::Mode::Value;
    uploaded += is_rgb ? upload(arrays.rgba.get()) : 0;
    uploaded += is_value ? upload(arrays.values.get()) : 0;
    bindSlice(kPositions, arrays.positions.get(), slice, 12);
    bindSlice(kDepthsOrValues, is_value ? arrays.values.get() : nullptr, slice, 4);
    bindSlice(kGroupsOrColors, is_rgb ? arrays.rgba.get() : nullptr, slice, 4);
    std::vector<glm::vec4> table(std::max<std::size_t>(batch.table.size(), 2));
    std::ranges::transform(batch.table, table.begin(), [](const glm::vec3& entry) { return glm::vec4(entry, 0.0F); });
    glNamedBufferData(buffers_[kTableBuffer], static_cast<GLsizeiptr>(table.size() * sizeof table[0]), table.data(),
                      GL_STREAM_DRAW);
    uniforms.set("u_is_first", i == 0);
    const std::uint32_t first = slice.first_number + slice.first_group * kPassesOfSample;
    uniforms.set("u_numbers", first, first + slice.points);
    uniforms.set("u_mode", static_cast<int>(mode));
    uniforms.set("u_table_size", static_cast<int>(table.size()));
    uniforms.set("u_value", batch.colors.value_map);
    uniforms.set("u_axis", batch.colors.axis_map);
    uniforms.set("u_flat", batch.flat);
    uniforms.set("u_missing", batch.missing);
    dispatch((static_cast<std::uint32_t>(width_px_ * height_px_) + kPixelsAWorkGroup - 1) / kPixelsAWorkGroup);
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  leave();
  return uploaded;
}

}  // namespace stillframe::scenegraph
