#include "engine/shape/mesh_formats.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace repose {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using Parser = RawMesh (*)(const std::string&, const std::string&, Faults&);

std::string faults_of(Parser parse, const std::string& text) {
  Faults faults;
  parse(text, "a", faults);
  std::string all;
  for (const Fault& fault : faults.list()) all += fault.text() + "\n";
  return all;
}

RawMesh read(Parser parse, const std::string& text) {
  Faults faults;
  RawMesh mesh = parse(text, "a", faults);
  for (const Fault& fault : faults.list()) ADD_FAILURE() << fault.text();
  return mesh;
}

const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

TEST(Obj, PassesOverAByteOrderMarkCommentsAndContinuedLines) {
  const RawMesh mesh = read(parse_obj,
                            "\xEF\xBB\xBFv 0 0 0\r\nv 1 \\\r\n 0 0 # a corner 7\nv 0 1 0\n"
                            "v 0 0 1\nf 1 2 \\\n3 # the first\nf 1/1 \\  \n 4/2 2/3\n");
  EXPECT_EQ(mesh.vertices.size(), 4u);
  ASSERT_EQ(mesh.facets.size(), 2u);
  EXPECT_EQ(mesh.facets[1], (Facet{0, 3, 1}));
  EXPECT_EQ(mesh.places[1].text(), "face 2 (line 8)");
}

TEST(Obj, RefusesCornersThatAreNoWholeNumbers) {
  EXPECT_THAT(
      faults_of(parse_obj, kCorners + "f 1.4 2 3\nf 1 2 x\nf 1 0 2\n"),
      testing::AllOf(HasSubstr("face 1 (line 5) = corner '1.4': must begin with the number of a vertex"),
                     HasSubstr("face 2 (line 6) = corner 'x'"), HasSubstr("face 3 (line 7) = corner '0'")));
}

TEST(Obj, NamesTheFaceOfTheFileWhateverWentBefore) {
  const std::string faults =
      faults_of(parse_obj, kCorners + "f 1 2 3 4\nf 1 2\nf 1 2 3\nf 1 2 9\nf -9 1 2\n");
  EXPECT_THAT(faults, HasSubstr("face 2 (line 6) = 2 corners: must have at least three"));
  EXPECT_THAT(faults, HasSubstr("face 4 (line 8) = corner 9: is not among the vertices"));
  EXPECT_THAT(faults, HasSubstr("face 5 (line 9)"));
}

TEST(Obj, CountsFaultsBeyondTheFirstTen) {
  std::string text = kCorners;
  for (int i = 0; i < 13; ++i) text += "f 1 2\n";
  EXPECT_THAT(faults_of(parse_obj, text), HasSubstr("3 more faces: must have at least three"));
}

const std::string kVertex = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFace = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kPly = "ply\nformat ascii 1.0\n";

TEST(Ply, FindsCoordinatesWhereverTheyStand) {
  const RawMesh mesh =
      read(parse_ply, kPly +
                          "element vertex 3\nproperty uchar red\nproperty float z\nproperty "
                          "float nx\nproperty float y\nproperty float x\n" +
                          kFace + "end_header\n9 3 0.5 2 1\n9 6 0.5 5 4\n9 9 0.5 8 7\n3 0 1 2\n");
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[0], Vec3(1, 2, 3));
  EXPECT_EQ(mesh.vertices[2], Vec3(7, 8, 9));
  ASSERT_EQ(mesh.facets.size(), 1u);
  EXPECT_EQ(mesh.places[0].text(), "face 1 (line 15)");
}

TEST(Ply, TakesElementsInAnyOrderAndPassesOverOthers) {
  const RawMesh mesh =
      read(parse_ply, kPly + "element camera 1\nproperty float view\nproperty list uchar int n\n" + kFace +
                          "property uchar red\nelement edge 2\nproperty int a\nproperty int b\n" + kVertex +
                          "end_header\n0.5 2 7 7\n3 2 1 0 255\n0 1\n1 2\n0 0 0\n1 0 0\n\n0 1 0\n");
  ASSERT_EQ(mesh.facets.size(), 1u);
  EXPECT_EQ(mesh.facets[0], (Facet{2, 1, 0}));
  EXPECT_EQ(mesh.vertices[2], Vec3(0, 1, 0));
}

TEST(Ply, TakesScalarsBeforeTheListOfAFace) {
  const RawMesh mesh = read(parse_ply, kPly + kVertex +
                                           "element face 1\nproperty uchar red\nproperty list uchar int "
                                           "vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n4 3 0 1 2\n");
  EXPECT_EQ(mesh.facets.size(), 1u);
}

TEST(Ply, RefusesRowsThatDoNotHoldWhatTheHeaderSays) {
  const std::string head =
      kPly + kVertex + "element face 3\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string faults =
      faults_of(parse_ply, head + "0 0 0\n1 0\n0 1 0 7\n4 0 1 2\n3 0 1 2 0\n3 0 1 b\n0 1 2\n");
  EXPECT_THAT(faults, HasSubstr("vertex 2 (line 11) = '1 0': has too few numbers for its property z"));
  EXPECT_THAT(faults, HasSubstr("vertex 3 (line 12) = '0 1 0 7': has more numbers than its properties"));
  EXPECT_THAT(faults, HasSubstr("face 1 (line 13) = '4 0 1 2': has too few numbers"));
  EXPECT_THAT(faults, HasSubstr("face 2 (line 14) = '3 0 1 2 0': has more numbers"));
  EXPECT_THAT(faults, HasSubstr("face 3 (line 15) = corner 'b': must be the number of a vertex"));
  EXPECT_THAT(faults, HasSubstr("line 16: the header announces no more rows"));
}

TEST(Ply, RefusesFewerRowsThanAnnounced) {
  EXPECT_THAT(faults_of(parse_ply, kPly + kVertex + kFace + "end_header\n0 0 0\n1 0 0\n0 1 0\n"),
              HasSubstr("face 1: is cut off: the header announces 1"));
  EXPECT_THAT(faults_of(parse_ply, kPly + kVertex), HasSubstr("the header ends without 'end_header'"));
}

TEST(Ply, RefusesAHeaderThatLacksWhatIsNeeded) {
  const std::string faults = faults_of(
      parse_ply, kPly +
                     "element vertex many\nproperty float x\nproperty list uchar int y\nelement face "
                     "1\nproperty int corners\nend_header\n");
  EXPECT_THAT(faults, HasSubstr("line 3 = many: must be the number of rows"));
  EXPECT_THAT(faults, HasSubstr("element vertex: has no property y"));
  EXPECT_THAT(faults, HasSubstr("element vertex: has no property z"));
  EXPECT_THAT(faults, HasSubstr("element face: has no property list vertex_indices"));
}

const std::string kTriangle =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

TEST(AsciiStl, TakesTheLineEndsOfEverySystem) {
  std::string text = "solid a\n" + kTriangle + kTriangle + "endsolid a\n";
  EXPECT_EQ(read(parse_stl, text).facets.size(), 2u);
  std::replace(text.begin(), text.end(), '\n', '\r');
  EXPECT_EQ(read(parse_stl, text).facets.size(), 2u);
}

TEST(AsciiStl, NumbersFacetsAsTheFileDoes) {
  const std::string bad = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n";
  const std::string faults = faults_of(parse_stl, "solid a\n" + bad + kTriangle + bad + "endsolid\n");
  EXPECT_THAT(faults, HasSubstr("facet 1 = 2 vertices"));
  EXPECT_THAT(faults, HasSubstr("facet 3 = 2 vertices"));
}

TEST(AsciiStl, NamesAZeroByte) {
  EXPECT_THAT(faults_of(parse_stl, "solid a\n" + kTriangle + "endsolid\n" + std::string(1, '\0')),
              HasSubstr("is zero: the text of an ASCII file has none"));
}

TEST(BinaryStl, SaysWhatFollowsTheLastFacet) {
  std::string bytes(84 + 50 + 7, '\0');
  bytes[80] = 1;
  const std::string faults = faults_of(parse_stl, bytes);
  EXPECT_THAT(faults, HasSubstr("byte 135: 7 bytes follow the last facet: the header announces 1 facets"));
  EXPECT_THAT(faults, Not(HasSubstr("cut off")));
}

}  // namespace
}  // namespace repose
