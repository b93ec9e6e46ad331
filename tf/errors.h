#pragma once

#include <cstdint>
#include <string_view>

#include "tf/time.h"

namespace stillframe::tf {

/// Dense index of an interned frame name; valid for the life of its TransformBuffer (until clear()).
using FrameId = std::uint32_t;
inline constexpr FrameId kNoFrame = ~FrameId{0};

/// Why a sample was refused. Checked in this order.
enum class InsertError : std::uint8_t {
  EmptyFrameName,    ///< parent or child is empty once leading slashes are stripped
  SelfLoop,          ///< parent and child are the same frame
  NotFinite,         ///< translation or rotation holds NaN or infinity
  ZeroQuaternion,    ///< rotation of norm zero: it cannot be normalised
  ReparentConflict,  ///< the child already has another parent
  Cycle,             ///< the parent is a descendant of the child
};

/// Why a lookup has no answer.
enum class LookupError : std::uint8_t {
  UnknownTarget,   ///< the target frame has never been seen
  UnknownSource,   ///< the source frame has never been seen
  Disconnected,    ///< the frames are in different trees
  NoSampleAtTime,  ///< an edge on the chain has its first sample after the requested time
};

/// A failed lookup: trivially copyable, made without allocation. TransformBuffer::describe() turns it into a sentence.
struct LookupFailure {
  LookupError code = LookupError::UnknownTarget;
  FrameId target = kNoFrame;      ///< kNoFrame when unknown
  FrameId source = kNoFrame;      ///< kNoFrame when unknown
  FrameId edge_child = kNoFrame;  ///< NoSampleAtTime: the child of the first edge without a sample, from the source up
  TimePoint time;                 ///< the requested time
  TimePoint edge_first;           ///< NoSampleAtTime: first stamp of that edge
  TimePoint edge_last;            ///< NoSampleAtTime: newest stamp of that edge
};

/// Enumerator names, as they appear in statuses and JSON.
[[nodiscard]] std::string_view toString(InsertError error) noexcept;
[[nodiscard]] std::string_view toString(LookupError error) noexcept;

}  // namespace stillframe::tf
