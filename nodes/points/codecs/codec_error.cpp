#include "nodes/points/codecs/codec_error.h"

#include <algorithm>

namespace stillframe::nodes {

std::string_view toString(CodecErrorCode code) noexcept {
  switch (code) {
    case CodecErrorCode::UnknownFormat:
      return "UnknownFormat";
    case CodecErrorCode::MalformedHeader:
      return "MalformedHeader";
    case CodecErrorCode::UnsupportedVersion:
      return "UnsupportedVersion";
    case CodecErrorCode::ImplausibleSize:
      return "ImplausibleSize";
    case CodecErrorCode::CorruptCloud:
      return "CorruptCloud";
  }
  return "CorruptCloud";
}

std::uint64_t maxDecodedBytes(std::size_t blob_bytes) noexcept {
  constexpr std::uint64_t kAlways = std::uint64_t{64} << 20;
  constexpr std::uint64_t kNever = std::uint64_t{2} << 30;
  return std::clamp(1024 * std::min<std::uint64_t>(blob_bytes, kNever), kAlways, kNever);
}

}  // namespace stillframe::nodes
