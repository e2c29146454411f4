// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "medium/medium.h"

namespace brume {

/// Coefficients under which isotropic scattering spreads light, after many scatterings, as
/// scattering with mean cosine g does: sigma_s' = (1 - g) sigma_s with sigma_a unchanged
/// (similarity relation, Hulst 1980, section 14.1).
struct SimilarCoefficients {
  Rgb extinction_scale;  // sigma_t' / sigma_t
  Rgb albedo;            // sigma_s' / sigma_t'
};
SimilarCoefficients similar_coefficients(const Rgb& albedo, float g);

/// `exact`, which has `similar` at hand for the light that has scattered often.
std::shared_ptr<const Medium> make_similar_medium(std::shared_ptr<const Medium> exact,
                                                  std::shared_ptr<const Medium> similar);

}  // namespace brume
