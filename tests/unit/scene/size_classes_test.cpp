#include <gtest/gtest.h>

#include "engine/base/vec3.hpp"
#include "unit/scene/good_case.hpp"

namespace repose::test {
namespace {

std::vector<SizeClass> classes_of(const std::string& list) {
  return read_scene(patched(R"({"particles": {"size_classes": )" + list + "}}")).particles.size_classes;
}

TEST(SizeClasses, TakeTheArticlesTableThoughItSumsTo9999) {
  const auto classes = classes_of(R"([
    {"volume_mm3": [100, 200], "percent": 44.44}, {"volume_mm3": [200, 300], "percent": 25},
    {"volume_mm3": [300, 400], "percent": 22.22}, {"volume_mm3": [400, 500], "percent": 8.33}])");
  ASSERT_EQ(classes.size(), 4U);
  EXPECT_EQ(classes[3].volume_min, 400e-9);
  EXPECT_EQ(classes[3].volume_max, 500e-9);
  double sum = 0.0;
  for (const SizeClass& size : classes) sum += size.number_fraction;
  EXPECT_NEAR(sum, 1.0, 1e-15);                                     // rounding of four divisions
  EXPECT_NEAR(classes[0].number_fraction, 0.4444 / 0.9999, 1e-15);  // the same
}

TEST(SizeClasses, AcceptSharesWithinATenthOfAPercent) {
  EXPECT_EQ(classes_of(R"([{"volume_mm3": [100, 200], "percent": 99.91}])").size(), 1U);
}

TEST(SizeClasses, LeaveOutThoseWithoutAShare) {
  const auto classes = classes_of(R"([{"volume_mm3": [1, 2], "percent": 0},
                                      {"volume_mm3": [100, 200], "percent": 100}])");
  ASSERT_EQ(classes.size(), 1U);
  EXPECT_EQ(classes[0].volume_min, 100e-9);
}

TEST(SizeClasses, TakeADiameterAsOneVolume) {
  const auto classes = classes_of(R"([{"diameter_mm": 6, "percent": 100}])");
  ASSERT_EQ(classes.size(), 1U);
  // V = π d³/6 = 36 π mm³; to rounding
  EXPECT_NEAR(classes[0].volume_min, 36e-9 * kPi, 1e-15 * 36e-9 * kPi);
  EXPECT_EQ(classes[0].volume_min, classes[0].volume_max);
  EXPECT_EQ(classes[0].number_fraction, 1.0);
}

// n_i ~ p_i / d_i³: of equal masses at 4 and 8 mm there are 8 small spheres to a large one.
TEST(SizeClasses, TurnSharesByMassIntoSharesByNumber) {
  const auto classes =
      classes_of(R"([{"diameter_mm": 4, "mass_percent": 50}, {"diameter_mm": 8, "mass_percent": 50}])");
  ASSERT_EQ(classes.size(), 2U);
  EXPECT_NEAR(classes[0].number_fraction, 8.0 / 9.0, 1e-15);  // rounding
  EXPECT_NEAR(classes[1].number_fraction, 1.0 / 9.0, 1e-15);
}

TEST(SizeClasses, GiveBackTheMassShares) {
  const auto classes = classes_of(R"([{"diameter_mm": 3.4, "mass_percent": 25},
                                      {"diameter_mm": 5.1, "mass_percent": 60},
                                      {"diameter_mm": 7.7, "mass_percent": 15}])");
  ASSERT_EQ(classes.size(), 3U);
  double mass = 0.0;
  for (const SizeClass& size : classes) mass += size.number_fraction * size.volume_min;
  EXPECT_NEAR(classes[0].number_fraction * classes[0].volume_min / mass, 0.25, 1e-14);  // rounding
  EXPECT_NEAR(classes[1].number_fraction * classes[1].volume_min / mass, 0.60, 1e-14);
  EXPECT_NEAR(classes[2].number_fraction * classes[2].volume_min / mass, 0.15, 1e-14);
}

// A particle of 1 litre spans more than the cylinder of 100 mm.
TEST(SizeClasses, OfWhichNothingIsPouredAreNotLookedAt) {
  const auto faults = [](const std::string& small, const std::string& large) {
    return faults_of(patched(R"({"particles": {"size_classes": [{"volume_mm3": [100, 200], "percent": )" +
                             small + R"(}, {"volume_mm3": [1e6, 1e6], "percent": )" + large + "}]}}"));
  };
  EXPECT_EQ(faults("100", "0"), std::vector<std::string>{});
  EXPECT_FALSE(faults("99", "1").empty());
}

TEST(SizeClasses, MayBeOfOneVolume) {
  const auto classes = classes_of(R"([{"volume_mm3": [150, 150], "percent": 100}])");
  ASSERT_EQ(classes.size(), 1U);
  EXPECT_EQ(classes[0].volume_min, classes[0].volume_max);
}

}  // namespace
}  // namespace repose::test
