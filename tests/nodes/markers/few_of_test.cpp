#include "nodes/markers/few_of.h"

#include <gmock/gmock.h>

#include <span>
#include <string>

namespace stillframe::test {
namespace {

using nodes::FewOf;

TEST(FewOf, HoldsOneInItselfAndSeveralInOnePiece) {
  FewOf<std::string> words;
  EXPECT_TRUE(words.empty());
  EXPECT_EQ(words.begin(), words.end());
  EXPECT_EQ(words.push_back("one"), "one");
  EXPECT_EQ(words.size(), 1U);
  EXPECT_EQ(words.byteSize(), 0U);
  words.push_back("two") += "!";
  words.push_back("three");
  EXPECT_THAT(std::span<const std::string>(words), testing::ElementsAre("one", "two!", "three"));
  EXPECT_EQ(words.at(2), "three");
  EXPECT_THROW((void)words.at(3), std::out_of_range);
  EXPECT_EQ(words.byteSize(), 3 * sizeof(std::string));
}

TEST(FewOf, CopiesAreTheirOwn) {
  FewOf<std::string> words;
  words.push_back("one");
  FewOf<std::string> copy = words;
  copy[0] = "other";
  copy.push_back("two");
  EXPECT_THAT(std::span<const std::string>(words), testing::ElementsAre("one"));
  EXPECT_THAT(std::span<const std::string>(copy), testing::ElementsAre("other", "two"));
}

}  // namespace
}  // namespace stillframe::test
