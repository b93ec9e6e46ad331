#pragma once

#include <expected>
#include <memory>
#include <string>
#include <string_view>

#include "tools/ingest/message_decoder.h"

/// The makers that the table of converters names, one file per canonical type.
namespace stillframe::ingest::converters {

using Created = std::expected<std::unique_ptr<MessageDecoder>, std::string>;

Created rosTransforms(const SchemaRecord& schema, std::string_view message_encoding);
Created rosTransform(const SchemaRecord& schema, std::string_view message_encoding);
Created rosPointCloud(const SchemaRecord& schema, std::string_view message_encoding);

}  // namespace stillframe::ingest::converters
