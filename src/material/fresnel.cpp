// SPDX-License-Identifier: Apache-2.0
#include "material/fresnel.h"

#include <algorithm>
#include <cmath>

namespace brume {

DielectricFresnel fresnel_dielectric(float cos_i, float eta) {
  const float eta_it = cos_i >= 0.0f ? eta : 1.0f / eta;
  if (eta_it == 1.0f) return {.R = 0.0f, .cos_t = -cos_i, .eta = 1.0f};
  const float c_i = std::min(std::abs(cos_i), 1.0f);
  const float sin2_t = (1.0f - c_i) * (1.0f + c_i) / (eta_it * eta_it);  // Snell's law
  if (sin2_t >= 1.0f) return {.R = 1.0f, .cos_t = 0.0f, .eta = eta_it};
  const float c_t = std::sqrt(1.0f - sin2_t);
  // Born and Wolf 1999, section 1.5.2, eq. 21; the mean of both polarisations.
  const float r_s = (c_i - eta_it * c_t) / (c_i + eta_it * c_t);
  const float r_p = (c_t - eta_it * c_i) / (c_t + eta_it * c_i);
  return {.R = 0.5f * (r_s * r_s + r_p * r_p), .cos_t = cos_i >= 0.0f ? -c_t : c_t, .eta = eta_it};
}

namespace {

/// Born and Wolf 1999, section 14.2, with the complex cosine of refraction written as a + i b,
/// scaled by the index: (a + i b)^2 = (eta + i k)^2 - sin^2.
float fresnel_conductor(float cos_i, float eta, float k) {
  const float cos2 = cos_i * cos_i;
  const float sin2 = (1.0f - cos_i) * (1.0f + cos_i);
  const float real = (eta - 1.0f) * (eta + 1.0f) - k * k + cos2;  // eta^2 - k^2 - sin^2
  const float norm = std::hypot(real, 2.0f * eta * k);            // a^2 + b^2
  const float a = std::sqrt(std::max(0.0f, 0.5f * (norm + real)));
  const float s_sum = norm + cos2, s_cross = 2.0f * cos_i * a;
  if (!(s_sum > 0.0f)) return 0.0f;  // along a surface to which the index does not change
  const float R_s = (s_sum - s_cross) / (s_sum + s_cross);
  const float p_sum = norm * cos2 + sin2 * sin2, p_cross = s_cross * sin2;
  // An index of 0 reflects everything; there the quotient is 0/0 at normal incidence.
  if (!(p_sum + p_cross > 0.0f)) return 1.0f;
  const float R_p = R_s * (p_sum - p_cross) / (p_sum + p_cross);
  return std::max(0.5f * (R_s + R_p), 0.0f);  // by rounding it may be less
}

}  // namespace

Rgb fresnel_conductor(float cos_i, const Rgb& eta, const Rgb& k) {
  const float c = std::clamp(cos_i, 0.0f, 1.0f);
  return {fresnel_conductor(c, eta.r, k.r), fresnel_conductor(c, eta.g, k.g),
          fresnel_conductor(c, eta.b, k.b)};
}

float diffuse_fresnel_reflectance(float eta) {
  // Below the critical angle the reflectance is smooth but for a square root at its end, above it
  // is 1: the integral of R dcos^2 over a fine midpoint rule in cos^2 is good to 1e-6.
  constexpr int kSteps = 4096;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double cos2 = (i + 0.5) / kSteps;
    sum += double(fresnel_dielectric(float(std::sqrt(cos2)), eta).R);
  }
  return float(sum / kSteps);
}

}  // namespace brume
