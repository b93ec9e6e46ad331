#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <functional>
#include <span>
#include <string_view>

#include "nodes/meshes/mesh_data.h"

namespace stillframe::nodes {

/// Why bytes are not a mesh that may be drawn.
enum class MeshStreamError : std::uint8_t {
  NotAMesh,      ///< no header of ours
  WrongSize,     ///< the counts need another number of bytes than there are
  BadReference,  ///< an index, range, material or texture that is not there
  BadNumber,     ///< a position or colour that is not finite
};

/// Enumerator name.
[[nodiscard]] std::string_view toString(MeshStreamError error) noexcept;

/// A mesh as bytes between the importing process and us: a header of counts, then array by array, native byte order.
/// `put` takes the pieces one after the other.
void writeMesh(const MeshData& mesh, const std::function<void(std::span<const std::byte>)>& put);
/// Bytes that writeMesh() will put.
[[nodiscard]] std::size_t streamSize(const MeshData& mesh);

/// Reads what writeMesh() wrote and trusts none of it: every count is held against the bytes that are there before
/// memory is taken, every index against its array. Costs one pass.
[[nodiscard]] std::expected<MeshData, MeshStreamError> readMesh(std::span<const std::byte> bytes);

}  // namespace stillframe::nodes
