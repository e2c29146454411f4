// SPDX-License-Identifier: Apache-2.0
#include "scene/requirements.h"

#include <fmt/format.h>

#include <algorithm>

namespace brume {
namespace {

std::vector<const Medium*> media_of(const SceneParts& parts) {
  std::vector<const Medium*> media;
  const auto add = [&](const std::shared_ptr<const Medium>& medium) {
    if (medium != nullptr && std::find(media.begin(), media.end(), medium.get()) == media.end())
      media.push_back(medium.get());
  };
  add(parts.world_medium);
  for (const Surface& surface : parts.surfaces) {
    add(surface.interior);
    add(surface.exterior);
  }
  return media;
}

std::string count(std::size_t n, const char* thing) {
  return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

}  // namespace

std::vector<Requirement> requirements_of(const SceneParts& parts) {
  const std::vector<const Medium*> media = media_of(parts);
  const auto emitters = std::count_if(parts.surfaces.begin(), parts.surfaces.end(),
                                      [](const Surface& s) { return s.radiance.has_value(); });
  const std::size_t lights =
      parts.lights.size() + parts.environments.size() + std::size_t(emitters);
  const auto media_with = [&](bool MediumSummary::*trait) {
    return std::size_t(std::count_if(media.begin(), media.end(), [&](const Medium* medium) {
      return medium->summary().*trait;
    }));
  };
  const std::size_t tracked = media_with(&MediumSummary::is_tracked);
  const std::size_t scattering = media_with(&MediumSummary::scatters);
  const std::size_t chromatic = media_with(&MediumSummary::is_chromatic);

  std::vector<Requirement> list = {
      {"surfaces (Embree)", !parts.surfaces.empty(), count(parts.surfaces.size(), "shape")},
      {"media", !media.empty(),
       media.size() == 1 ? "1 medium" : fmt::format("{} media", media.size())},
      {"scattering in media", scattering > 0,
       fmt::format("{} of {} scatter", scattering, media.size())},
      {"null-collision tracking", tracked > 0,
       fmt::format("{} of {} vary in space; the others are in closed form", tracked, media.size())},
      {"chromatic tracking", chromatic > 0,
       fmt::format("in {} of {} the channels travel different distances", chromatic, media.size())},
      {"light sampling", lights > 0,
       fmt::format("{}, of which {} at infinity", count(lights, "light"),
                   parts.environments.size())},
  };
  for (const Medium* medium : media) {
    const MediumSummary summary = medium->summary();
    list.push_back({fmt::format("medium, {:.1f} MB", 1e-6 * double(summary.memory_bytes)), true,
                    summary.description, summary.memory_bytes});
  }
  return list;
}

}  // namespace brume
