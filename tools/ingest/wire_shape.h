#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "tf/time.h"

namespace stillframe::ingest {

/// What a member of a row holds.
enum class SlotKind : std::uint8_t {
  Double,   ///< double, from any number
  Float,    ///< float, from any number
  Uint32,   ///< std::uint32_t, from an integer of at most 32 bits (its bits), or an enumerator
  Int32,    ///< std::int32_t, likewise
  Bool,     ///< bool, from any integer
  Text,     ///< std::string_view, valid while the message is
  String,   ///< std::string
  Bytes,    ///< std::span<const std::byte>, from a sequence or array of one-byte numbers
  Stamp,    ///< tf::TimePoint, from a time or a duration
  Doubles,  ///< std::vector<double>, from a sequence or array of any numbers
  Floats,   ///< std::vector<float>, likewise
  Uint32s,  ///< std::vector<std::uint32_t>, from a sequence or array of integers of at most 32 bits
  Texts,    ///< std::vector<std::string_view>
  Row,      ///< another row, from a message
  Rows,     ///< std::vector of another row, from a sequence or array of messages
};

/// Bytes of rows that a message of that size may become, so that no message of empty elements takes all memory.
[[nodiscard]] constexpr std::uint64_t rowBudget(std::size_t message_bytes) noexcept {
  return (std::uint64_t{64} << 20) + 16 * std::uint64_t{message_bytes};
}

/// Which fields of a message go into which members of a plain struct, its "row": what a converter wants to know of a
/// schema, independent of what else the schema holds and in which order, and of how it is written (ROS, protobuf,
/// JSON).
///
///   shape.field<&CloudRow::frame_id>("header.frame_id").rows<&CloudRow::fields>("fields", field_shape)
///
/// Several members in a row lead to a member of a member: field<&GridRow::grid, &OccupancyGrid::width>("info.width").
///
/// A path of digits names protobuf fields by number. A field the definition lacks is an error unless it is optional.
///
/// Rows of different sources need different names even in anonymous namespaces: g++ 12 gives functions that are made
/// from a member of such a row external linkage, and the linker merges those of one name.
class Shape {
 public:
  struct Binding {
    std::string path;  ///< "transform.translation.x"
    SlotKind kind = SlotKind::Double;
    void* (*locate)(void* row) = nullptr;                     ///< the member within its row
    void* (*append)(void* rows, std::size_t hint) = nullptr;  ///< Rows: a new row at the end
    std::shared_ptr<const Shape> row;                         ///< Row, Rows
    std::size_t row_bytes = 0;                                ///< Rows: size of one
    bool is_optional = false;
  };

  template <auto... Members>
  Shape& field(std::string path) {
    bindings_.push_back({std::move(path), kindOf<SlotOf<Members...>>(), &locate<Members...>, nullptr, nullptr});
    return *this;
  }
  template <auto... Members>
  Shape& row(std::string path, Shape row) {
    bindings_.push_back(
        {std::move(path), SlotKind::Row, &locate<Members...>, nullptr, std::make_shared<const Shape>(std::move(row))});
    return *this;
  }
  template <auto... Members>
  Shape& rows(std::string path, Shape row) {
    using Slot = SlotOf<Members...>;
    bindings_.push_back({std::move(path), SlotKind::Rows, &locate<Members...>, &append<Slot>,
                         std::make_shared<const Shape>(std::move(row)), sizeof(typename Slot::value_type)});
    return *this;
  }
  /// Makes the field bound last one that the definition may lack.
  Shape& optional() {
    bindings_.back().is_optional = true;
    return *this;
  }
  [[nodiscard]] const std::vector<Binding>& bindings() const noexcept { return bindings_; }

 private:
  template <typename T>
  struct MemberOf;
  template <typename Row, typename Member>
  struct MemberOf<Member Row::*> {
    using Owner = Row;
    using Slot = Member;
  };
  template <auto... Members>
  using SlotOf = typename MemberOf<std::remove_cvref_t<decltype((Members, ...))>>::Slot;  // of the last

  template <typename Slot>
  static constexpr SlotKind kindOf() {
    if constexpr (std::is_same_v<Slot, double>) {
      return SlotKind::Double;
    } else if constexpr (std::is_same_v<Slot, float>) {
      return SlotKind::Float;
    } else if constexpr (std::is_same_v<Slot, std::int32_t>) {
      return SlotKind::Int32;
    } else if constexpr (std::is_same_v<Slot, std::vector<double>>) {
      return SlotKind::Doubles;
    } else if constexpr (std::is_same_v<Slot, std::vector<float>>) {
      return SlotKind::Floats;
    } else if constexpr (std::is_same_v<Slot, std::vector<std::uint32_t>>) {
      return SlotKind::Uint32s;
    } else if constexpr (std::is_same_v<Slot, std::vector<std::string_view>>) {
      return SlotKind::Texts;
    } else if constexpr (std::is_same_v<Slot, std::uint32_t>) {
      return SlotKind::Uint32;
    } else if constexpr (std::is_same_v<Slot, bool>) {
      return SlotKind::Bool;
    } else if constexpr (std::is_same_v<Slot, std::string>) {
      return SlotKind::String;
    } else if constexpr (std::is_same_v<Slot, std::string_view>) {
      return SlotKind::Text;
    } else if constexpr (std::is_same_v<Slot, std::span<const std::byte>>) {
      return SlotKind::Bytes;
    } else {
      static_assert(std::is_same_v<Slot, tf::TimePoint>, "no wire value goes into such a member");
      return SlotKind::Stamp;
    }
  }
  template <auto First, auto... Rest>
  static void* locate(void* row) {
    return member<Rest...>(static_cast<typename MemberOf<decltype(First)>::Owner*>(row)->*First);
  }
  template <auto... Members, typename Value>
  static void* member(Value& value) {
    return &(value.*....*Members);
  }
  template <typename Rows>
  static void* append(void* rows, std::size_t hint) {
    auto& all = *static_cast<Rows*>(rows);
    if (all.empty()) {
      all.reserve(hint);
    }
    return &all.emplace_back();
  }

  std::vector<Binding> bindings_;
};

}  // namespace stillframe::ingest
