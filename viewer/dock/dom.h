#pragma once

#include <QDomDocument>
#include <expected>

#include "scenegraph/layout/xml.h"

namespace stillframe::viewer {

/// Between our elements and those of a host's layout. From a host's: attributes in the order of their names;
/// "MalformedLayout" when it is nested deeper than parseXml() allows.
[[nodiscard]] QDomElement toDom(const scenegraph::XmlElement& element, QDomDocument& document);
[[nodiscard]] std::expected<scenegraph::XmlElement, scenegraph::Status> fromDom(const QDomElement& element);

}  // namespace stillframe::viewer
