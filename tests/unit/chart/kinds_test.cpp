#include "chart/kinds.hpp"

#include <gtest/gtest.h>

#include <map>

namespace repose::chart {
namespace {

using Kinds = std::vector<std::string>;

sweep::Variant rung(const std::map<std::string, CaseDocument::Json>& set) {
  sweep::Variant variant;
  for (const auto& [pointer, value] : set) variant.set.push_back({pointer, value, ""});
  return variant;
}

TEST(Kinds, AreWhatARungSets) {
  EXPECT_EQ(
      kinds_of({rung({{"/numerics/stiffness_scale", 0.1}}), rung({{"/numerics/stiffness_scale", 0.01}}),
                rung({{"/particles/shapes/0/clump", "a.json"}, {"/particles/shapes/1/clump", "b.json"}}),
                rung({{"/numerics/stiffness_scale", 0.1}, {"/test/filling", "rain"}})}),
      (Kinds{"stiffness_scale", "stiffness_scale", "shapes", "stiffness_scale+filling"}));
}

TEST(Kinds, LeaveOutWhatMostRungsShare) {
  const CaseDocument::Json soft = 0.001;
  EXPECT_EQ(kinds_of({rung({{"/numerics/stiffness_scale", soft}}),
                      rung({{"/numerics/stiffness_scale", soft}, {"/test/filling", "rain"}}),
                      rung({{"/numerics/stiffness_scale", 0.01}}),
                      rung({{"/numerics/stiffness_scale", soft}, {"/test/opening", "instant"}})}),
            (Kinds{"", "filling", "stiffness_scale", "opening"}));
}

}  // namespace
}  // namespace repose::chart
