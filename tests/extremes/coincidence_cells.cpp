// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "cell.h"
#include "scene_text.h"

// Fog exactly as large as the room that it fills, and boxes of fog with a face in common: in any
// place, as shapes of any kind. A room of fog is held against the same room in fog without end.

namespace brume::test {
namespace {

struct Placement {
  const char* name;
  glm::dmat4 to_world;
  double size;  // of a unit [unit]
};

std::string transform(const glm::dmat4& m) {
  std::string numbers;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) numbers += fmt::format("{} ", m[column][row]);
  return fmt::format("<transform name=\"to_world\"><matrix value=\"{}\"/></transform>", numbers);
}

/// A box as twelve triangles, seen from outside. Its faces are split along either diagonal.
std::string box_obj(bool other_diagonals) {
  constexpr int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                               {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += fmt::format("v {} {} {}\n", i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  for (const auto& f : faces) {
    const auto corner = [&](int i) { return f[(i + (other_diagonals ? 1 : 0)) % 4] + 1; };
    text += fmt::format("f {} {} {}\nf {} {} {}\n", corner(0), corner(1), corner(2), corner(0),
                        corner(2), corner(3));
  }
  return text;
}

void write_boxes(const TemporaryFolder& folder) {
  folder.write("box.obj", box_obj(false));
  folder.write("other_box.obj", box_obj(true));
}

/// The box [-1, 1]^3 under `m`, made of `kind`: a cube, rectangles that face inward, or a mesh.
std::string box(const std::string& kind, const glm::dmat4& m, const std::string& inside) {
  if (kind == "cube")
    return fmt::format("<shape type=\"cube\">{}{}</shape>\n", transform(m), inside);
  if (kind != "rectangles")
    return fmt::format(
        "<shape type=\"obj\"><string name=\"filename\" value=\"{}.obj\"/><boolean "
        "name=\"face_normals\" value=\"true\"/>{}{}</shape>\n",
        kind, transform(m), inside);
  std::string walls;
  for (int side = 0; side < 6; ++side) {
    const glm::dmat4 turn = side < 4 ? glm::rotate(glm::dmat4(1.0), side * M_PI / 2, {1, 0, 0})
                                     : glm::rotate(glm::dmat4(1.0), (side - 4.5) * M_PI, {0, 1, 0});
    glm::dmat4 exact;  // quarter turns
    for (int i = 0; i < 4; ++i) exact[i] = glm::round(turn[i]);
    const glm::dmat4 wall = m * exact * glm::translate(glm::dmat4(1.0), {0, 0, -1});
    walls += fmt::format("<shape type=\"rectangle\">{}{}</shape>\n", transform(wall), inside);
  }
  return walls;
}

std::string view(const Placement& place, const glm::dvec3& origin, const glm::dvec3& target,
                 double fov_deg) {
  const auto at = [&](const glm::dvec3& p) {
    return glm::dvec3(place.to_world * glm::dvec4(p, 1.0));
  };
  return camera({.origin = at(origin),
                 .target = at(target),
                 .fov_deg = fov_deg,
                 .up = glm::dvec3(place.to_world * glm::dvec4(0, 1, 0, 0)) / place.size});
}

void add_rooms(std::vector<Cell>& cells, const Placement& place) {
  const std::string wall =
      "<bsdf type=\"twosided\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.9, 0.7, "
      "0.5\"/></bsdf></bsdf>";
  const std::string lamp = fmt::format(
      "<shape type=\"rectangle\">{}<emitter type=\"area\"><float name=\"radiance\" value=\"5\"/>"
      "</emitter></shape>\n",
      transform(place.to_world * glm::translate(glm::dmat4(1.0), {0, 0, 0.9}) *
                glm::scale(glm::dmat4(1.0), {0.4, 0.4, -1.0})));
  const std::string inside = view(place, {0.3, -0.4, -0.6}, {-0.2, 0.1, 1}, 70) + lamp;
  const double sigma_t = 0.7 / place.size;
  const auto fog = [&](const std::string& name) { return homogeneous(sigma_t, 0.8, 0.4, name); };
  for (const char* walls : {"cube", "rectangles", "box"})
    for (const char* hull : {"cube", "box", "other_box"})
      cells.push_back(
          {.axis = "room exactly full of fog",
           .at = place.size,
           .name = fmt::format("Room{}Of_{}_Fog_{}", place.name, walls, hull),
           .scene = scene(inside + box(walls, place.to_world, wall) +
                              box(hull, place.to_world, kNull + fog("interior")),
                          40),
           .write_files = write_boxes,
           .like = scene(inside + box("rectangles", place.to_world, wall) + fog(""), 40),
           .blocks = 128});
}

void add_neighbours(std::vector<Cell>& cells, const Placement& place) {
  const glm::dmat4 half = glm::scale(glm::dmat4(1.0), {0.5, 1, 1});
  const glm::dmat4 left = place.to_world * glm::translate(glm::dmat4(1.0), {-0.5, 0, 0}) * half;
  const glm::dmat4 right = place.to_world * glm::translate(glm::dmat4(1.0), {0.5, 0, 0}) * half;
  for (const char* kind : {"cube", "box"})
    for (const char* other : {"cube", "box", "other_box"})
      for (const double from : {-3.0, 3.0})
        cells.push_back(
            {.axis = "boxes that share a face, anywhere",
             .at = place.size,
             .name = fmt::format("Pair{}Of_{}_{}_{}", place.name, kind, other,
                                 from < 0 ? "Along" : "Against"),
             .scene =
                 scene(view(place, {from, 0.1, 0.2}, {0, 0.1, 0.2}, 30) +
                       box(kind, left, kNull + homogeneous(0.5 / place.size, 0, 0, "interior")) +
                       box(other, right, kNull + homogeneous(2.0 / place.size, 0, 0, "interior")) +
                       environment()),
             .write_files = write_boxes,
             .central_ray = true,
             .want = glm::dvec3(std::exp(-2.5)),
             .blocks = 1});
}

}  // namespace

std::vector<Cell> cells_of_coincidences() {
  const glm::dmat4 one(1.0);
  const glm::dmat4 turned = glm::rotate(one, 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
  const Placement placements[] = {
      {"AtOrigin", one, 1.0},
      {"InCentimetres", glm::scale(glm::translate(one, {278, 273, 280}), glm::dvec3(278)), 278.0},
      {"Turned", glm::translate(one, {0.3, 0.7, -0.2}) * turned, 1.0},
      {"TurnedAboutCorner", turned * glm::translate(one, {1, 1, 1}), 1.0},
      {"TurnedFarAway", glm::translate(one, {3e4, -2e4, 1e4}) * turned, 1.0}};
  std::vector<Cell> cells;
  for (const Placement& place : placements) {
    add_rooms(cells, place);
    add_neighbours(cells, place);
  }
  return cells;
}

}  // namespace brume::test
