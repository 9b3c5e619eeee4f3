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

TEST(Kinds, LeaveOutWhatTheWorkingPointSets) {
  const sweep::Variant working_point =
      rung({{"/numerics/stiffness_scale", 0.001}, {"/test/filling", "rain"}});
  const auto on = [&](const sweep::Variant& own) { return on_working_point(working_point.set, own); };
  EXPECT_EQ(kinds_of({on({}), on(rung({{"/test/opening", "instant"}})),
                      on(rung({{"/numerics/stiffness_scale", 0.01}, {"/test/filling", "rain"}}))}),
            (Kinds{"", "opening", "stiffness_scale+filling"}));
}

}  // namespace
}  // namespace repose::chart
