#include "nodes/tf_axes/frame_list.h"

#include <gtest/gtest.h>

namespace stillframe::nodes {
namespace {

TEST(FrameList, SplitsAtCommasAndLeavesBlanksOut) {
  EXPECT_EQ(splitFrameNames(" arm ,late"), (FrameNameSet{"arm", "late"}));
  EXPECT_EQ(splitFrameNames(""), FrameNameSet{});
  EXPECT_EQ(splitFrameNames(" , ,,"), FrameNameSet{});
  EXPECT_EQ(splitFrameNames("a b, c"), (FrameNameSet{"a b", "c"}));
}

TEST(FrameList, AnyNameComesBack) {
  for (const FrameNameSet& names :
       {FrameNameSet{}, FrameNameSet{"a"}, FrameNameSet{"map", "odom"}, FrameNameSet{"a,b", "c\\", "\\,", "d e"},
        FrameNameSet{"ends,"}, FrameNameSet{"robot/base_link", "\xC3\xA4"}}) {
    EXPECT_EQ(splitFrameNames(joinFrameNames(names)), names) << joinFrameNames(names);
  }
}

TEST(FrameList, ABackslashAtTheEndIsItself) { EXPECT_EQ(splitFrameNames("a\\"), (FrameNameSet{"a\\"})); }

}  // namespace
}  // namespace stillframe::nodes
