// SPDX-License-Identifier: Apache-2.0
#include "geometry/triangle_mesh.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "shapes.h"

namespace brume {
namespace {

TEST(TriangleMesh, LetsNoRayThroughItsEdgesAndCorners) {
  const MeshData data = test::sphere_mesh(3);
  const RayQueries queries =
      test::queries(std::make_shared<TriangleMesh>(data, glm::dmat4(1.0), true, false));
  Rng rng(1);
  int missed = 0;
  for (int i = 0; i < 200000; ++i) {
    // From inside to corners, and to points of edges.
    const std::size_t triangle = rng.next_uint() % (data.indices.size() / 3);
    const Vec3 a = data.positions[data.indices[3 * triangle]];
    const Vec3 b = data.positions[data.indices[3 * triangle + 1]];
    const float u = i % 4 == 0 ? 0.0f : rng.next_float();
    const Vec3 from = 0.9f * rng.next_float() * sample_uniform_sphere(rng.next_vec2());
    const Vec3 d = glm::normalize((1.0f - u) * a + u * b - from);
    if (!queries.intersect({from, d}, kInfinity)) ++missed;
    if (!test::is_occluded(queries, {from, d}, kInfinity)) ++missed;
  }
  EXPECT_EQ(missed, 0);
}

TEST(TriangleMesh, LetsNoRayThroughAGridSeenFromFarAway) {
  // A flat grid, each row and column on its own float coordinates.
  constexpr int kSize = 50;
  MeshData grid;
  for (int y = 0; y <= kSize; ++y)
    for (int x = 0; x <= kSize; ++x)
      grid.positions.push_back(Vec3(0.02f, 0.02f, 0.013f) * Vec3(x, y, x));
  for (std::uint32_t y = 0; y < kSize; ++y) {
    for (std::uint32_t x = 0; x < kSize; ++x) {
      const std::uint32_t i = y * (kSize + 1) + x;
      grid.indices.insert(grid.indices.end(),
                          {i, i + 1, i + kSize + 2, i, i + kSize + 2, i + kSize + 1});
    }
  }
  const RayQueries queries =
      test::queries(std::make_shared<TriangleMesh>(grid, glm::dmat4(1.0), true, false));
  Rng rng(2);
  int missed = 0;
  for (int i = 0; i < 100000; ++i) {
    const std::size_t vertex = rng.next_uint() % grid.positions.size();
    const Vec3 target = glm::clamp(grid.positions[vertex], Vec3(0.01f), Vec3(0.99f, 0.99f, 0.64f));
    const Vec3 from = target + Vec3(300.0f, 200.0f, 1000.0f) * (0.01f + rng.next_float());
    if (!queries.intersect({from, glm::normalize(target - from)}, kInfinity)) ++missed;
  }
  EXPECT_EQ(missed, 0);
}

TEST(TriangleMesh, IsClosedWhenEveryEdgeHasTwoSides) {
  MeshData sphere = test::sphere_mesh(1);
  const auto is_closed = [](const MeshData& mesh) {
    return TriangleMesh(mesh, glm::dmat4(1.0), true, false).is_closed();
  };
  EXPECT_TRUE(is_closed(sphere));

  MeshData split;  // as files do along seams
  for (const std::uint32_t index : sphere.indices) {
    split.indices.push_back(static_cast<std::uint32_t>(split.positions.size()));
    split.positions.push_back(sphere.positions[index]);
  }
  EXPECT_TRUE(is_closed(split));

  MeshData turned = sphere;
  std::swap(turned.indices[0], turned.indices[1]);
  EXPECT_FALSE(is_closed(turned));

  MeshData open = sphere;
  open.indices.resize(open.indices.size() - 3);
  EXPECT_FALSE(is_closed(open));
}

TEST(TriangleMesh, MakesSmoothNormalsUnlessFaceNormalsAreAskedFor) {
  const MeshData data = test::sphere_mesh(3);
  Rng rng(3);
  const RayQueries smooth =
      test::queries(std::make_shared<TriangleMesh>(data, glm::dmat4(1.0), false, false));
  const RayQueries faceted =
      test::queries(std::make_shared<TriangleMesh>(data, glm::dmat4(1.0), true, false));
  for (int i = 0; i < 1000; ++i) {
    const Vec3 d = sample_uniform_sphere(rng.next_vec2());
    const Hit hit = *smooth.intersect({Vec3(0.0f), d}, kInfinity);
    EXPECT_LT(one_minus_cos(hit.n_shading, d), 1e-3f);
    const Hit face = *faceted.intersect({Vec3(0.0f), d}, kInfinity);
    EXPECT_EQ(face.n_shading, face.n);
    EXPECT_EQ(face.n, hit.n);
  }
}

TEST(TriangleMesh, NormalsOfTheFileDecideWhatIsOutside) {
  MeshData data = test::sphere_mesh(2);
  data.normals = data.positions;  // outward
  for (std::size_t i = 0; i < data.indices.size(); i += 3)
    std::swap(data.indices[i], data.indices[i + 1]);
  const auto n = [&](const MeshData& mesh, bool face_normals) {
    const auto queries =
        test::queries(std::make_shared<TriangleMesh>(mesh, glm::dmat4(1.0), face_normals, false));
    return queries.intersect({Vec3(0.1f, 0.2f, 5.0f), Vec3(0, 0, -1)}, kInfinity)->n;
  };
  EXPECT_GT(n(data, false).z, 0.5f);
  EXPECT_LT(n(data, true).z, -0.5f);
}

TEST(TriangleMesh, InterpolatesTheUvOfTheFile) {
  MeshData data;
  data.positions = {{0, 0, 0}, {2, 0, 0}, {0, 4, 0}};
  data.uvs = {{0, 1}, {1, 1}, {0, 0}};
  data.indices = {0, 1, 2};
  const Hit hit =
      *test::queries(std::make_shared<TriangleMesh>(data, glm::dmat4(1.0), false, false))
           .intersect({{0.5f, 1.0f, 1.0f}, {0, 0, -1}}, kInfinity);
  EXPECT_NEAR(hit.uv.x, 0.25f, 1e-6f);
  EXPECT_NEAR(hit.uv.y, 0.75f, 1e-6f);
  EXPECT_EQ(hit.dp_du, Vec3(2, 0, 0));
}

}  // namespace
}  // namespace brume
