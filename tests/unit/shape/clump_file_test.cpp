#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "engine/base/input_error.hpp"
#include "engine/shape/clump.hpp"

namespace repose {
namespace {

using ::testing::HasSubstr;

class ClumpFile : public ::testing::Test {
 protected:
  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() /
      (std::string("repose_") + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".json");
  void TearDown() override { std::filesystem::remove(file_); }

  std::string faults_of(const std::string& text) {
    std::ofstream(file_) << text;
    try {
      read_clump(file_);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
};

Clump two_spheres() {
  return {.name = "pair",
          .spheres = {{Vec3(0.001, 0, 0), 0.0013}, {Vec3(-0.001, 1e-5, 0), 0.001 / 3.0}},
          .volume = 1.0e-8,
          .inertia = Vec3(3.0e-15, 4.0e-15, 5.0e-15)};
}

TEST(Clump, OfOneSphereHasTheMassPropertiesOfABall) {
  const Clump ball = sphere_clump(0.002);
  EXPECT_NEAR(ball.volume, 3.351032163829113e-8, 1e-22);           // 4/3 π r³
  EXPECT_NEAR(ball.inertia.y(), 0.4 * ball.volume * 4e-6, 1e-27);  // 2/5 m r²
  EXPECT_DOUBLE_EQ(ball.equivalent_diameter(), 0.004);
  EXPECT_DOUBLE_EQ(ball.bounding_radius(), 0.002);
  EXPECT_DOUBLE_EQ(ball.smallest_radius(), 0.002);
}

TEST_F(ClumpFile, GivesBackTheSameBits) {
  const Clump clump = two_spheres();
  write_clump(file_, clump, {.made_by = "by hand", .volume_error = 0.1});
  const Clump back = read_clump(file_);
  EXPECT_EQ(back.name, "pair");
  ASSERT_EQ(back.spheres.size(), 2u);
  EXPECT_EQ(back.spheres[1].centre, clump.spheres[1].centre);
  EXPECT_EQ(back.spheres[1].radius, clump.spheres[1].radius);
  EXPECT_EQ(back.volume, clump.volume);
  EXPECT_EQ(back.inertia, clump.inertia);
}

TEST_F(ClumpFile, WrittenForADensityIsReadForDensityOne) {
  write_clump(file_, two_spheres(), {.density = 3886.0});
  const Clump back = read_clump(file_);
  EXPECT_NEAR(back.volume / 1.0e-8, 1.0, 1e-15);  // one rounding of a product and a quotient
  EXPECT_NEAR(back.inertia.z() / 5.0e-15, 1.0, 1e-15);
}

TEST_F(ClumpFile, LeavesOutSpheresThatNothingCanTouch) {
  write_clump(file_, two_spheres(), {.inner = {{Vec3(0.001, 0, 0), 0.0001}}});
  EXPECT_EQ(read_clump(file_).spheres.size(), 2u);
}

TEST_F(ClumpFile, NamesEveryFaultAtOnce) {
  const std::string faults = faults_of(R"({"schema": 2, "mass": -1, "colour": "red", "inertia": [1, 1, 3],
    "spheres": [{"x": 0, "y": 0, "z": "a", "r": 0}, 7, {"x": 0, "y": 0, "z": 0, "r": 1, "inner": 1, "q": 2}]})");
  EXPECT_THAT(faults, HasSubstr("/schema = 2: must be 1"));
  EXPECT_THAT(faults, HasSubstr("/mass = -1: must be > 0"));
  EXPECT_THAT(faults, HasSubstr("/colour = \"red\": is not a key of a clump file"));
  EXPECT_THAT(faults, HasSubstr("/inertia = [1,1,3]: no moment may exceed the sum of the other two"));
  EXPECT_THAT(faults, HasSubstr("/spheres/0/z = \"a\": must be a number"));
  EXPECT_THAT(faults, HasSubstr("/spheres/0/r = 0: must be > 0"));
  EXPECT_THAT(faults, HasSubstr("/spheres/1 = 7: must be an object"));
  EXPECT_THAT(faults, HasSubstr("/spheres/2/inner = 1: must be true or false"));
  EXPECT_THAT(faults, HasSubstr("/spheres/2/q = 2: is not a key"));
}

TEST_F(ClumpFile, NamesWhatIsMissing) {
  const std::string faults = faults_of("{}");
  EXPECT_THAT(faults, HasSubstr("/mass: is missing"));
  EXPECT_THAT(faults, HasSubstr("/inertia: must be a list"));
  EXPECT_THAT(faults, HasSubstr("/spheres: must be a list of at least one sphere"));
}

TEST_F(ClumpFile, FindsLengthsInMillimetres) {
  EXPECT_THAT(faults_of(R"({"mass": 1e-9, "inertia": [1e-16, 1e-16, 1e-16],
                            "spheres": [{"x": 0, "y": 0, "z": 0, "r": 0.62}]})"),
              HasSubstr("does not fit the size of the spheres"));
}

/// A sphere of r = 1 mm has V = 4.2e-9 m³ and moments of 1.7e-15 m⁵.
TEST_F(ClumpFile, FindsMomentsThatNoBodyOfTheseSpheresHas) {
  const auto faults = [this](const char* moment) {
    const std::string m = moment;
    return faults_of(R"({"mass": 4.2e-9, "spheres": [{"x": 0, "y": 0, "z": 0, "r": 1e-3}], "inertia": [)" +
                     m + ", " + m + ", " + m + "]}");
  };
  EXPECT_EQ(faults("1.7e-15"), "");
  for (const char* moment : {"1.7e-9", "1.7e-18", "1e-300"})
    EXPECT_THAT(faults(moment), HasSubstr("moments are density")) << moment;
}

/// Two spheres of 1 mm, 1.6 mm apart along x, with the mass properties that are given.
std::string pair_file(const std::string& mass, const std::string& inertia, double shift = 0.0) {
  return R"({"mass": )" + mass + R"(, "inertia": )" + inertia + R"(, "spheres": [{"x": )" +
         std::to_string(-8e-4 + shift) + R"(, "y": 0, "z": 0, "r": 1e-3}, {"x": )" +
         std::to_string(8e-4 + shift) + R"(, "y": 0, "z": 0, "r": 1e-3}]})";
}

TEST_F(ClumpFile, RefusesACentreOfMassOutsideTheSpheres) {
  const std::string inertia = "[3e-15, 7e-15, 7e-15]";
  EXPECT_EQ(faults_of(pair_file("7.6e-9", inertia)), "");
  EXPECT_EQ(faults_of(pair_file("7.6e-9", inertia, 1e-3)), "");  // a heavy end is none of our business
  EXPECT_THAT(faults_of(pair_file("7.6e-9", inertia, 0.01)), HasSubstr("/spheres = [{\"x\":"));
  EXPECT_THAT(faults_of(pair_file("7.6e-9", inertia, 0.01)), HasSubstr("do not lie around the origin"));
}

TEST_F(ClumpFile, RefusesMomentsThatBelongToAnotherAxis) {
  // A rod of 20 spheres of 1 mm over 20 mm along z: I about z is some V r²/2, about x and y some V L²/12.
  const auto rod = [](const std::string& inertia) {
    std::string text = R"({"mass": 6.3e-8, "inertia": )" + inertia + R"(, "spheres": [)";
    for (int i = 0; i < 20; ++i)
      text += std::string(i == 0 ? "" : ",") + R"({"x": 0, "y": 0, "z": )" +
              std::to_string(1e-3 * (i - 9.5)) + R"(, "r": 1e-3})";
    return text + "]}";
  };
  EXPECT_EQ(faults_of(rod("[2.1e-12, 2.1e-12, 3e-14]")), "");
  EXPECT_THAT(faults_of(rod("[3e-14, 2.1e-12, 2.1e-12]")), HasSubstr("moments are density"));
}

TEST_F(ClumpFile, RefusesABodyThatIsMoreThanTwiceItsSpheres) {
  EXPECT_EQ(faults_of(pair_file("1.5e-8", "[6e-15, 1.4e-14, 1.4e-14]")), "");
  EXPECT_THAT(faults_of(pair_file("1.8e-8", "[6e-15, 1.4e-14, 1.4e-14]")),
              HasSubstr("mass is density × volume"));
}

TEST_F(ClumpFile, RefusesTheSameSphereTwiceButNotAsAnInnerOne) {
  const auto twins = [](const std::string& mark) {
    const std::string sphere = R"({"x": 0, "y": 0, "z": 0, "r": 1e-3)";
    return R"({"mass": 4.2e-9, "inertia": [1.7e-15, 1.7e-15, 1.7e-15], "spheres": [)" + sphere + "}," +
           sphere + mark + "}]}";
  };
  EXPECT_THAT(faults_of(twins("")),
              HasSubstr("/spheres/1 = {\"x\":0,\"y\":0,\"z\":0,\"r\":0.001}: is the same as sphere 0"));
  EXPECT_EQ(faults_of(twins(R"(, "inner": true)")), "");
}

TEST_F(ClumpFile, RefusesAKeyGivenTwice) {
  EXPECT_THAT(faults_of(R"({"mass": 1e-9, "mass": 2e-9})"), HasSubstr("/mass: is given twice"));
}

TEST_F(ClumpFile, TakesEveryShippedClump) {
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator("cases/shapes")) {
    if (entry.path().extension() != ".json") continue;
    EXPECT_NO_THROW(read_clump(entry.path())) << entry.path();
    ++read;
  }
  EXPECT_EQ(read, 14);
}

TEST_F(ClumpFile, RefusesWhatIsNotAClump) {
  EXPECT_THAT(faults_of("[1]"), HasSubstr("must be an object"));
  EXPECT_THAT(faults_of("{\"mass\": "), HasSubstr("is not JSON"));
  EXPECT_THAT(faults_of("{\"mass\": 1e999}"), HasSubstr("number overflow"));
  EXPECT_THROW(read_clump("no_such_clump.json"), InputError);
  EXPECT_THAT(faults_of(R"({"mass": 1, "inertia": [1, 1, 1],
                            "spheres": [{"x": 0, "y": 0, "z": 0, "r": 1, "inner": true}]})"),
              HasSubstr("a sphere that is not inner"));
}

}  // namespace
}  // namespace repose
