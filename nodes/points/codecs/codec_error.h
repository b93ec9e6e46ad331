#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace stillframe::nodes {

/// Why a compressed cloud cannot be decoded.
enum class CodecErrorCode : std::uint8_t {
  UnknownFormat,       ///< a format that is not read here, or that does not describe itself
  MalformedHeader,     ///< the blob does not begin with a header of its format
  UnsupportedVersion,  ///< of a version, an encoding or a data type that is not read here
  ImplausibleSize,     ///< the header claims more than the bytes behind it could hold
  CorruptCloud,        ///< the bytes contradict themselves or end too early
};
[[nodiscard]] std::string_view toString(CodecErrorCode code) noexcept;

struct CodecError {
  CodecErrorCode code = CodecErrorCode::CorruptCloud;
  std::string message;  ///< one sentence with the numbers; topic and time are the caller's to add
};

/// Bytes that a blob of that size may decode to, whatever its header claims: 1024-fold, but always 64 MiB, and never
/// more than 2 GiB.
[[nodiscard]] std::uint64_t maxDecodedBytes(std::size_t blob_bytes) noexcept;

}  // namespace stillframe::nodes
