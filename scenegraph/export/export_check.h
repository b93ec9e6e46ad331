#pragma once

#include <expected>
#include <osg/Node>

#include "scenegraph/status.h"

namespace stillframe::scenegraph {

/// Whether every object that would be written with `root` survives a .osgt file: classes known to stock OSG and values
/// that text can hold. Codes "NotExportable" and "NotFinite", as osgt_export.h says. Visits everything, whatever its
/// mask.
[[nodiscard]] std::expected<void, Status> checkExportable(const osg::Node& root);

}  // namespace stillframe::scenegraph
