#include "scenegraph/layout/xml.h"

#include <gtest/gtest.h>

namespace stillframe::scenegraph {
namespace {

using namespace std::string_view_literals;

std::string again(const std::string& text) {
  const auto root = parseXml(text);
  return root ? writeXml(*root) : root.error().code + ": " + root.error().message;
}

TEST(Xml, WritesWhatItReadsByteForByte) {
  const std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<a k=\"v\" j=\"&lt;&amp;&quot;&gt;'\">\n"
      "  <b/>\n"
      "  <c>\n"
      "    <d x=\"1\"/>\n"
      "  </c>\n"
      "  <e>words &amp; more</e>\n"
      "  <f>mixed <g/> text</f>\n"
      "</a>\n";
  EXPECT_EQ(again(text), text);
}

TEST(Xml, CommentsStayWhereTheyStandByteForByte) {
  const std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!-- whose it is -->\n"
      "<!---->\n"
      "<a>\n"
      "  <!-- of two\n       lines, with & < > \" and - -->\n"
      "  <b/>\n"
      "  <c>words<!-- between --> and more</c>\n"
      "  <d>\n"
      "    <!-- alone -->\n"
      "  </d>\n"
      "  <!-- last -->\n"
      "</a>\n"
      "<!-- the end -->\n";
  EXPECT_EQ(again(text), text);
}

TEST(Xml, CommentThatXmlCannotHoldIsWrittenSoThatItIsReadAgain) {
  XmlElement element{"a"};
  for (const char* const words : {"--", "-a-", "a--b---", "a\x01\rb", "\xFF"}) {
    element.children.push_back({.name = std::string(kComment), .text = words});
  }
  const std::string written = writeXml(element);
  EXPECT_EQ(again(written), written);
}

TEST(Xml, CommentsCountAsElements) {
  EXPECT_FALSE(parseXml("<a><!-- 1 --><!-- 2 --></a>", {.elements = 2}));
  EXPECT_TRUE(parseXml("<a><!-- 1 --><!-- 2 --></a>", {.elements = 3}));
}

TEST(Xml, SpaceInValuesSurvives) {
  XmlElement element{"a"};
  element.set("k", "tab\tline\nreturn\r end ");
  EXPECT_EQ(parseXml(writeXml(element)), element);
}

TEST(Xml, WhatXmlCannotHoldIsReplacedAndStaysSo) {
  XmlElement element{"a"};
  element.set("k", std::string("\x01zero\0\xFF\xC3(\xED\xA0\x80|\xF4\x90\x80\x80|\xEF\xBF\xBE|\xC0\x80"sv));
  const std::string written = writeXml(element);
  EXPECT_NE(written.find("\xEF\xBF\xBDzero\xEF\xBF\xBD"), std::string::npos) << written;
  EXPECT_EQ(again(written), written);
}

TEST(Xml, CharactersOfEveryLengthSurvive) {
  XmlElement element{"a"};
  element.set("k", "a\xC3\xA4\xE2\x82\xAC\xF0\x9F\xA4\x96");
  EXPECT_EQ(parseXml(writeXml(element)), element);
}

TEST(Xml, ReadsOtherEncodings) {
  const auto latin = parseXml("<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?><a k=\"\xE4\"/>");
  ASSERT_TRUE(latin);
  EXPECT_EQ(*latin->attribute("k"), "\xC3\xA4");
}

TEST(Xml, ADoctypeWithoutEntitiesIsHarmless) { EXPECT_TRUE(parseXml("<!DOCTYPE PlotJuggler><a/>")); }

TEST(Xml, RefusesWhatIsMalformedWithItsLine) {
  EXPECT_EQ(again("<a>\n<b>\n</a>"), "MalformedLayout: line 3: mismatched tag");
  EXPECT_EQ(again(""), "MalformedLayout: line 1: no element found");
  EXPECT_EQ(again("<a/><b/>"), "MalformedLayout: line 1: junk after document element");
  EXPECT_EQ(again("<a k='1' k='2'/>"), "MalformedLayout: line 1: duplicate attribute");
}

TEST(Xml, RefusesEntitiesOfItsOwn) {
  const std::string laughs =
      "<!DOCTYPE a [<!ENTITY b \"ha\"><!ENTITY c \"&b;&b;&b;&b;\"><!ENTITY d \"&c;&c;&c;&c;\">]><a>&d;</a>";
  EXPECT_EQ(again(laughs), "MalformedLayout: line 1: it declares entities of its own");
  EXPECT_EQ(again("<!DOCTYPE a SYSTEM \"file:///etc/passwd\"><a>&x;</a>"),
            "MalformedLayout: line 1: it declares entities of its own");
}

TEST(Xml, BoundsDepthAndNumberOfElements) {
  std::string deep;
  for (int i = 0; i < 100'000; ++i) {
    deep += "<a>";
  }
  EXPECT_EQ(again(deep), "MalformedLayout: line 1: more than 64 elements within each other");
  std::string many = "<a>";
  for (int i = 0; i < 200'001; ++i) {
    many += "<b/>";
  }
  EXPECT_EQ(again(many + "</a>"), "MalformedLayout: line 1: more than 200000 elements");
}

TEST(Xml, RefusesATextThatIsTooLarge) {
  EXPECT_EQ(again(std::string(std::size_t{17} << 20, ' ')).substr(0, 14), "LayoutTooLarge");
}

}  // namespace
}  // namespace stillframe::scenegraph
