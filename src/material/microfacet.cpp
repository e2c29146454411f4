// SPDX-License-Identifier: Apache-2.0
#include "material/microfacet.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/warp.h"

namespace brume {

namespace {

constexpr float kMinAlpha = 1e-4f;
constexpr double kInvSqrtPi = 0.56418958354775628695;

/// Inverse error function, |x| < 1 (Giles 2010, single precision).
float erf_inv(float x) {
  float w = -std::log((1.0f - x) * (1.0f + x));
  float p;
  if (w < 5.0f) {
    w -= 2.5f;
    p = 2.81022636e-08f;
    p = 3.43273939e-07f + p * w;
    p = -3.5233877e-06f + p * w;
    p = -4.39150654e-06f + p * w;
    p = 0.00021858087f + p * w;
    p = -0.00125372503f + p * w;
    p = -0.00417768164f + p * w;
    p = 0.246640727f + p * w;
    p = 1.50140941f + p * w;
  } else {
    w = std::sqrt(w) - 3.0f;
    p = -0.000200214257f;
    p = 0.000100950558f + p * w;
    p = 0.00134934322f + p * w;
    p = -0.00367342844f + p * w;
    p = 0.00573950773f + p * w;
    p = -0.0076224613f + p * w;
    p = 0.00943887047f + p * w;
    p = 1.00167406f + p * w;
    p = 2.83297682f + p * w;
  }
  return p * x;
}

/// Slope with the density exp(-x^2) / sqrt(pi) of Gaussian roughness 1.
float sample_slope(float u) {
  return erf_inv(std::clamp(2.0f * u - 1.0f, -kOneMinusEpsilon, kOneMinusEpsilon));
}

/// Slope toward a viewer at `tan_theta`, for roughness 1: density proportional to
/// max(0, 1 - x tan_theta) exp(-x^2), inverted numerically (Heitz and d'Eon 2014, section 5).
/// The quantile falls from that at normal incidence to that at grazing incidence, both known in
/// closed form, as tan_theta grows; Newton's method runs between the two.
float sample_visible_slope(double tan_theta, float u) {
  const auto cdf = [&](double x) {  // not normalised
    return 0.5 * std::erfc(-x) + 0.5 * kInvSqrtPi * tan_theta * std::exp(-x * x);
  };
  const double largest_slope = 1.0 / tan_theta;
  const double want = std::max(double(u), 1e-12) * cdf(largest_slope);
  // The margins cover the rounding of both quantiles.
  double low = -std::sqrt(-std::log(std::max(double(u), 1e-12))) - 1e-4;
  double high = std::min(double(sample_slope(u)) + 1e-4, largest_slope);
  double x = (high + tan_theta * low) / (1.0 + tan_theta);
  for (int i = 0; i < 60; ++i) {
    const double error = cdf(x) - want;
    (error > 0.0 ? high : low) = x;
    double next = x - error / (kInvSqrtPi * (1.0 - x * tan_theta) * std::exp(-x * x));
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double step = std::abs(next - x);
    x = next;
    if (step < 1e-7) break;
  }
  return float(x);
}

}  // namespace

Microfacets::Microfacets(MicrofacetType type, float alpha_u, float alpha_v)
    : type_(type), alpha_u_(std::max(alpha_u, kMinAlpha)), alpha_v_(std::max(alpha_v, kMinAlpha)) {}

float Microfacets::D(const Vec3& m) const {
  if (!(m.z > 0.0f)) return 0.0f;
  const float x = m.x / alpha_u_, y = m.y / alpha_v_;
  const float scale = kPi * alpha_u_ * alpha_v_;
  if (type_ == MicrofacetType::kBeckmann) {  // Walter et al. 2007, eq. 25
    const float cos2 = m.z * m.z;
    const float gaussian = std::exp(-(x * x + y * y) / cos2);
    return gaussian > 0.0f ? gaussian / (scale * cos2 * cos2) : 0.0f;
  }
  const float s = x * x + y * y + m.z * m.z;  // Walter et al. 2007, eq. 33
  return 1.0f / (scale * s * s);
}

float Microfacets::G1(const Vec3& v, const Vec3& m) const {
  if (!(glm::dot(v, m) * v.z > 0.0f)) return 0.0f;
  const float x = alpha_u_ * v.x, y = alpha_v_ * v.y;
  const float slope2 = (x * x + y * y) / (v.z * v.z);  // alpha^2 tan^2
  if (type_ == MicrofacetType::kGgx) return 2.0f / (1.0f + std::sqrt(1.0f + slope2));
  // Exact Lambda of Heitz 2014, eq. 66; a rational fit would leave the density of visible normals
  // 0.3% short of normalised.
  const float a = 1.0f / std::sqrt(slope2);
  const float lambda = 0.5f * (float(kInvSqrtPi) * std::exp(-a * a) / a - std::erfc(a));
  return 1.0f / (1.0f + std::max(0.0f, lambda));
}

Vec3 Microfacets::sample_visible(const Vec3& wo, const Vec2& u) const {
  assert(wo.z > 0.0f);
  // Stretched so that the roughness becomes 1 (Heitz and d'Eon 2014, section 4).
  const Vec3 v = glm::normalize(Vec3(alpha_u_ * wo.x, alpha_v_ * wo.y, wo.z));
  if (type_ == MicrofacetType::kGgx) {
    // Reflections off the stretched hemisphere fill a spherical cap (Dupuy and Benyoub 2023).
    const float z = std::max(-1.0f, (1.0f - u.x) * (1.0f + v.z) - v.z);
    const float r = std::sqrt(std::max(0.0f, (1.0f - z) * (1.0f + z)));
    const Vec3 h = spherical_direction(r, z, 2.0f * kPi * u.y) + v;
    return glm::normalize(Vec3(alpha_u_ * h.x, alpha_v_ * h.y, std::max(1e-12f, h.z)));
  }
  const float sin_theta = std::hypot(v.x, v.y);
  const Vec2 toward = sin_theta > 0.0f ? Vec2(v.x, v.y) / sin_theta : Vec2(1.0f, 0.0f);
  const float slope = sample_visible_slope(double(sin_theta) / double(v.z), u.x);
  const float slope_across = sample_slope(u.y);
  const float slope_x = alpha_u_ * (toward.x * slope - toward.y * slope_across);
  const float slope_y = alpha_v_ * (toward.y * slope + toward.x * slope_across);
  return glm::normalize(Vec3(-slope_x, -slope_y, 1.0f));
}

float Microfacets::pdf_visible(const Vec3& wo, const Vec3& m) const {
  return D(m) * G1(wo, m) * std::abs(glm::dot(wo, m) / wo.z);
}

float Microfacets::pdf_reflection(const Vec3& wo, const Vec3& wi) const {
  const Vec3 m = glm::normalize(wo + wi);
  return D(m) * G1(wo, m) / (4.0f * wo.z);  // Walter et al. 2007, eq. 14, is the Jacobian
}

float Microfacets::mirror_lobe() const {
  // Facets at an angle theta to the mean send light 2 theta beside the mirror direction; for small
  // ones theta^2 is alpha^2 on average, and the cosine 1 - 2 alpha^2. Twice that is wide enough,
  // and four times for the tails of GGX.
  constexpr float kMost = 0.99f;
  const float alpha = std::max(alpha_u_, alpha_v_);
  return std::min(std::exp((type_ == MicrofacetType::kGgx ? -8.0f : -4.0f) * alpha * alpha), kMost);
}

}  // namespace brume
