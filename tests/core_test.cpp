#include <gtest/gtest.h>

#include <array>

#include "core/error.h"

namespace nephroid {
namespace {

TEST(Error, EditDistanceCountsInsertionsDeletionsAndSubstitutions) {
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
  EXPECT_EQ(editDistance("", "abc"), 3u);
  EXPECT_EQ(editDistance("same", "same"), 0u);
}

TEST(Error, NearestNameIsEmptyWhenNothingIsNear) {
  const std::array<const char*, 3> known{"position", "target", "fov"};
  EXPECT_EQ(nearestName("positon", known), "position");
  EXPECT_EQ(nearestName("zzzzzzzz", known), "");
}

}  // namespace
}  // namespace nephroid
