// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace brume {

/// Probability that a Student t variable with `degrees` > 0 of freedom lies beyond `t` on either
/// side. Fractions of a degree are allowed; from 1e6 on it is the normal distribution.
double student_two_sided(double t, double degrees);

}  // namespace brume
