// Tables of scans and meshes through the program: bad input is named whole and nothing is written for it.

#include <gtest/gtest.h>

#include "end_to_end/repose_program.hpp"

namespace repose::test {
namespace {

/// A tetrahedron of 4 mm as OBJ; without its last face it is open.
std::string tetrahedron(bool closed, const std::string& comment = "") {
  return comment + "v 0 0 0\nv 0.004 0 0\nv 0 0.004 0\nv 0 0 0.004\nf 1 3 2\nf 1 2 4\nf 1 4 3\n" +
         (closed ? "f 2 3 4\n" : "");
}

std::vector<std::string> files_in(const TemporaryFolder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    if (entry.is_regular_file()) names.push_back(entry.path().filename().string());
  return names;
}

const std::string kHeader = "no,x_mm,y_mm,z_mm,surface_area_mm2,volume_mm3\n";

TEST(Shape, NamesEveryRowThatNoBodyHasAndWritesNothing) {
  const TemporaryFolder folder;
  // Volumes of 100 mm³ and more do not fit in boxes of 64 mm³.
  write_text(folder / "bad.csv", kHeader + "1,4,4,4,300,100\n2,8,8,8,300,200\n3,4,4,4,310,110\n");
  const Finished answer =
      repose({"shape", "bad.csv", "--meshes", "m", "--plot", "p.png", "--quiet"}, folder.path());
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.out, "");
  EXPECT_NE(answer.err.find("line 2"), std::string::npos) << answer.err;
  EXPECT_NE(answer.err.find("line 4"), std::string::npos) << answer.err;
  EXPECT_EQ(files_in(folder), std::vector<std::string>{"bad.csv"});
}

TEST(Shape, RefusesNamesThatBecomeOneFile) {
  const TemporaryFolder folder;
  write_text(folder / "t.csv", kHeader + "a/1,8,8,8,300,200\na_1,8,8,8,310,200\nb,8,8,8,320,200\n");
  const Finished answer = repose({"shape", "t.csv", "--meshes", "m"}, folder.path());
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(
      answer.err.find("t.csv: line 3 = a_1: its mesh would be m/particle_a_1.stl, like that of 'a/1' in "
                      "line 2"),
      std::string::npos)
      << answer.err;
  EXPECT_EQ(files_in(folder), std::vector<std::string>{"t.csv"});
}

TEST(Shape, KeepsNamesApartInJson) {
  const TemporaryFolder folder;
  write_text(
      folder / "t.csv",
      "no,surface_area_mm2,volume_mm3\n1,300,200\n01,310,200\n1.0,320,200\n1e300,330,200\n-7,340,200\n");
  const Finished answer = repose({"shape", "t.csv", "--json"}, folder.path());
  ASSERT_EQ(answer.code, 0) << answer.err;
  Json names = Json::array();
  const Json result = Json::parse(answer.out);
  for (const Json& particle : result.at("particles")) names.push_back(particle.at("no"));
  EXPECT_EQ(names, (Json{1, "01", "1.0", "1e300", -7}));
}

TEST(Shape, ChecksWhereItIsToWriteWithTheTable) {
  const TemporaryFolder folder;
  write_text(folder / "t.csv", "no,volume_mm3\n1,200\n");
  write_text(folder / "file", "");
  const Finished answer = repose(
      {"shape", "t.csv", "--plot", "nowhere/p.png", "--meshes", "file/m", "--seed", "-5"}, folder.path());
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.out, "");
  for (const char* fault : {"nowhere/p.png: cannot be written", "file/m: cannot be written", "--seed",
                            "surface_area_mm2: this column is missing"})
    EXPECT_NE(answer.err.find(fault), std::string::npos) << fault << "\n" << answer.err;
}

TEST(Clump, ReadsEveryMeshBeforeItWritesAnything) {
  const TemporaryFolder folder;
  write_text(folder / "good.obj", tetrahedron(true));
  write_text(folder / "open.obj", tetrahedron(false));
  const Finished answer =
      repose({"clump", "good.obj", "open.obj", "nope.stl", "--spheres", "2", "--study", "d"}, folder.path());
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.err.find("open.obj: face 1 (line 5): has an edge without a neighbour"), std::string::npos)
      << answer.err;
  EXPECT_NE(answer.err.find("nope.stl: cannot be opened"), std::string::npos) << answer.err;
  EXPECT_EQ(files_in(folder).size(), 2u);
}

TEST(Clump, RefusesMeshesOfOneName) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "other");
  write_text(folder / "x.obj", tetrahedron(true));
  write_text(folder / "other" / "x.obj", tetrahedron(true));
  const Finished answer =
      repose({"clump", "x.obj", "other/x.obj", "--spheres", "2", "--study", "d"}, folder.path());
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.err.find("other/x.obj: has the name of x.obj"), std::string::npos) << answer.err;
}

TEST(Clump, NamesEveryOptionThatItCannotFollow) {
  const TemporaryFolder folder;
  write_text(folder / "x.obj", tetrahedron(true));
  const Finished single = repose({"clump", "x.obj", "--spheres", "2", "--picture", "nowhere/p.png",
                                  "--mercury", "x.obj/m", "--min-radius", "50", "--seed", "-5"},
                                 folder.path());
  EXPECT_EQ(single.code, 2);
  EXPECT_EQ(single.out, "");
  for (const char* fault : {"nowhere/p.png: cannot be written", "x.obj/m: cannot be written",
                            "--min-radius: 50 mm: must be below half the equivalent diameter of x.obj",
                            "--seed: -5: must be 0 or more"})
    EXPECT_NE(single.err.find(fault), std::string::npos) << fault << "\n" << single.err;
  const Finished study =
      repose({"clump", "x.obj", "--spheres", "2", "--study", "d", "--out", "a.json", "--vtk", "b.vtk"},
             folder.path());
  EXPECT_EQ(study.code, 2);
  EXPECT_NE(study.err.find("--out: a.json: goes with a single clump only"), std::string::npos) << study.err;
  EXPECT_NE(study.err.find("--vtk: b.vtk"), std::string::npos) << study.err;
  EXPECT_EQ(files_in(folder), std::vector<std::string>{"x.obj"});
}

TEST(Clump, OfAStudyThatCannotBeMadeDoesNotCostTheOthers) {
  const TemporaryFolder folder;
  // A needle of 10 mm, 0.5 mm thick: one sphere cannot have its moments of inertia.
  write_text(folder / "needle.obj",
             "v 0 0 0\nv 0.01 0 0\nv 0 0.0005 0\nv 0 0 0.0005\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const Finished answer = repose({"clump", "needle.obj", "--spheres", "1,12", "--study", "d"}, folder.path());
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.err.find("needle.obj: spheres = 1: is too few for a body as thin as this"),
            std::string::npos)
      << answer.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "d" / "needle_1.json"));
  EXPECT_TRUE(std::filesystem::exists(folder / "d" / "needle_12.json"));
  EXPECT_EQ(lines_with(text_of(folder / "d" / "errors.csv"), "needle"), 1);
}

TEST(Clump, PutsNoPictureOnStandardOutput) {
  const TemporaryFolder folder;
  write_text(folder / "x.obj", tetrahedron(true));
  // Long enough for the name beside it, which is five letters longer, to be too long for a file.
  const std::string picture = std::string(251, 'p') + ".png";
  const Finished answer = repose({"clump", "x.obj", "--spheres", "2", "--picture", picture}, folder.path());
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.out, "");
  EXPECT_NE(answer.err.find(picture + ": cannot be written"), std::string::npos) << answer.err;
}

TEST(Clump, TellsTheUnitAndWhoSaysIt) {
  const TemporaryFolder folder;
  write_text(folder / "x.obj", tetrahedron(true));
  write_text(folder / "y.obj", tetrahedron(true, "# File units = Centimetres\n"));
  const auto unit_of = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"clump", "--spheres", "2", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished answer = repose(arguments, folder.path());
    return answer.code == 0 ? Json::parse(answer.out).at("mesh_unit") : Json(answer.err);
  };
  EXPECT_EQ(unit_of({"x.obj"}), (Json{{"name", "m"}, {"from", "size"}}));
  EXPECT_EQ(unit_of({"y.obj"}), (Json{{"name", "cm"}, {"from", "file"}}));
  EXPECT_EQ(unit_of({"y.obj", "--unit", "mm"}), (Json{{"name", "mm"}, {"from", "option"}}));
  const Finished words = repose({"clump", "y.obj", "--spheres", "2"}, folder.path());
  EXPECT_NE(words.out.find("unit    cm, as the file says\n"), std::string::npos) << words.out;
}

}  // namespace
}  // namespace repose::test
