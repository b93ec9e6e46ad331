#pragma once

#include <expected>
#include <filesystem>
#include <string>

#include "scenegraph/objects/payload.h"
#include "scenegraph/status.h"
#include "scenegraph/store/dataset.h"

namespace stillframe::ingest {

/// Adds a robot description from a file of the user's as a topic "robot:NAME", there from the recording's first instant
/// on. Codes "CannotOpen", "TooLarge". A dataset whose time range is not known gets nothing: there is no instant to
/// show it at.
[[nodiscard]] std::expected<void, scenegraph::Status> addRobotFile(scenegraph::Dataset& dataset,
                                                                   const std::filesystem::path& file);

/// Makes a topic "attachment:NAME" of each attachment that is a robot description, by its name or media type.
void addAttachedRobots(scenegraph::Dataset& dataset);

}  // namespace stillframe::ingest
