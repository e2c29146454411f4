// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "media.h"
#include "noise.h"

namespace brume::media {
namespace {

// A cumulus is a heap of rising bubbles: each throws smaller ones from its upper side. The heap of
// spheres gives the towers; bumps of falling size, pushed around by turbulence, give the florets.
// y is up.

constexpr glm::ivec3 kSize(256, 168, 192);  // [voxels]
constexpr double kVoxel = 0.78;             // all other lengths are in units of 1 / kVoxel voxels
constexpr double kBase = 14.0;              // height of the flat underside

struct Bubble {
  Vec3 center;
  double radius;
};

class Random {
 public:
  double next() { return unit(hash({counter_++, 0, 0}, 77)); }
  double between(double lo, double hi) { return lo + (hi - lo) * next(); }
  Vec3 direction() {
    const double y = between(-1.0, 1.0), angle = between(0.0, 6.283185307179586);
    const double r = std::sqrt(1.0 - y * y);
    return {r * std::cos(angle), y, r * std::sin(angle)};
  }

 private:
  int counter_ = 0;
};

void grow(const Bubble& parent, int generations, Random& random, std::vector<Bubble>& heap) {
  heap.push_back(parent);
  if (generations == 0) return;
  const int children = int(random.between(7.0, 11.0));
  for (int i = 0; i < children; ++i) {
    Vec3 d = random.direction();
    if (d.y < -0.15) d.y = -d.y;
    d = glm::normalize(d + Vec3(0.0, 0.25, 0.0));
    const double radius = parent.radius * random.between(0.36, 0.62);
    const Vec3 center = parent.center + d * (parent.radius * random.between(0.8, 1.02));
    if (center.y - 0.3 * radius < kBase) continue;
    grow({center, radius}, generations - 1, random, heap);
  }
}

std::vector<Bubble> make_heap() {
  Random random;
  std::vector<Bubble> heap;
  const Bubble towers[] = {
      {{100, 40, 84}, 33}, {{94, 64, 80}, 27},   {{62, 30, 78}, 22}, {{140, 32, 92}, 25},
      {{146, 46, 84}, 19}, {{112, 26, 112}, 20}, {{36, 22, 88}, 12}, {{172, 24, 84}, 13},
      {{84, 26, 56}, 18},  {{124, 24, 62}, 16},
  };
  for (const Bubble& tower : towers) grow(tower, 3, random, heap);
  return heap;
}

/// Signed distance to the union of the bubbles, up to `kReach` outside.
DenseGrid<float> distance_to(const std::vector<Bubble>& heap) {
  constexpr double kReach = 14.0;
  DenseGrid<float> distance(kSize, float(kReach));
  for (const Bubble& b : heap) {
    const double reach = b.radius + kReach;
    const glm::ivec3 lo = glm::max(glm::ivec3((b.center - reach) / kVoxel), glm::ivec3(0));
    const glm::ivec3 hi = glm::min(glm::ivec3((b.center + reach) / kVoxel), kSize - 1);
    for (int z = lo.z; z <= hi.z; ++z)
      for (int y = lo.y; y <= hi.y; ++y)
        for (int x = lo.x; x <= hi.x; ++x)
          distance(x, y, z) = std::min(
              distance(x, y, z), float(glm::length(kVoxel * Vec3(x, y, z) - b.center) - b.radius));
  }
  return distance;
}

float trilinear(const DenseGrid<float>& grid, Vec3 p, float outside) {
  p /= kVoxel;
  const Vec3 floor = glm::floor(p);
  const glm::ivec3 i(floor);
  const Vec3 f = p - floor;
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 c(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::ivec3 q = i + c;
    const double w = (c.x ? f.x : 1.0 - f.x) * (c.y ? f.y : 1.0 - f.y) * (c.z ? f.z : 1.0 - f.z);
    sum += w * (grid.contains(q.x, q.y, q.z) ? grid(q.x, q.y, q.z) : outside);
  }
  return float(sum);
}

double density_at(const Vec3& p, const DenseGrid<float>& distance) {
  // Turbulence bends the towers and tears their edges.
  const Vec3 bent =
      p + 5.0 * perlin_vector(p / 42.0, 2, 0.5, 11) + 1.6 * perlin_vector(p / 11.0, 2, 0.5, 31);
  double d = trilinear(distance, bent, 14.0f);
  if (d > 13.0) return 0.0;

  // Florets: outward bumps whose size falls with each octave.
  d -= 7.5 * (bumps(bent / 17.0, 3) - 0.45);
  d -= 4.4 * (bumps(bent / 8.5, 7) - 0.45);
  d -= 2.4 * (bumps(bent / 4.4, 13) - 0.45);
  d -= 1.1 * (bumps(p / 2.3, 17) - 0.45);

  // The underside evaporates along a nearly flat, ragged level.
  const double rag = 3.0 * perlin_octaves(p / 26.0, 4, 0.55, 57);
  const double above_base = p.y - (kBase + rag);
  d = std::max(d, -above_base * 0.6);

  // Edges are crisp where air rises and frayed where it sinks and mixes.
  const double height = smooth_step(kBase, 70.0, p.y);
  const double edge = glm::mix(6.0, 1.3, height);
  double density = smooth_step(0.0, edge, -d);
  const double fray = 0.5 + 0.5 * perlin_octaves(bent / 7.0, 4, 0.6, 91);
  density *= glm::mix(smooth_step(0.15, 0.75, fray), 1.0, smooth_step(0.0, edge * 1.8, -d));

  // Liquid water grows with height and with depth inside.
  const double core = smooth_step(0.0, 16.0, -d);
  return density * glm::mix(0.45, 1.0, core) * glm::mix(0.55, 1.0, height);
}

/// Shreds of cloud that have come loose around it.
double shreds_at(const Vec3& p, const DenseGrid<float>& distance) {
  const double d = trilinear(distance, p, 14.0f);
  const double near = (1.0 - smooth_step(4.0, 13.5, d)) *
                      smooth_step(kBase - 4.0, kBase + 8.0, p.y) *
                      (1.0 - smooth_step(44.0, 84.0, p.y));
  if (near <= 0.0) return 0.0;
  const Vec3 bent = p + 6.0 * perlin_vector(p / 20.0, 3, 0.55, 131);
  const double shred = perlin_octaves(bent / Vec3(24.0, 13.0, 24.0), 5, 0.55, 151);
  return 0.16 * near * smooth_step(0.22, 0.62, shred);
}

}  // namespace

DenseGrid<float> make_cloud() {
  const DenseGrid<float> distance = distance_to(make_heap());
  DenseGrid<float> density(kSize);
  density.for_each([&](int x, int y, int z) {
    const Vec3 p = kVoxel * Vec3(x, y, z);
    density(x, y, z) = float(std::max(density_at(p, distance), shreds_at(p, distance)));
  });
  return density;
}

}  // namespace brume::media
