#include "engine/shape/mesh_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "engine/base/input_error.hpp"
#include "engine/base/random.hpp"
#include "engine/shape/bodies.hpp"

namespace repose {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class MeshFile : public ::testing::Test {
 protected:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      (std::string("repose_mesh_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

  static std::string ascii(const Mesh& mesh, const std::string& header = "solid body") {
    std::string text = header + "\n";
    for (const Facet& facet : mesh.facets) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const std::uint32_t corner : facet) {
        const Vec3& p = mesh.vertices[corner];
        text += fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", p.x(), p.y(), p.z());
      }
      text += "endloop\nendfacet\n";
    }
    return text + "endsolid\n";
  }

  std::string faults_of(const std::string& name, const std::string& content) {
    try {
      read_mesh(write(name, content));
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  std::string faults_of(const Mesh& mesh) { return faults_of("bad.stl", ascii(mesh)); }
};

TEST_F(MeshFile, BinaryStlComesBack) {
  const Mesh body = torus_mesh(0.003, 0.001, 24, 12);
  write_stl(folder_ / "torus.stl", body);
  const Mesh back = read_mesh(folder_ / "torus.stl");
  EXPECT_EQ(back.vertices.size(), body.vertices.size());
  EXPECT_EQ(back.facets.size(), body.facets.size());
  EXPECT_EQ(back.name, "torus");
  // Single precision: 6e-8 of a coordinate.
  EXPECT_NEAR(measure(back).volume / measure(body).volume, 1.0, 1e-6);
}

TEST_F(MeshFile, EveryFormatGivesTheSameBody) {
  const std::string stl = ascii(box_mesh(Vec3(0.01, 0.02, 0.03)));
  const std::string vertices =
      "0 0 0\n0.01 0 0\n0.01 0.02 0\n0 0.02 0\n0 0 0.03\n0.01 0 0.03\n0.01 0.02 0.03\n0 0.02 0.03\n";
  std::string obj = "# a box of quadrangles\n";
  std::istringstream lines(vertices);
  for (std::string line; std::getline(lines, line);) obj += "v " + line + "\n";
  obj += "f 4 3 2 1\nf 5 6 7 8\nf 1/1 2/2 6/6 5/5\nf 3//1 4//1 8//1 7//1\nf 2 3 7 6\nf -8 -4 -1 -5\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 6\nproperty list uchar int vertex_indices\nend_header\n" +
      vertices + "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 2 3 7 6\n4 1 2 6 5\n4 0 4 7 3\n";
  for (const auto& path :
       {write("a.stl", stl), write("a.obj", obj), write("a.ply", ply), write("a.STL", stl)}) {
    const MeshMeasures box = measure(read_mesh(path));
    EXPECT_NEAR(box.volume, 6e-6, 1e-14) << path;
    EXPECT_NEAR(box.area, 2.2e-3, 1e-11) << path;
  }
}

TEST_F(MeshFile, UnitIsTakenFromTheOptionTheHeaderOrTheSize) {
  const Mesh body = box_mesh(Vec3(8.0, 9.0, 10.0));
  EXPECT_NEAR(measure(read_mesh(write("a.stl", ascii(body)))).extents.z(), 0.010, 1e-12);
  EXPECT_NEAR(measure(read_mesh(write("b.stl", ascii(body, "solid x units=cm")))).extents.z(), 0.10, 1e-12);
  EXPECT_NEAR(measure(read_mesh(write("c.stl", ascii(body)), 1e-6)).extents.z(), 1e-5, 1e-15);
  EXPECT_NEAR(measure(read_mesh(write("d.stl", ascii(box_mesh(Vec3(1, 1, 2)))))).extents.z(), 2.0, 1e-12);
  EXPECT_THAT(faults_of(box_mesh(Vec3(1e-8, 1e-8, 1e-8))), HasSubstr("no particle has this size"));
  EXPECT_THAT(faults_of(box_mesh(Vec3(1e5, 1e5, 1e5))), HasSubstr("no particle has this size"));
}

TEST_F(MeshFile, CornersThatDifferByRoundingAreOne) {
  Mesh body = octahedron_mesh(0.004);
  std::string text = ascii(body);
  text.replace(text.find("0.004"), 5, "0.004000000002");
  EXPECT_EQ(read_mesh(write("a.stl", text)).vertices.size(), 6u);
}

TEST_F(MeshFile, AnOpenSurfaceIsRefusedWithTheFacetsAroundTheHole) {
  Mesh open = box_mesh(Vec3(0.01, 0.01, 0.01));
  open.facets.pop_back();
  const std::string faults = faults_of(open);
  EXPECT_THAT(faults, HasSubstr("facet 8: has an edge without a neighbour"));
  EXPECT_THAT(faults, HasSubstr("facet 11: has an edge without a neighbour"));
}

TEST_F(MeshFile, ATurnedFacetIsNamed) {
  Mesh turned = box_mesh(Vec3(0.01, 0.01, 0.01));
  for (const std::size_t f : {std::size_t{0}, std::size_t{7}})
    std::swap(turned.facets[f][0], turned.facets[f][1]);
  const std::string faults = faults_of(turned);
  EXPECT_THAT(faults, HasSubstr("facet 1: is turned against its neighbours"));
  EXPECT_THAT(faults, HasSubstr("facet 8: is turned against its neighbours"));
  EXPECT_THAT(faults, Not(HasSubstr("facet 2:")));
}

TEST_F(MeshFile, ABodyInsideOutIsRefused) {
  Mesh turned = box_mesh(Vec3(0.01, 0.01, 0.01));
  for (Facet& facet : turned.facets) std::swap(facet[0], facet[1]);
  EXPECT_THAT(faults_of(turned), HasSubstr("all facets face inwards"));
}

TEST_F(MeshFile, AMoebiusStripHasNoInside) {
  Mesh strip;
  const int n = 12;
  for (int i = 0; i < n; ++i) {
    const double u = 2 * kPi * i / n;
    for (const double w : {-0.3, 0.3})
      strip.vertices.emplace_back((1 + w * std::cos(u / 2)) * std::cos(u),
                                  (1 + w * std::cos(u / 2)) * std::sin(u), w * std::sin(u / 2));
  }
  const auto at = [&](int i, int side) {
    return static_cast<std::uint32_t>(i < n ? 2 * i + side : 1 - side);
  };
  for (int i = 0; i < n; ++i) {
    strip.facets.push_back({at(i, 0), at(i + 1, 0), at(i + 1, 1)});
    strip.facets.push_back({at(i, 0), at(i + 1, 1), at(i, 1)});
  }
  EXPECT_THAT(faults_of(strip), HasSubstr("cannot be oriented alike"));
}

TEST_F(MeshFile, ABodyThatCrossesItselfIsRefused) {
  // The top of the box is pushed through its bottom at one corner.
  Mesh crossing = box_mesh(Vec3(0.01, 0.01, 0.01));
  crossing.vertices[7] = Vec3(-0.004, -0.003, -0.02);
  EXPECT_THAT(faults_of(crossing), HasSubstr("crosses another facet"));
}

/// A star of n corners, each joined to the k-th next, below and above with a tip: closed, and turned k times.
Mesh star_bipyramid(std::uint32_t n, std::uint32_t k) {
  Mesh star;
  for (std::uint32_t i = 0; i < n; ++i)
    star.vertices.emplace_back(0.004 * std::cos(2 * kPi * i / n), 0.004 * std::sin(2 * kPi * i / n), 0.0);
  star.vertices.emplace_back(0, 0, 0.0032);
  star.vertices.emplace_back(0, 0, -0.0032);
  for (std::uint32_t i = 0; i < n; ++i) {
    star.facets.push_back({i, (i + k) % n, n});
    star.facets.push_back({(i + k) % n, i, n + 1});
  }
  return star;
}

TEST_F(MeshFile, AStarWhoseEdgesCrossEdgesOnlyIsRefused) {
  EXPECT_EQ(faults_of(star_bipyramid(5, 1)), "");
  EXPECT_EQ(faults_of(star_bipyramid(8, 1)), "");
  for (const auto& [n, k] : {std::pair{5u, 2u}, {7u, 2u}, {7u, 3u}, {8u, 3u}})
    EXPECT_THAT(faults_of(star_bipyramid(n, k)), HasSubstr("crosses another facet")) << n << "/" << k;
}

TEST_F(MeshFile, FacetsInOnePlaneThatTouchAreSound) {
  // A plate whose top is a fan of triangles about a corner, all in one plane.
  std::vector<Eigen::Vector2d> curve = {{0.0, 0.0}, {0.005, 0.0}, {0.005, 0.001}, {0.0, 0.001}};
  EXPECT_EQ(faults_of(turned_mesh(curve, 24)), "");
}

TEST_F(MeshFile, TheUnitAndWhoSaysItAreTold) {
  const Mesh body = box_mesh(Vec3(8.0, 9.0, 10.0));
  const MeshFromFile guessed = read_mesh_file(write("a.stl", ascii(body)));
  EXPECT_EQ(guessed.metres_per_unit, 1e-3);
  EXPECT_EQ(guessed.unit_source, UnitSource::size);
  const std::filesystem::path named = write("b.stl", ascii(body, "solid x, units = \"Millimeters\""));
  EXPECT_EQ(read_mesh_file(named).metres_per_unit, 1e-3);
  EXPECT_EQ(read_mesh_file(named).unit_source, UnitSource::file);
  EXPECT_EQ(read_mesh_file(named, 0.01).unit_source, UnitSource::given);
  EXPECT_THAT(faults_of("c.stl", ascii(body, "solid x units=miles")), HasSubstr("unit 'miles'"));
  EXPECT_EQ(read_mesh_file(write("c.stl", ascii(body, "solid x units=miles")), 0.001).metres_per_unit, 1e-3);
}

TEST_F(MeshFile, FaultsOfASurfaceNameTheFaceOfTheFile) {
  const std::string obj =
      "v 0 0 0\nv .01 0 0\nv .01 .01 0\nv 0 .01 0\nv 0 0 .01\nv .01 0 .01\nv .01 .01 .01\nv 0 .01 .01\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 1 4 8 5\n";
  EXPECT_THAT(faults_of("a.obj", obj), HasSubstr("face 6 (line 14): is turned against its neighbours"));
}

TEST_F(MeshFile, TwoBodiesAreNotOne) {
  Mesh two = box_mesh(Vec3(0.01, 0.01, 0.01));
  const Mesh other = two;
  for (const Vec3& vertex : other.vertices) two.vertices.push_back(vertex + Vec3(0.03, 0, 0));
  for (const Facet& facet : other.facets) two.facets.push_back({facet[0] + 8, facet[1] + 8, facet[2] + 8});
  EXPECT_THAT(faults_of(two), HasSubstr("facet 13: begins a second surface"));
}

TEST_F(MeshFile, FlatAndDegenerateFacetsAreRefused) {
  Mesh sheet = box_mesh(Vec3(0.01, 0.01, 0.0));
  EXPECT_FALSE(faults_of(sheet).empty());
  Mesh thin = box_mesh(Vec3(0.01, 0.01, 0.01));
  thin.vertices[3] = 0.5 * (thin.vertices[1] + thin.vertices[2]);
  EXPECT_THAT(faults_of(thin), HasSubstr("facet 2: has no area"));
  Mesh pillow = {"pillow", {{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_THAT(faults_of(pillow), HasSubstr("encloses no volume"));
}

TEST_F(MeshFile, NumbersThatAreNotFiniteAreNamedWithTheirFacet) {
  Mesh bad = box_mesh(Vec3(0.01, 0.01, 0.01));
  bad.vertices[7].y() = std::nan("");
  const std::string faults = faults_of(bad);
  EXPECT_THAT(faults, HasSubstr("facet 4: has a coordinate that is not a finite number"));
  EXPECT_THAT(faults, Not(HasSubstr("facet 1:")));
  write_stl(folder_ / "nan.stl", bad);
  EXPECT_THROW(read_mesh(folder_ / "nan.stl"), InputError);
}

TEST_F(MeshFile, FilesThatEndEarlyAreRefused) {
  write_stl(folder_ / "whole.stl", octahedron_mesh(0.004));
  std::ifstream stream(folder_ / "whole.stl", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  ASSERT_EQ(bytes.size(), 84u + 8 * 50);
  EXPECT_THAT(faults_of("cut.stl", bytes.substr(0, 84 + 3 * 50 + 20)),
              HasSubstr("facet 4: is cut off: the header announces 8 facets"));
  EXPECT_THAT(faults_of("head.stl", bytes.substr(0, 60)), HasSubstr("is no STL file"));
  const std::string text = ascii(octahedron_mesh(0.004));
  EXPECT_THAT(faults_of("text.stl", text.substr(0, text.size() / 2)), HasSubstr("is cut off"));
  EXPECT_THAT(faults_of("a.ply",
                        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                        "property float z\nend_header\n0 0 0\n"),
              HasSubstr("vertex 2: is cut off"));
}

TEST_F(MeshFile, DamagedFilesAreReadOrRefusedButNeverMore) {
  write_stl(folder_ / "whole.stl", octahedron_mesh(0.004));
  std::ifstream stream(folder_ / "whole.stl", std::ios::binary);
  const std::string binary{std::istreambuf_iterator<char>(stream), {}};
  const std::string text = ascii(octahedron_mesh(0.004));
  RandomStream random(11, 0);
  int refused = 0;
  for (int round = 0; round < 600; ++round) {
    std::string bytes = round % 3 == 0 ? binary : text;
    for (std::uint64_t damage = random.below(4) + 1; damage > 0; --damage) {
      const std::size_t at = random.below(bytes.size());
      if (random.below(2) == 0)
        bytes[at] = static_cast<char>(random.below(256));
      else
        bytes.erase(at, random.below(20));
    }
    const char* name = round % 3 == 2 ? "damaged.ply" : "damaged.stl";
    if (!faults_of(name, bytes).empty()) ++refused;
  }
  // Damage to the header or to a normal is harmless, most of the rest is not.
  EXPECT_GT(refused, 400);
  EXPECT_LT(refused, 600);
}

TEST_F(MeshFile, OtherFilesAreRefused) {
  EXPECT_THAT(faults_of("notes.stl", "this is a text about stones\n"), HasSubstr("is no STL file"));
  EXPECT_THAT(faults_of("empty.stl", ""), HasSubstr("is no STL file"));
  EXPECT_THAT(faults_of("none.stl", "solid nothing\nendsolid nothing\n"), HasSubstr("holds no facets"));
  EXPECT_THAT(faults_of("none2.stl", std::string(84, '\0')), HasSubstr("holds no facets"));
  EXPECT_THAT(faults_of("a.ply", "hello"), HasSubstr("is no PLY file"));
  EXPECT_THAT(faults_of("b.ply", "ply\nformat binary_little_endian 1.0\nend_header\n"),
              HasSubstr("format ascii"));
  EXPECT_THAT(faults_of("a.obj", "v 0 0 0\nf 1 2 3\n"),
              HasSubstr("face 1 (line 2) = corner 2: is not among the vertices"));
  EXPECT_THAT(faults_of("a.obj", "just words\n"), HasSubstr("holds no facets"));
  EXPECT_THROW(read_mesh(folder_ / "not_there.stl"), InputError);
  EXPECT_THROW(read_mesh(folder_), InputError);
}

}  // namespace
}  // namespace repose
