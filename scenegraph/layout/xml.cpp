#include "scenegraph/layout/xml.h"

#include <expat.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <ranges>
#include <utility>
#include <vector>

#include "scenegraph/layout/xml_text.h"

namespace stillframe::scenegraph {
namespace {

bool isSpace(std::string_view text) { return text.find_first_not_of(" \t\r\n") == std::string_view::npos; }

std::unexpected<Status> refused(const char* code, std::string message) {
  return std::unexpected(Status{StatusLevel::Error, code, std::move(message)});
}

/// Collects elements as Expat tells of them; the recursion is ours, and bounded.
class Reader {
 public:
  explicit Reader(const XmlLimits& limits) : limits_(limits), parser_(XML_ParserCreate(nullptr), &XML_ParserFree) {
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(),
        [](void* self, const XML_Char* name, const XML_Char** attributes) {
          static_cast<Reader*>(self)->begin(name, attributes);
        },
        [](void* self, const XML_Char*) { static_cast<Reader*>(self)->end(); });
    XML_SetCharacterDataHandler(parser_.get(), [](void* self, const XML_Char* text, int length) {
      static_cast<Reader*>(self)->addText({text, static_cast<std::size_t>(length)});
    });
    XML_SetCommentHandler(parser_.get(),
                          [](void* self, const XML_Char* text) { static_cast<Reader*>(self)->addComment(text); });
    XML_SetStartDoctypeDeclHandler(parser_.get(), [](void* self, const XML_Char*, const XML_Char* system_id,
                                                     const XML_Char* public_id, int is_internal) {
      if (is_internal != 0 || system_id != nullptr || public_id != nullptr) {
        static_cast<Reader*>(self)->stop("it declares entities of its own");
      }  // a bare <!DOCTYPE name>, as Qt writes it, declares nothing
    });
  }

  std::expected<XmlElement, Status> read(std::string_view text) {
    constexpr std::size_t kPiece = std::size_t{1} << 20;  // Expat counts in int
    for (std::size_t begin = 0; begin == 0 || begin < text.size(); begin += kPiece) {
      const std::string_view piece = text.substr(begin, kPiece);
      const bool is_last = begin + kPiece >= text.size();
      if (XML_Parse(parser_.get(), piece.data(), static_cast<int>(piece.size()), is_last ? 1 : 0) != XML_STATUS_OK) {
        const std::string line = std::to_string(XML_GetCurrentLineNumber(parser_.get()));
        const std::string reason = why_.empty() ? XML_ErrorString(XML_GetErrorCode(parser_.get())) : why_;
        return refused("MalformedLayout", "line " + line + ": " + reason);
      }
    }
    std::ranges::move(after_, std::back_inserter(root_.children));
    return std::move(root_);
  }

 private:
  void stop(std::string why) {
    why_ = std::move(why);
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  /// Counts one more element or comment.
  [[nodiscard]] bool isTooMany() {
    if (++elements_ <= limits_.elements) {
      return false;
    }
    stop("more than " + std::to_string(limits_.elements) + " elements");
    return true;
  }

  void begin(const XML_Char* name, const XML_Char** attributes) {
    if (open_.size() >= limits_.depth) {
      stop("more than " + std::to_string(limits_.depth) + " elements within each other");
      return;
    }
    if (isTooMany()) {
      return;
    }
    XmlElement element{name, {}, {}, std::exchange(before_, {})};
    for (; *attributes != nullptr; attributes += 2) {
      element.set(attributes[0], attributes[1]);
    }
    open_.push_back(std::move(element));
  }

  void end() {
    if (open_.empty()) {
      return;
    }
    XmlElement element = std::move(open_.back());
    open_.pop_back();
    const bool is_laid_out = std::ranges::any_of(element.children, [](const auto& of) { return !of.name.empty(); });
    if (is_laid_out) {
      std::erase_if(element.children, [](const auto& of) { return of.name.empty() && isSpace(of.text); });
    }
    (open_.empty() ? root_ : open_.back().children.emplace_back()) = std::move(element);
  }

  void addComment(const XML_Char* text) {
    if (isTooMany()) {
      return;
    }
    const bool is_before = open_.empty() && root_.name.empty();
    std::vector<XmlElement>& comments = is_before ? before_ : open_.empty() ? after_ : open_.back().children;
    comments.push_back({std::string(is_before ? kCommentBefore : open_.empty() ? kCommentAfter : kComment), text});
  }

  void addText(std::string_view text) {
    if (open_.empty()) {
      return;
    }
    auto& children = open_.back().children;
    if (children.empty() || !children.back().name.empty()) {
      children.push_back({.name = {}, .text = std::string(text)});
    } else {
      children.back().text += text;
    }
  }

  XmlLimits limits_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  XmlElement root_;
  std::vector<XmlElement> open_;
  std::vector<XmlElement> before_;  // comments before the root
  std::vector<XmlElement> after_;
  std::size_t elements_ = 0;
  std::string why_;  // of a stop of ours
};

/// A comment of the file, not of what is within its root.
bool isOutside(const XmlElement& element) { return element.name == kCommentBefore || element.name == kCommentAfter; }

/// `indent` is negative where space would be text, 0 for the root, whose comments of the file stand outside it.
void writeElement(const XmlElement& element, int indent, std::string& out) {  // as deep as the limit of parseXml()
  if (element.name.empty()) {
    appendXmlText(element.text, out);
    return;
  }
  if (element.isComment()) {
    out += "<!--";
    appendXmlComment(element.text, out);
    out += "-->";
    return;
  }
  const std::string_view space = "\n                                                                ";
  const auto newLine = [&](int depth) {
    if (depth >= 0) {
      out += space.substr(0, std::min<std::size_t>(space.size(), 1 + 2 * static_cast<std::size_t>(depth)));
    }
  };
  out += "<" + element.name;
  for (const auto& [key, value] : element.attributes) {
    out += " " + key + "=\"";
    appendXmlAttribute(value, out);
    out += "\"";
  }
  const bool is_root = indent == 0;
  auto children = element.children | std::views::filter([&](const auto& of) { return !is_root || !isOutside(of); });
  if (children.empty()) {
    out += "/>";
    return;
  }
  out += ">";
  const bool has_text = std::ranges::any_of(element.children, [](const auto& of) { return of.name.empty(); });
  const int inner = indent < 0 || has_text ? -1 : indent + 1;
  for (const XmlElement& child : children) {
    newLine(inner);
    writeElement(child, inner, out);
  }
  newLine(inner < 0 ? -1 : indent);
  out += "</" + element.name + ">";
}

}  // namespace

const std::string* XmlElement::attribute(std::string_view key) const {
  const auto found = std::ranges::find_if(attributes, [&](const auto& of) { return of.first == key; });
  return found == attributes.end() ? nullptr : &found->second;
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
  const auto found = std::ranges::find(children, child_name, &XmlElement::name);
  return found == children.end() ? nullptr : &*found;
}

std::expected<XmlElement, Status> parseXml(std::string_view text, const XmlLimits& limits) {
  if (text.size() > limits.bytes) {
    return refused("LayoutTooLarge", "it has " + std::to_string(text.size()) + " bytes; a layout has at most " +
                                         std::to_string(limits.bytes));
  }
  return Reader(limits).read(text);
}

std::string writeXml(const XmlElement& root) {
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  const auto writeComments = [&](std::string_view name) {
    for (const XmlElement& child : root.children) {
      if (child.name == name) {
        writeElement(child, 0, out);
        out += "\n";
      }
    }
  };
  writeComments(kCommentBefore);
  writeElement(root, 0, out);
  out += "\n";
  writeComments(kCommentAfter);
  return out;
}

}  // namespace stillframe::scenegraph
