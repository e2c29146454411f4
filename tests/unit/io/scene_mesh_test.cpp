// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>

#include "io/mesh_file.h"
#include "scene_fixture.h"

namespace brume {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class MeshFiles : public test::SceneTest {
 public:
  MeshData obj(const std::string& text) { return read_obj(write("m.obj", text)); }
  MeshData ply(const std::string& text) { return read_ply(write("m.ply", text)); }

  static std::string message_of(const std::function<void()>& work) {
    try {
      work();
    } catch (const Error& e) {
      const std::string message = e.what();
      return message.substr(
          message.find(message.find("m.obj") != std::string::npos ? "m.obj" : "m.ply"));
    }
    return {};
  }
  std::string obj_error(const std::string& text) {
    return message_of([&] { obj(text); });
  }
  std::string ply_error(const std::string& text) {
    return message_of([&] { ply(text); });
  }
};

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(MeshFiles, ObjPolygonsBecomeFans) {
  const MeshData mesh = obj(std::string(kSquare) + "f 1 2 3 4\n");
  EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2, 0, 2, 3));
  EXPECT_EQ(mesh.positions[2], Vec3(1, 1, 0));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.uvs.empty());
}

TEST_F(MeshFiles, ObjIndicesCountBackFromTheLastWhenNegative) {
  const MeshData mesh = obj(std::string(kSquare) + "f -4 -3 -1\n");
  EXPECT_EQ(mesh.positions[0], Vec3(0, 0, 0));
  EXPECT_EQ(mesh.positions[2], Vec3(0, 1, 0));
}

TEST_F(MeshFiles, ObjCornersWithDifferentNormalsAreDifferentVertices) {
  const MeshData mesh = obj(std::string(kSquare) +
                            "vt 0 0\nvt 1 0.5\nvn 0 0 1\nvn 1 0 0\n"
                            "f 1/1/1 2/2/1 3/1/1\nf 1/1/1 3/1/2 4/2/2\n");
  EXPECT_EQ(mesh.positions.size(), 5u);
  EXPECT_EQ(mesh.normals[3], Vec3(1, 0, 0));
  EXPECT_EQ(mesh.uvs[1], Vec2(1, 0.5f));
}

TEST_F(MeshFiles, ObjNormalsCountOnlyIfAllCornersHaveOne) {
  EXPECT_TRUE(obj(std::string(kSquare) + "vn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\n").normals.empty());
  EXPECT_EQ(obj(std::string(kSquare) + "vn 0 0 1\nf 1//1 2//1 3//1\n").normals.size(), 3u);
}

TEST_F(MeshFiles, ObjSkipsWhatIsNoMesh) {
  const MeshData mesh =
      obj("# comment\r\nmtllib a.mtl\r\no thing\r\ng a b\r\ns off\r\nv 0 0 0 1\r\n"
          "v 1 0 0 0.5 0.5 0.5\r\nv 1 \\\r\n1 0\r\nusemtl x\r\nl 1 2\r\nf 1 2 3 # end");
  EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2));
  EXPECT_EQ(mesh.positions[2], Vec3(1, 1, 0));
}

TEST_F(MeshFiles, BrokenObjNamesTheLine) {
  EXPECT_EQ(obj_error("v 0 0\n"), "m.obj:1: \"v\" needs 3 numbers, found 2");
  EXPECT_EQ(obj_error("v 0 0 x\n"), "m.obj:1: \"x\" is not a finite number");
  EXPECT_EQ(obj_error("v 0 0 nan\n"), "m.obj:1: \"nan\" is not a finite number");
  EXPECT_EQ(obj_error("v 0 0 1e99\n"), "m.obj:1: \"1e99\" is not a finite number");
  EXPECT_EQ(obj_error(std::string(kSquare) + "f 1 2 5\n"),
            "m.obj:5: index 5 is out of range: 4 vertices so far");
  EXPECT_EQ(obj_error(std::string(kSquare) + "f 1 2 0\n"),
            "m.obj:5: index 0 is out of range: 4 vertices so far");
  EXPECT_EQ(obj_error(std::string(kSquare) + "f 1 2 -5\n"),
            "m.obj:5: index -5 is out of range: 4 vertices so far");
  EXPECT_EQ(obj_error(std::string(kSquare) + "f 1/1 2/1 3/1\n"),
            "m.obj:5: index 1 is out of range: 0 texture coordinates so far");
  EXPECT_EQ(obj_error(std::string(kSquare) + "f 1 2\n"),
            "m.obj:5: a face needs 3 corners, found 2");
  EXPECT_EQ(obj_error(std::string(kSquare) + "f 1 2 a\n"),
            "m.obj:5: \"a\" is not the corner of a face");
  EXPECT_EQ(obj_error(kSquare), "m.obj: holds no face");
  EXPECT_EQ(obj_error(""), "m.obj: holds no face");
}

constexpr const char* kAsciiPly =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\n"
    "property float x\nproperty float y\nproperty float z\nproperty float s\nproperty float t\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n4 0 1 2 3\n";

TEST_F(MeshFiles, PlyTextHoldsPolygonsAndUvs) {
  const MeshData mesh = ply(kAsciiPly);
  EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2, 0, 2, 3));
  EXPECT_EQ(mesh.positions[3], Vec3(0, 1, 0));
  EXPECT_EQ(mesh.uvs[2], Vec2(1, 1));
  EXPECT_TRUE(mesh.normals.empty());
}

template <class T>
void put(std::string& out, T value, bool big_endian) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  out.append(bytes.data(), bytes.size());
}

// One triangle with normals, after an element that nobody needs.
std::string binary_ply(bool big_endian) {
  std::string s = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                  "_endian 1.0\nelement extra 1\nproperty list uchar double numbers\n"
                  "property short flag\nelement vertex 3\nproperty double x\nproperty float y\n"
                  "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                  "property uchar red\nelement face 1\nproperty uchar flag\n"
                  "property list uchar uint vertex_index\nend_header\n";
  put<std::uint8_t>(s, 2, big_endian);
  put<double>(s, 1.0, big_endian);
  put<double>(s, 2.0, big_endian);
  put<std::int16_t>(s, -1, big_endian);
  for (int i = 0; i < 3; ++i) {
    put<double>(s, i, big_endian);
    put<float>(s, i == 1 ? 1.0f : 0.0f, big_endian);
    put<float>(s, 0.0f, big_endian);
    for (const float n : {0.0f, 0.0f, 1.0f}) put<float>(s, n, big_endian);
    put<std::uint8_t>(s, 255, big_endian);
  }
  put<std::uint8_t>(s, 0, big_endian);
  put<std::uint8_t>(s, 3, big_endian);
  for (const std::uint32_t i : {0u, 1u, 2u}) put<std::uint32_t>(s, i, big_endian);
  return s;
}

TEST_F(MeshFiles, PlyBinaryOfEitherByteOrderHoldsTheSame) {
  for (const bool big_endian : {false, true}) {
    const MeshData mesh = ply(binary_ply(big_endian));
    EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2));
    EXPECT_EQ(mesh.positions[1], Vec3(1, 1, 0));
    EXPECT_EQ(mesh.normals[2], Vec3(0, 0, 1));
  }
}

TEST_F(MeshFiles, EveryTruncatedPlyIsAnError) {
  for (const std::string& whole : {std::string(kAsciiPly), binary_ply(false), binary_ply(true)}) {
    const bool is_text = whole == kAsciiPly;
    // The blank after the last number may be missing.
    for (std::size_t n = 0; n + (is_text ? 1 : 0) < whole.size(); ++n) {
      EXPECT_NE(ply_error(whole.substr(0, n)), "") << n;
    }
  }
}

TEST_F(MeshFiles, ACountThatTheFileCannotHoldAllocatesNothing) {
  std::string huge = kAsciiPly;
  huge.replace(huge.find("vertex 4"), 8, "vertex 4000000000000000");
  EXPECT_THAT(ply_error(huge),
              HasSubstr("ends too early: 4000000000000000 \"vertex\" need at least "
                        "10 bytes each"));
  std::string list = kAsciiPly;
  list.replace(list.find("4 0 1 2 3"), 9, "4000000000 0 1");
  EXPECT_THAT(ply_error(list), HasSubstr("ends too early"));
}

TEST_F(MeshFiles, BrokenPlySaysWhatIsWrong) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string s = kAsciiPly;
    return s.replace(s.find(from), from.size(), to);
  };
  EXPECT_EQ(ply_error("solid"), "m.ply: is not a PLY file: it does not begin with \"ply\"");
  EXPECT_EQ(ply_error(with("ascii", "utf8")), "m.ply:2: unknown PLY format \"utf8\"");
  EXPECT_EQ(ply_error(with("float z", "flot z")), "m.ply:7: unknown PLY type \"flot\"");
  EXPECT_EQ(ply_error(with("float z", "float w")), "m.ply: its vertices have no x, y and z");
  EXPECT_EQ(ply_error(with("1 1 0 1 1", "1 x 0 1 1")), "m.ply:15: \"x\" is not a number");
  EXPECT_EQ(ply_error(with("1 1 0 1 1", "1 nan 0 1 1")),
            "m.ply: vertex 2 has a \"y\" that is not finite");
  EXPECT_EQ(ply_error(with("4 0 1 2 3", "4 0 1 2 4")),
            "m.ply: a face has the vertex index 4, but there are 4 vertices");
  EXPECT_EQ(ply_error(with("4 0 1 2 3", "4 0 1 2 -1")), "m.ply: a face has the vertex index -1");
  EXPECT_EQ(ply_error(with("4 0 1 2 3", "2 0 1")), "m.ply: a face has 2 corners");
  EXPECT_EQ(ply_error(with("face 1", "face 0")), "m.ply: holds no face");
}

}  // namespace
}  // namespace brume
