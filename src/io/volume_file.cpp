// SPDX-License-Identifier: Apache-2.0
#include "io/volume_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <glm/vector_relational.hpp>

#include "core/error.h"
#include "io/grid_builder.h"
#include "io/grid_file.h"
#include "io/nearest_name.h"
#include "io/source_file.h"
#include "io/vol_file.h"

namespace brume {
namespace {

enum class Format { kVdb, kNvdb, kVol };

/// By content: names of volume files lie.
Format format_of(const std::string& path) {
  require_file(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail_to_open(path);
  char start[8] = {};
  stream.read(start, sizeof start);
  const std::string_view magic(start, std::size_t(stream.gcount()));
  if (magic.empty()) throw Error(fmt::format("{}: the file is empty", path));
  if (magic == std::string_view(" BDV\0\0\0\0", 8)) return Format::kVdb;
  if (magic == "NanoVDB0") return Format::kNvdb;
  if (magic.starts_with("VOL")) return Format::kVol;
  throw Error(fmt::format(
      "{}: neither a .vdb, nor a .nvdb, nor a .vol file: it begins like none of them", path));
}

std::unique_ptr<GridFile> open_sparse(Format format, const std::string& path) {
  return format == Format::kVdb ? open_vdb_file(path) : open_nvdb_file(path);
}

/// Grids that share a name, or have none, are told apart by their number.
void set_selectors(std::vector<GridSummary>& grids) {
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const auto same_name = [&](const GridSummary& g) { return g.name == grids[i].name; };
    const auto here = grids.begin() + std::ptrdiff_t(i);
    const bool unique = std::count_if(grids.begin(), grids.end(), same_name) == 1;
    grids[i].selector =
        unique && !grids[i].name.empty()
            ? grids[i].name
            : fmt::format("{}[{}]", grids[i].name, std::count_if(grids.begin(), here, same_name));
  }
}

GridSummary summary_of(const std::string& path, const VolHeader& vol) {
  const glm::dvec3 size = (vol.box_max - vol.box_min) / glm::dvec3(vol.resolution);
  const auto voxels = std::uint64_t(vol.resolution.x) * std::uint64_t(vol.resolution.y) *
                      std::uint64_t(vol.resolution.z);
  return {.name = std::filesystem::path(path).stem().string(),
          .value_type = (vol.channels == 3 ? "vec3 " : "") + vol.value_type,
          .grid_class = "dense",
          .channels = vol.channels,
          .extent = GridSummary::Extent{.active_voxels = voxels,
                                        .min = glm::ivec3(0),
                                        .max = vol.resolution - 1,
                                        .memory_bytes = voxels * vol.channels * sizeof(float)},
          .voxel_size = size};
}

std::string listing(const std::vector<GridSummary>& grids) {
  if (grids.empty()) return "The file holds no grids.";
  std::string text = "The file holds";
  for (const GridSummary& grid : grids) text += "\n  " + describe(grid);
  return text;
}

/// The grid named, or nothing; of several with the name the first, and says so.
std::optional<std::size_t> find_named(const std::vector<GridSummary>& grids,
                                      const VolumeRequest& request, Notices& notices) {
  for (std::size_t i = 0; i < grids.size(); ++i)
    if (grids[i].selector == request.grid) return i;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    if (grids[i].name == request.grid) {
      notices.warn(fmt::format("{}: several grids are called \"{}\"; took \"{}\"", request.path,
                               request.grid, grids[i].selector));
      return i;
    }
    if (grids[i].name + "[0]" == request.grid) return i;  // the only one of its name
  }
  return std::nullopt;
}

/// The grid called "density", or the one with these channels if all that have them share a name; of
/// several the first, and says so.
std::optional<std::size_t> find_automatically(const std::vector<GridSummary>& grids, int channels,
                                              const std::string& path, Notices& notices) {
  std::vector<std::size_t> fitting, densities;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    if (grids[i].channels != channels) continue;
    fitting.push_back(i);
    if (grids[i].name == "density") densities.push_back(i);
  }
  const std::vector<std::size_t>& meant = densities.empty() ? fitting : densities;
  const auto is_namesake = [&](std::size_t i) { return grids[i].name == grids[meant[0]].name; };
  if (meant.empty() || !std::all_of(meant.begin(), meant.end(), is_namesake)) return std::nullopt;
  const std::size_t first = meant[0];
  if (meant.size() > 1)
    notices.warn(fmt::format("{}: {} grids are called \"{}\"; took \"{}\"", path, meant.size(),
                             grids[first].name, grids[first].selector));
  return first;
}

/// Which grid to take: a density, or where colours will do as well, one if there is no density.
std::size_t choose(const std::vector<GridSummary>& grids, bool takes_colours,
                   const VolumeRequest& request, Notices& notices) {
  const std::string& path = request.path;
  const char* const wanted =
      takes_colours ? "a density or a colour" : "a density (float or double)";
  if (!request.grid.empty()) {
    const auto named = find_named(grids, request, notices);
    if (!named) {
      std::vector<std::string> selectors;
      for (const GridSummary& grid : grids) selectors.push_back(grid.selector);
      const std::string nearest = nearest_name(request.grid, selectors);
      throw Error(fmt::format(
          "{}: no grid \"{}\"{} {}", path, request.grid,
          nearest.empty() ? "." : fmt::format("; did you mean \"{}\"?", nearest), listing(grids)));
    }
    const int found = grids[*named].channels;
    if (found == 0 || (found == 3 && !takes_colours))
      throw Error(fmt::format("{}: grid \"{}\" is of type {}, which is not {}. {}", path,
                              grids[*named].selector, grids[*named].value_type, wanted,
                              listing(grids)));
    return *named;
  }
  const auto count = [&](int channels) {
    return std::count_if(grids.begin(), grids.end(),
                         [&](const GridSummary& g) { return g.channels == channels; });
  };
  const int channels = takes_colours && count(1) == 0 ? 3 : 1;
  if (const auto found = find_automatically(grids, channels, path, notices)) return *found;
  throw Error(count(channels) > 1
                  ? fmt::format("{}: several grids could be meant; choose one by its name. {}",
                                path, listing(grids))
                  : fmt::format("{}: no grid is {}. {}", path, wanted, listing(grids)));
}

AnyGrid build_vol(const VolumeRequest& request, bool takes_colours, Notices& notices) {
  VolReader vol(request.path);
  if (vol.header().channels == 3 && !takes_colours)
    throw Error(fmt::format(
        "{}: a colour (3 channels a voxel), where a density (1 channel) is needed", request.path));
  if (vol.file_bytes() > vol.header().bytes)
    notices.warn(
        fmt::format("{}: has {} bytes, of which its header makes {}; the rest was not read",
                    request.path, vol.file_bytes(), vol.header().bytes));
  const auto next_layers = [&](int count) { return vol.read_layers(count); };
  if (vol.header().channels == 1)
    return build_grid<float>(vol.header(), next_layers, request, notices);
  return build_grid<Rgb>(vol.header(), next_layers, request, notices);
}

AnyGrid load(const VolumeRequest& request, bool takes_colours, Notices& notices) {
  const Format format = format_of(request.path);
  AnyGrid result;
  with_clear_errors(request.path, [&] {
    if (format == Format::kVol) {
      result = build_vol(request, takes_colours, notices);
      return;
    }
    const auto file = open_sparse(format, request.path);
    std::vector<GridSummary> grids = file->summaries();
    set_selectors(grids);
    const std::size_t index = choose(grids, takes_colours, request, notices);
    const std::string label = fmt::format("{}: grid \"{}\"", request.path, grids[index].selector);
    openvdb::GridBase::Ptr source = file->read(index);
    if (grids[index].channels == 1)
      result = build_grid<float>(std::move(source), label, request, notices);
    else
      result = build_grid<Rgb>(std::move(source), label, request, notices);
  });
  return result;
}

}  // namespace

std::vector<GridSummary> list_grids(const std::string& path) {
  const Format format = format_of(path);
  std::vector<GridSummary> grids;
  with_clear_errors(path, [&] {
    if (format == Format::kVol) {
      grids = {summary_of(path, VolReader(path).header())};
    } else {
      grids = open_sparse(format, path)->summaries();
    }
  });
  set_selectors(grids);
  return grids;
}

std::string describe(const GridSummary& grid) {
  std::string text = fmt::format("{}: {}, {}", grid.selector, grid.value_type, grid.grid_class);
  if (grid.extent && grid.extent->active_voxels == 0) text += ", empty";
  if (grid.extent && grid.extent->active_voxels > 0) {
    const glm::ivec3 lo = grid.extent->min, hi = grid.extent->max;
    text += fmt::format(", {} active voxels in [{}, {}, {}] .. [{}, {}, {}]",
                        grid.extent->active_voxels, lo.x, lo.y, lo.z, hi.x, hi.y, hi.z);
  }
  if (grid.voxel_size) {
    const glm::dvec3 v = *grid.voxel_size;
    const bool cubic = glm::all(glm::lessThan(glm::abs(v - v.x), glm::dvec3(1e-6 * v.x)));
    text += cubic ? fmt::format(", voxel size {:.4g}", v.x)
                  : fmt::format(", voxel size {:.4g} x {:.4g} x {:.4g}", v.x, v.y, v.z);
  }
  return text;
}

std::shared_ptr<const Grid<float>> load_scalar_grid(const VolumeRequest& request,
                                                    Notices& notices) {
  return std::get<0>(load(request, /*takes_colours=*/false, notices));
}

AnyGrid load_grid(const VolumeRequest& request, Notices& notices) {
  return load(request, /*takes_colours=*/true, notices);
}

}  // namespace brume
