// SPDX-License-Identifier: Apache-2.0
#include "medium/similar_medium.h"

namespace brume {
namespace {

class SimilarMedium final : public Medium {
 public:
  SimilarMedium(std::shared_ptr<const Medium> exact, std::shared_ptr<const Medium> similar)
      : exact_(std::move(exact)), similar_(std::move(similar)) {}

  FreeFlight sample_free_flight(const Ray& ray, float t_max, const Rgb& beta,
                                Sampler& sampler) const override {
    return exact_->sample_free_flight(ray, t_max, beta, sampler);
  }
  Rgb transmittance(const Ray& ray, float t_max, Rng& rng) const override {
    return exact_->transmittance(ray, t_max, rng);
  }
  std::optional<float> probability_of_scattering(const Ray& ray, float t_max,
                                                 const Rgb& beta) const override {
    return exact_->probability_of_scattering(ray, t_max, beta);
  }
  FreeFlight sample_scattering(const Ray& ray, float t_max, const Rgb& beta,
                               Sampler& sampler) const override {
    return exact_->sample_scattering(ray, t_max, beta, sampler);
  }
  std::optional<ScatteringAt> scattering_at(const Ray& ray, float t,
                                            const Rgb& beta) const override {
    return exact_->scattering_at(ray, t, beta);
  }
  const Medium& similar() const override { return *similar_; }
  MediumSummary summary() const override { return exact_->summary(); }

 private:
  std::shared_ptr<const Medium> exact_, similar_;
};

}  // namespace

SimilarCoefficients similar_coefficients(const Rgb& albedo, float g) {
  const Rgb scale = 1.0f - g * albedo;
  Rgb similar_albedo{0.0f};
  for (int c = 0; c < 3; ++c)
    if (scale[c] > 0.0f) similar_albedo[c] = albedo[c] * (1.0f - g) / scale[c];
  return {.extinction_scale = scale, .albedo = similar_albedo};
}

std::shared_ptr<const Medium> make_similar_medium(std::shared_ptr<const Medium> exact,
                                                  std::shared_ptr<const Medium> similar) {
  return std::make_shared<SimilarMedium>(std::move(exact), std::move(similar));
}

}  // namespace brume
