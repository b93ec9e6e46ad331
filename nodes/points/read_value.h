#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "scenegraph/objects/point_cloud.h"

namespace stillframe::nodes {

/// One value of type T at any address, in either byte order.
template <typename T, bool kSwapped>
[[nodiscard]] inline T readValue(const std::byte* at) noexcept {
  using Bits = std::conditional_t<sizeof(T) == 1, std::uint8_t,
                                  std::conditional_t<sizeof(T) == 2, std::uint16_t,
                                                     std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;
  Bits bits;
  std::memcpy(&bits, at, sizeof(bits));
  if constexpr (kSwapped && sizeof(T) > 1) {
    bits = std::byteswap(bits);
  }
  return std::bit_cast<T>(bits);
}

/// Calls `function.template operator()<T, kSwapped>()` for the C++ type of a known field type; does nothing for an
/// unknown one.
template <typename Function>
void withFieldType(scenegraph::FieldType type, bool is_bigendian, Function&& function) {
  const auto call = [&]<typename T>() {
    if (is_bigendian != (std::endian::native == std::endian::big)) {
      function.template operator()<T, true>();
    } else {
      function.template operator()<T, false>();
    }
  };
  using enum scenegraph::FieldType;
  switch (type) {
    case Int8:
      return call.template operator()<std::int8_t>();
    case Uint8:
      return call.template operator()<std::uint8_t>();
    case Int16:
      return call.template operator()<std::int16_t>();
    case Uint16:
      return call.template operator()<std::uint16_t>();
    case Int32:
      return call.template operator()<std::int32_t>();
    case Uint32:
      return call.template operator()<std::uint32_t>();
    case Float32:
      return call.template operator()<float>();
    case Float64:
      return call.template operator()<double>();
    case Unknown:
      return;
  }
}

/// Reads one value of a field as double; chosen once per field, called per point where speed does not matter.
using ValueReader = double (*)(const std::byte* at) noexcept;
[[nodiscard]] inline ValueReader valueReader(scenegraph::FieldType type, bool is_bigendian) noexcept {
  ValueReader reader = +[](const std::byte*) noexcept { return 0.0; };
  withFieldType(type, is_bigendian, [&]<typename T, bool kSwapped>() {
    reader = +[](const std::byte* at) noexcept { return static_cast<double>(readValue<T, kSwapped>(at)); };
  });
  return reader;
}

}  // namespace stillframe::nodes
