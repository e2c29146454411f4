// SPDX-License-Identifier: Apache-2.0
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "fluid.h"
#include "media.h"
#include "noise.h"

namespace brume::media {
namespace {

constexpr glm::ivec3 kSize(56, 112, 56);  // [voxels], y up
constexpr int kSteps = 110;
constexpr glm::vec3 kWarm(0.95f, 0.62f, 0.34f), kCool(0.42f, 0.62f, 0.90f);  // linear Rec. 709

/// Two glowing discs on the floor. Their edges flicker, so that the plumes break up.
void feed(DenseGrid<glm::vec3>& carried, int step) {
  constexpr double kWidth = kSize.x;
  constexpr double kRadius = 0.1 * kWidth;
  const Vec3 centers[] = {{0.38 * kWidth, 3.0, 0.46 * kWidth}, {0.62 * kWidth, 3.0, 0.54 * kWidth}};
  for (int smoke = 0; smoke < 2; ++smoke)
    for (int z = 0; z < kSize.z; ++z)
      for (int y = 0; y < 6; ++y)
        for (int x = 0; x < kSize.x; ++x) {
          const Vec3 d = Vec3(x, y, z) - centers[smoke];
          const double r = glm::length(Vec3(d.x, 2.0 * d.y, d.z)) / kRadius;
          if (r > 1.6) continue;
          const double flicker =
              perlin_octaves(Vec3(x, y + 0.9 * step, z) / 7.0, 3, 0.6, 307 + 50 * smoke);
          const float fresh = float(1.0 - smooth_step(0.6, 1.0, r + 0.55 * flicker));
          glm::vec3& c = carried(x, y, z);
          c[smoke] = glm::max(c[smoke], fresh);
          c.z = glm::max(c.z, fresh);
        }
}

}  // namespace

Smoke make_smoke() {
  Fluid fluid(kSize);
  for (int step = 0; step < kSteps; ++step) {
    feed(fluid.carried(), step);
    fluid.step(/*acceleration=*/0.09f, /*smoke_weight=*/0.05f, /*whirl=*/0.08f);
    fluid.carried().for_each([&](int x, int y, int z) {
      // Smoke disperses slowly, heat radiates away faster.
      fluid.carried()(x, y, z) *= glm::vec3(0.997f, 0.997f, 0.988f);
    });
  }

  Smoke smoke{DenseGrid<float>(kSize), DenseGrid<float>(kSize), DenseGrid<glm::vec3>(kSize)};
  const DenseGrid<glm::vec3>& carried = fluid.carried();
  carried.for_each([&](int x, int y, int z) {
    const glm::vec3 c = glm::max(carried(x, y, z), 0.0f);
    const float density = c.x + c.y;
    // Fades out below the open top, where the smoke would end in a plane.
    const float fade = 1.0f - float(smooth_step(0.86, 1.0, y / double(kSize.y - 1)));
    smoke.density(x, y, z) = glm::min(density, 1.0f) * fade;
    smoke.temperature(x, y, z) = glm::min(c.z, 1.0f) * fade;
    smoke.albedo(x, y, z) = glm::mix(kCool, kWarm, (c.x + 1e-4f) / (density + 2e-4f));
  });
  return smoke;
}

}  // namespace brume::media
