#include "nodes/points/record_fields.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "nodes/points/channel.h"
#include "nodes/points/read_value.h"

namespace stillframe::nodes {

void addRecordFields(scenegraph::Picked& picked, const std::vector<scenegraph::PackedField>& fields,
                     std::span<const std::byte> record, bool is_bigendian) {
  for (const scenegraph::PackedField& field : fields) {
    const std::size_t bytes = scenegraph::byteSize(field.type);
    const std::uint32_t count = std::clamp(field.count, 1U, kMaxChannelValues);
    for (std::uint32_t i = 0; bytes != 0 && i < count; ++i) {
      const std::size_t offset = field.offset + i * bytes;
      if (offset + bytes > record.size()) {
        break;
      }
      const std::string name = count > 1 ? field.name + "[" + std::to_string(i) + "]" : field.name;
      withFieldType(field.type, is_bigendian, [&]<typename T, bool kSwapped>() {
        picked.add(name, readValue<T, kSwapped>(record.data() + offset));
      });
    }
  }
}

std::string colorText(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", static_cast<unsigned>(red), static_cast<unsigned>(green),
                static_cast<unsigned>(blue));
  return text.data();
}

std::span<const std::byte> recordAt(std::span<const std::byte> data, std::size_t offset, std::size_t size) {
  return offset >= data.size() ? std::span<const std::byte>{}
                               : data.subspan(offset, std::min(size, data.size() - offset));
}

}  // namespace stillframe::nodes
