// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string>

namespace brume::test {

/// A number that brume must reproduce.
struct Law {
  std::string name;    // what is measured, in words
  std::string source;  // where `expected` comes from
  double expected;
  double expected_error = 0.0;        // its standard error when it is a measurement itself
  double max_relative_error = 0.002;  // of the standard error of brume's value to `expected`
  double max_z = 4.0;                 // a pass with fixed seeds stays a pass
};

namespace detail {
/// Appends one line of a table, tab-separated, to the file that BRUME_VALIDATION_ROWS names. One
/// write, so that tests that run at the same time do not mix their lines.
inline void append_validation_row(const Law& law, double value, double standard_error, double z) {
  const char* path = std::getenv("BRUME_VALIDATION_ROWS");
  if (path == nullptr) return;
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  std::ostringstream row;
  row << law.name << '\t' << law.source << '\t' << std::setprecision(7) << law.expected << '\t'
      << value << '\t' << standard_error << '\t' << z << '\t' << test->test_suite_name() << '.'
      << test->name() << '\n';
  std::ofstream(path, std::ios::app) << row.str() << std::flush;
}
}  // namespace detail

/// Checks brume's `value` against the law: within `max_z` standard errors, which are small enough
/// to tell. Records it for docs/validation.md.
inline void expect_law(const Law& law, double value, double standard_error) {
  const double z = (value - law.expected) / std::hypot(standard_error, law.expected_error);
  EXPECT_LT(std::abs(z), law.max_z)
      << law.name << ": " << value << " +- " << standard_error << " where " << law.expected
      << " is expected (" << law.source << ")";
  EXPECT_LE(standard_error, law.max_relative_error * std::abs(law.expected))
      << law.name << ": the error bar is too wide to tell";
  detail::append_validation_row(law, value, standard_error, z);
}

}  // namespace brume::test
