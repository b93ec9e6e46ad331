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
  Double,  ///< double, from any number
  Uint32,  ///< std::uint32_t, from an integer of at most 32 bits
  Bool,    ///< bool, from any integer
  Text,    ///< std::string_view into the message
  Bytes,   ///< std::span<const std::byte> into the message, from a sequence or array of one-byte numbers
  Stamp,   ///< tf::TimePoint, from a ROS time
  Rows,    ///< std::vector of another row, from a sequence or array of messages
};

/// Which fields of a message go into which members of a plain struct, its "row": what a converter wants to know of a
/// schema, independent of what else the schema holds and in which order.
///
///   Shape::of<CloudRow>().field<&CloudRow::frame_id>("header.frame_id").rows<&CloudRow::fields>("fields", field_shape)
class Shape {
 public:
  struct Binding {
    std::string path;  ///< "transform.translation.x"
    SlotKind kind = SlotKind::Double;
    void* (*locate)(void* row) = nullptr;                     ///< the member within its row
    void* (*append)(void* rows, std::size_t hint) = nullptr;  ///< Rows: a new row at the end
    std::shared_ptr<const Shape> row;                         ///< Rows
  };

  template <auto Member>
  Shape& field(std::string path) {
    using Slot = typename MemberOf<decltype(Member)>::Slot;
    bindings_.push_back({std::move(path), kindOf<Slot>(), &locate<Member>, nullptr, nullptr});
    return *this;
  }
  template <auto Member>
  Shape& rows(std::string path, Shape row) {
    using Slot = typename MemberOf<decltype(Member)>::Slot;
    bindings_.push_back({std::move(path), SlotKind::Rows, &locate<Member>, &append<Slot>,
                         std::make_shared<const Shape>(std::move(row))});
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
  template <typename Slot>
  static constexpr SlotKind kindOf() {
    if constexpr (std::is_same_v<Slot, double>) {
      return SlotKind::Double;
    } else if constexpr (std::is_same_v<Slot, std::uint32_t>) {
      return SlotKind::Uint32;
    } else if constexpr (std::is_same_v<Slot, bool>) {
      return SlotKind::Bool;
    } else if constexpr (std::is_same_v<Slot, std::string_view>) {
      return SlotKind::Text;
    } else if constexpr (std::is_same_v<Slot, std::span<const std::byte>>) {
      return SlotKind::Bytes;
    } else {
      static_assert(std::is_same_v<Slot, tf::TimePoint>, "no wire value goes into such a member");
      return SlotKind::Stamp;
    }
  }
  template <auto Member>
  static void* locate(void* row) {
    return &(static_cast<typename MemberOf<decltype(Member)>::Owner*>(row)->*Member);
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
