// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/rgb.h"

namespace brume {

/// Values at increasing wavelengths, linear between them and zero outside; or one value for all
/// wavelengths, in which case `wavelengths_nm` is empty.
struct Spectrum {
  std::vector<double> wavelengths_nm;
  std::vector<double> values;

  bool is_uniform() const { return wavelengths_nm.empty(); }
};

/// Linear Rec. 709 of light with this spectral power; components may be negative (out of gamut).
/// Equal energy v at all wavelengths is v (1.2048, 0.9483, 0.9089): white in Rec. 709 is D65.
glm::dvec3 emission_to_rgb(const Spectrum& spectrum);

/// Linear Rec. 709 of a surface or medium with this spectrum, seen under D65; components may be
/// negative. A uniform spectrum v is (v, v, v).
glm::dvec3 reflectance_to_rgb(const Spectrum& spectrum);

}  // namespace brume
