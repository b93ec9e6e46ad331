#include "viewer/dock/dom.h"

#include <algorithm>
#include <functional>
#include <optional>

namespace stillframe::viewer {
namespace {

using scenegraph::Status;
using scenegraph::StatusLevel;
using scenegraph::XmlElement;

bool isSpace(const QString& text) { return text.trimmed().isEmpty(); }

}  // namespace

QDomElement toDom(const XmlElement& element, QDomDocument& document) {
  QDomElement made = document.createElement(QString::fromStdString(element.name));
  for (const auto& [key, value] : element.attributes) {
    made.setAttribute(QString::fromStdString(key), QString::fromStdString(value));
  }
  for (const XmlElement& child : element.children) {
    if (child.name.empty()) {
      made.appendChild(document.createTextNode(QString::fromStdString(child.text)));
    } else if (child.isComment()) {
      made.appendChild(document.createComment(QString::fromStdString(child.text)));
    } else {
      made.appendChild(toDom(child, document));
    }
  }
  return made;
}

std::expected<XmlElement, Status> fromDom(const QDomElement& element) {
  const scenegraph::XmlLimits limits;
  std::size_t elements = 0;
  std::optional<Status> fault;
  const std::function<XmlElement(const QDomElement&, std::size_t)> convert = [&](const QDomElement& from,
                                                                                 std::size_t depth) {
    XmlElement made{from.tagName().toStdString()};
    if (depth > limits.depth || ++elements > limits.elements) {
      fault = Status{StatusLevel::Error, "MalformedLayout", "<" + made.name + ">: too many elements, or too deep"};
    }
    const QDomNamedNodeMap attributes = from.attributes();
    for (int i = 0; i < attributes.count(); ++i) {
      const QDomAttr attribute = attributes.item(i).toAttr();
      made.set(attribute.name().toStdString(), attribute.value().toStdString());
    }
    std::ranges::sort(made.attributes);
    const bool has_elements = !from.firstChildElement().isNull();
    for (QDomNode child = from.firstChild(); !fault && !child.isNull(); child = child.nextSibling()) {
      if (child.isElement()) {
        made.children.push_back(convert(child.toElement(), depth + 1));
      } else if (child.isComment()) {
        made.children.push_back({.name = std::string(scenegraph::kComment), .text = child.nodeValue().toStdString()});
      } else if (child.isText() && !(has_elements && isSpace(child.nodeValue()))) {
        made.children.push_back({.name = {}, .text = child.nodeValue().toStdString()});
      }
    }
    return made;
  };
  XmlElement converted = convert(element, 1);
  return fault ? std::expected<XmlElement, Status>(std::unexpected(*fault)) : std::move(converted);
}

}  // namespace stillframe::viewer
