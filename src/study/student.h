// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brume {

/// Probability that a Student t variable with `degrees` > 0 of freedom lies beyond `t` on either
/// side. Fractions of a degree are allowed; from 1e6 on it is the normal distribution.
double student_two_sided(double t, double degrees);

/// The t that `student_two_sided` takes to `probability` in (0, 1).
double student_quantile(double probability, double degrees);

}  // namespace brume
