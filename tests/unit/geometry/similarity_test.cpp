// SPDX-License-Identifier: Apache-2.0
#include "geometry/similarity.h"

#include <gtest/gtest.h>

#include "shapes.h"

namespace brume {
namespace {

TEST(Similarity, IsTakenApartAndPutTogetherAgain) {
  for (const glm::dmat4& m :
       {test::placed(3.0, Vec3d(1.0, 2.0, 3.0)), test::placed(1e-8, Vec3d(0.0)) * test::mirrored(),
        test::placed(1e15, Vec3d(-1e17))}) {
    const std::optional<Similarity> parts = as_similarity(m);
    ASSERT_TRUE(parts);
    EXPECT_GT(parts->scale, 0.0);
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT(glm::length(parts->scale * parts->rotation[i] - Vec3d(m[i])), 1e-12 * parts->scale);
      EXPECT_NEAR(glm::length(parts->rotation[i]), 1.0, 1e-15);
    }
    EXPECT_EQ(parts->offset, Vec3d(m[3]));
  }
}

TEST(Similarity, RefusesShearUnevenScaleAndSingularTransforms) {
  EXPECT_FALSE(as_similarity(test::skewed()));
  EXPECT_FALSE(as_similarity(glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 1.0, 1.00001))));
  EXPECT_FALSE(as_similarity(glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 1.0, 0.0))));
  EXPECT_FALSE(as_similarity(glm::scale(glm::dmat4(1.0), glm::dvec3(0.0))));
}

}  // namespace
}  // namespace brume
