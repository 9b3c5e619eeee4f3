#include "chart/chosen_case.hpp"

#include <gtest/gtest.h>

#include "engine/scene/canonical.hpp"
#include "engine/scene/scene_reader.hpp"
#include "support/process.hpp"

namespace repose::chart {
namespace {

using Json = CaseDocument::Json;

sweep::Variant variant(const Json& set) {
  sweep::Variant variant;
  for (const auto& [pointer, value] : set.items()) variant.set.push_back({pointer, value, "test"});
  return variant;
}

/// The case that was chosen reads, wherever it lies, as the given case with the same values set.
void expect_same_scene(const std::string& file, const std::vector<sweep::Variant>& variants) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "a/b");
  CaseDocument document = CaseDocument::load(file);
  const Json json = chosen_case(document, variants, folder / "a/b", "chosen");
  test::write_text(folder / "a/b/chosen.json", json.dump(1));
  for (const sweep::Variant& variant : variants)
    for (const sweep::Override& override : variant.set)
      document.set(override.pointer, override.value, override.place);
  const Scene chosen = read_scene(folder / "a/b/chosen.json");
  EXPECT_EQ(canonical_text(chosen), canonical_text(read_scene(document))) << json.dump(1);
  EXPECT_EQ(chosen.title, "chosen");
}

TEST(ChosenCase, InheritsAndSets) {
  expect_same_scene("cases/quick.json",
                    {variant({{"/numerics/time_step_fraction", 0.1}}),
                     variant({{"/numerics/time_step_fraction", 0.4}, {"/test/filling", "rain"}})});
}

TEST(ChosenCase, WritesListsWholeWithTheirPaths) {
  const std::string file = std::filesystem::absolute("cases/shapes/particle_33_30.json").string();
  expect_same_scene("cases/quick.json", {variant({{"/particles/shapes/1/clump", file}})});
}

TEST(ChosenCase, RemovesWhatAWholeObjectDoesNotHold) {
  expect_same_scene("cases/quick.json", {variant({{"/numerics", {{"stiffness_scale", 0.02}}}})});
}

TEST(ChosenCase, HoldsOneOfTwoRivalsOfReferenceAndRung) {
  const sweep::Variant seconds{"reference", {{"/numerics/time_step_s", 7e-5, "/chart/reference"}}};
  const sweep::Variant fraction{"rung", {{"/numerics/time_step_fraction", 0.3, "/chart/rungs/0/set"}}};
  expect_same_scene("cases/quick.json", {seconds, fraction});
}

TEST(ChosenCase, RemovesAndReplacesRivals) {
  expect_same_scene("cases/quick.json",
                    {variant({{"/particles/size_classes", nullptr}, {"/numerics/time_step_s", 1e-5}})});
}

}  // namespace
}  // namespace repose::chart
