// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstring>

#include "cell.h"
#include "scene_text.h"
#include "support/scene_files.h"

// Grids of one voxel and of a million in a row, of slivers, of nothing.

namespace brume::test {
namespace {

using Writer = std::function<void(const TemporaryFolder&)>;

template <class F>
Writer writes_vol(const glm::ivec3& n, F value) {
  return [=](const TemporaryFolder& folder) {
    folder.write("grid.vol",
                 vol_bytes(n, 1, [&](int x, int y, int z, int) { return value(x, y, z); }));
  };
}

/// The same in half precision: `bits` of the float16 for each voxel in turn.
Writer writes_half_vol(std::vector<std::uint16_t> bits) {
  return [bits](const TemporaryFolder& folder) {
    std::string bytes =
        vol_bytes({int(bits.size()), 1, 1}, 1, [](int, int, int, int) { return 0; });
    bytes.resize(48);
    bytes[4] = 2;  // encoding
    for (const std::uint16_t b : bits) {
      bytes += char(b & 0xff);
      bytes += char(b >> 8);
    }
    folder.write("grid.vol", bytes);
  };
}

struct GridCase {
  std::string axis, name;
  double at;
  Writer write_files;
  glm::dvec3 lo, hi;
  double scale, mean_density;  // along the x axis
  std::string filter = "trilinear";
};

/// Furnace, and Beer-Lambert along the x axis through the middle.
void add(std::vector<Cell>& cells, const GridCase& c) {
  const glm::dvec3 center = 0.5 * (c.lo + c.hi), size = c.hi - c.lo;
  const std::string volume = vol_volume("grid.vol", c.lo, c.hi, c.filter);
  // Off the middle, so that no ray runs between voxels.
  const glm::dvec3 from = center + glm::dvec3(-size.x, 0.1 * size.y, 0.1 * size.z);
  cells.push_back(
      {.axis = c.axis + ", Beer-Lambert",
       .at = c.at,
       .name = c.name + "Beer",
       .scene = scene(camera({.origin = from, .target = from + glm::dvec3(size.x, 0, 0)}) +
                      heterogeneous(volume, c.scale, "0", 0) + environment()),
       .write_files = c.write_files,
       .central_ray = true,
       .want = glm::dvec3(std::exp(-c.mean_density * c.scale * size.x)),
       .rounding = 1e-4});
  cells.push_back(
      {.axis = c.axis + ", furnace",
       .at = c.at,
       .name = c.name + "Furnace",
       .scene = scene(camera({.origin = center - 1.5 * size, .target = center, .fov_deg = 10}) +
                      heterogeneous(volume, c.scale, "1", 0.3) + environment()),
       .write_files = c.write_files,
       .want = glm::dvec3(1.0)});
}

}  // namespace

std::vector<Cell> cells_of_grids() {
  std::vector<Cell> cells;
  const glm::dvec3 lo(0.0), hi(1.0);
  const auto one = [](int, int, int) { return 1.0; };
  const auto ramp = [](int x, int, int) { return double(x); };
  const auto alternating = [](double a, double b) {
    return [=](int x, int, int) { return x % 2 == 0 ? a : b; };
  };

  for (const char* filter : {"trilinear", "nearest"}) {
    const std::string suffix = filter[0] == 't' ? "" : "Nearest";
    add(cells, {"voxels in a row", "OneVoxel" + suffix, 1, writes_vol({1, 1, 1}, one), lo, hi, 2, 1,
                filter});
    add(cells, {"voxels in a row", "Row1024" + suffix, 1 << 10,
                writes_vol({1 << 10, 1, 1}, alternating(0, 2)), lo, hi, 2, 1, filter});
    add(cells, {"voxels in a row", "Row131072" + suffix, 1 << 17,
                writes_vol({1 << 17, 1, 1}, alternating(0, 2)), lo, hi, 2, 1, filter});
    // The mean 1 in single voxels, so that only they take memory.
    add(cells, {"voxels in a row", "Row1048576" + suffix, 1 << 20,
                writes_vol({1 << 20, 1, 1},
                           [](int x, int, int) { return x % 4096 == 100 ? 4096.0 : 0.0; }),
                lo, hi, 2, 1, filter});
    const auto add_stretched = [&](const char* name, const glm::dvec3& size) {
      add(cells, {"length of a voxel over its width", name + suffix, size.x / size.y,
                  writes_vol({8, 8, 8}, ramp), lo, size, 1.0 / size.x, 3.5, filter});
    };
    add_stretched("Sliver1000", {1e3, 1, 1});
    add_stretched("Sliver1000000", {1e6, 1, 1});
    add_stretched("Flat1000", {1, 1000, 1000});
    add(cells, {"contrast of neighbours", "Contrast1e30" + suffix, 1e30,
                writes_vol({16, 2, 2}, alternating(1e-30, 2)), lo, hi, 1, 1, filter});
    add(cells, {"contrast of neighbours", "Contrast1e4" + suffix, 1e4,
                writes_vol({16, 2, 2}, alternating(1e-4, 2)), lo, hi, 1, 1.00005, filter});
    add(cells, {"contrast of neighbours", "Spike" + suffix, 1e6,
                writes_vol({101, 3, 3}, [](int x, int, int) { return x == 50 ? 101.0 : 1e-6; }), lo,
                hi, 1, 1.0, filter});
    add(cells, {"values", "Empty" + suffix, 0,
                writes_vol({5, 4, 3}, [](int, int, int) { return 0; }), lo, hi, 1, 0, filter});
    add(cells,
        {"values", "Constant" + suffix, 1, writes_vol({64, 64, 64}, one), lo, hi, 2, 1, filter});
    // Smallest subnormal, smallest normal, 1, largest float16.
    add(cells, {"values", "HalfTiny" + suffix, 6e-8, writes_half_vol({1, 1, 1, 1}), lo, hi, 1 << 24,
                0x1p-24, filter});
    add(cells,
        {"values", "HalfHuge" + suffix, 65504, writes_half_vol({0x7bff, 0x7bff, 0x0001, 0x7bff}),
         lo, hi, 2.0 / 65504, 49128, filter});
    add(cells, {"values", "Float1e30" + suffix, 1e30, writes_vol({4, 4, 4}, alternating(0, 1e30)),
                lo, hi, 4e-30, 5e29, filter});
    add(cells, {"values", "Float1em30" + suffix, 1e-30,
                writes_vol({4, 4, 4}, alternating(0, 1e-30)), lo, hi, 4e30, 5e-31, filter});
    add(cells, {"values", "Denormal" + suffix, 1e-42, writes_vol({4, 4, 4}, one), lo, hi, 1e-42, 1,
                filter});
  }

  for (const int exponent : {-15, -6, -3, 3, 6, 9, 15}) {
    const double size = std::pow(10.0, exponent);
    add(cells,
        {"size of a grid", fmt::format("GridSize{}{}", exponent < 0 ? "m" : "", std::abs(exponent)),
         size, writes_vol({8, 8, 8}, ramp), lo, glm::dvec3(size), 1.0 / size, 3.5});
  }

  // Mirrored, rotated and sheared: along the ramp through the middle.
  struct Placement {
    const char *name, *transform;
    glm::dvec3 axis;  // image of the x axis
  };
  const Placement placements[] = {
      {"MirroredX", "<scale x=\"-1\"/><translate x=\"1\"/>", {-1, 0, 0}},
      {"MirroredXyz", "<scale value=\"-1\"/><translate value=\"1,1,1\"/>", {-1, 0, 0}},
      {"Turned",
       "<translate value=\"-0.5,-0.5,-0.5\"/><rotate z=\"1\" angle=\"30\"/>"
       "<translate value=\"0.5,0.5,0.5\"/>",
       {std::sqrt(0.75), 0.5, 0}},
      {"Sheared", "<matrix value=\"1 0.5 0 -0.25 0 1 0 0 0 0.25 1 -0.125 0 0 0 1\"/>", {1, 0, 0}},
      {"Upended", "<rotate z=\"1\" angle=\"90\"/><translate x=\"1\"/>", {0, 1, 0}}};
  for (const Placement& p : placements) {
    const std::string volume = fmt::format(
        "<volume name=\"sigma_t\" type=\"gridvolume\"><string name=\"filename\" "
        "value=\"grid.vol\"/><transform name=\"to_world\">{}</transform></volume>",
        p.transform);
    const glm::dvec3 center(0.5);
    cells.push_back(
        {.axis = "placement of a grid, Beer-Lambert",
         .at = 1,
         .name = std::string(p.name) + "Beer",
         .scene =
             scene(camera({.origin = center - 2.0 * p.axis, .target = center, .up = {0, 0, 1}}) +
                   heterogeneous(volume, 1, "0", 0) + environment()),
         .write_files = writes_vol({8, 8, 8}, ramp),
         .central_ray = true,
         .want = glm::dvec3(std::exp(-3.5))});
    cells.push_back({.axis = "placement of a grid, furnace",
                     .at = 1,
                     .name = std::string(p.name) + "Furnace",
                     .scene = scene(camera({.origin = {3, 2, -1}, .target = center}) +
                                    heterogeneous(volume, 1, "1", 0) + environment()),
                     .write_files = writes_vol({8, 8, 8}, ramp),
                     .want = glm::dvec3(1.0)});
  }
  return cells;
}

}  // namespace brume::test
