#include "engine/scene/did_you_mean.hpp"

#include <gtest/gtest.h>

namespace repose {
namespace {

const std::vector<std::string_view> kKeys = {"density_kg_m3", "shear_modulus_Pa", "poisson_ratio", "shapes"};

TEST(DidYouMean, FindsSlipsOfSpelling) {
  EXPECT_EQ(closest("densty_kg_m3", kKeys), "density_kg_m3");
  EXPECT_EQ(closest("poison_ratio", kKeys), "poisson_ratio");
  EXPECT_EQ(closest("shape", kKeys), "shapes");
  EXPECT_EQ(closest("SHAPES", kKeys), "shapes");
}

TEST(DidYouMean, FindsNamesWithoutTheirUnits) {
  EXPECT_EQ(closest("density", kKeys), "density_kg_m3");
  EXPECT_EQ(closest("shear_modulus", kKeys), "shear_modulus_Pa");
  EXPECT_EQ(closest("shear_modulus_GPa", kKeys), "shear_modulus_Pa");
}

TEST(DidYouMean, PrefersTheNearest) {
  EXPECT_EQ(closest("type_b", {"type_abc", "type_a", "type_c"}), "type_a");
}

TEST(DidYouMean, IsSilentWhereNothingIsClose) {
  EXPECT_EQ(closest("colour", kKeys), "");
  EXPECT_EQ(closest("", kKeys), "");
  EXPECT_EQ(closest("sh", {}), "");
  EXPECT_EQ(did_you_mean("colour", kKeys), "");
  EXPECT_EQ(did_you_mean("density", kKeys), "; did you mean \"density_kg_m3\"?");
}

}  // namespace
}  // namespace repose
