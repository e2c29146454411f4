// SPDX-License-Identifier: Apache-2.0
#include "cell.h"

#include <chrono>

#include "core/hash.h"
#include "integrator/path_integrator.h"
#include "io/scene_file.h"
#include "medium/majorant_check.h"

namespace brume::test {

Outcome measure(const Cell& cell, const std::string& scene, int blocks) {
  std::uint64_t seed = 0;
  for (const char c : cell.name + scene.substr(0, scene == cell.like ? 1 : 0))
    seed = hash_combine(seed, std::uint64_t(c));

  const TemporaryFolder folder;
  if (cell.write_files) cell.write_files(folder);
  Notices notices;
  const LoadedScene loaded = load_scene(folder.write("scene.xml", scene), {}, notices);
  const PathIntegrator integrator(*loaded.scene, *loaded.camera, loaded.path);

  Outcome outcome;
  const std::uint64_t violations_before = majorant_violations();
  const auto begin = std::chrono::steady_clock::now();
  for (int r = 0; r < blocks; ++r) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < Sampler::kBlock; ++i) {
      // Blocks of different replications are independent.
      Sampler sampler(seed, 0, std::uint32_t(r) * Sampler::kReplication + i);
      const Vec2 film = cell.central_ray ? Vec2(0.5f) : sampler.next_2d();
      const CameraSample sample = integrator.sample(film, sampler);
      ++outcome.samples;
      if (is_finite_and_non_negative(sample.L) && sample.alpha >= 0.0f && sample.alpha <= 1.0f)
        sum += glm::dvec3(sample.L);
      else
        ++outcome.bad_samples;
    }
    for (int c = 0; c < 3; ++c) outcome.L[c].add(sum[c] / Sampler::kBlock);
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  outcome.seconds = elapsed.count();
  outcome.violations = majorant_violations() - violations_before;
  return outcome;
}

std::vector<Cell> all_cells() {
  std::vector<Cell> cells;
  for (const auto& part :
       {cells_of_coefficients(), cells_of_phase(), cells_of_size(), cells_of_grids(),
        cells_of_views(), cells_of_lights(), cells_of_boundaries(), cells_of_coincidences()})
    cells.insert(cells.end(), part.begin(), part.end());
  return cells;
}

}  // namespace brume::test
