// diptych: words are taken apart and put together
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/words.h"

#include <gtest/gtest.h>

namespace
{
  using namespace diptych::discrete;

  TEST(Words, WhiteSpaceGoesAtBothEndsOnly)
  {
    EXPECT_EQ(trimmed(" \ta b\r\n"), "a b");
    EXPECT_EQ(trimmed("ab"), "ab");
    EXPECT_EQ(trimmed(" \v\f "), "");
    EXPECT_EQ(trimmed(""), "");
  }

  TEST(Words, SeveralWordsBecomeOneText)
  {
    EXPECT_EQ(joined({"a", "b"}), "a b");
    EXPECT_EQ(joined({"a", "b"}, "; "), "a; b");
    EXPECT_EQ(listed({"a", "b", "c"}), "a, b, c");
    EXPECT_EQ(listed({}), "");
  }
} // namespace
