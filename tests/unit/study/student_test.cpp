// SPDX-License-Identifier: Apache-2.0
#include "study/student.h"

#include <gtest/gtest.h>

#include <cmath>

namespace brume {
namespace {

TEST(Student, ClosedFormsOfOneTwoAndManyDegrees) {
  for (const double t : {1e-3, 0.3, 1.0, 2.7, 40.0, 1e5}) {
    EXPECT_NEAR(student_two_sided(t, 1.0), 1.0 - 2.0 / M_PI * std::atan(t), 1e-12);
    EXPECT_NEAR(student_two_sided(t, 2.0), 1.0 - t / std::sqrt(2.0 + t * t), 1e-12);
    EXPECT_EQ(student_two_sided(t, 3.7), student_two_sided(-t, 3.7));
  }
  for (const double t : {0.1, 1.0, 3.0, 5.0})
    EXPECT_NEAR(student_two_sided(t, 0.99e6) / std::erfc(t / std::sqrt(2.0)), 1.0, 2e-4);
  EXPECT_EQ(student_two_sided(0.0, 5.0), 1.0);
}

TEST(Student, QuantilesOfTheTables) {
  // Two-sided 5%, in every table of the distribution.
  EXPECT_NEAR(student_two_sided(12.7062, 1.0), 0.05, 1e-6);
  EXPECT_NEAR(student_two_sided(2.5706, 5.0), 0.05, 3e-6);
  EXPECT_NEAR(student_two_sided(2.0423, 30.0), 0.05, 6e-6);
  EXPECT_NEAR(student_two_sided(1.9600, 1e7), 0.05, 6e-6);
}

}  // namespace
}  // namespace brume
