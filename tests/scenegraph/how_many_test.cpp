#include "scenegraph/how_many.h"

#include <gtest/gtest.h>

namespace stillframe::scenegraph {
namespace {

TEST(HowMany, SaysOneOfWhatIsCountedInTheSingular) {
  EXPECT_EQ(howMany(1, "poses"), "1 pose");
  EXPECT_EQ(howMany(1, "entities"), "1 entity");
  EXPECT_EQ(howMany(1, "meshes"), "1 mesh");
  EXPECT_EQ(howMany(1, "axes"), "1 axis");
  EXPECT_EQ(howMany(1, "vertices"), "1 vertex");
  EXPECT_EQ(howMany(1, "earlier messages"), "1 earlier message");
  EXPECT_EQ(howMany(1, "dropped"), "1 dropped");
  EXPECT_EQ(howMany(1, ""), "1 ");
  EXPECT_EQ(howMany(0, "points"), "0 points");
  EXPECT_EQ(howMany(2, "entities"), "2 entities");
}

}  // namespace
}  // namespace stillframe::scenegraph
