#pragma once

#include <expected>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "scenegraph/objects/object.h"
#include "tools/ingest/mcap_records.h"
#include "tools/ingest/message_decoder.h"

namespace stillframe::ingest {

/// One row of the table of converters (converters/table.cpp): a schema and what it becomes.
struct ConverterType {
  std::string_view schema;  ///< normalised: "sensor_msgs/PointCloud2", "foxglove.PointCloud"
  scenegraph::ObjectType type;
  /// The error is the reason why a channel of that schema cannot be drawn, half a sentence.
  std::expected<std::unique_ptr<MessageDecoder>, std::string> (*create)(const SchemaRecord& schema,
                                                                        std::string_view message_encoding);
  std::string_view topic_segment = {};  ///< the last one of the topics that it is about; "": all topics
};

/// Every schema that can be drawn.
[[nodiscard]] std::span<const ConverterType> converterTypes();

}  // namespace stillframe::ingest
