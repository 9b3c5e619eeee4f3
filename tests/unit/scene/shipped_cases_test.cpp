#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "engine/base/json_file.hpp"
#include "engine/base/vec3.hpp"
#include "engine/scene/case_keys.hpp"
#include "support/process.hpp"
#include "unit/scene/good_case.hpp"

namespace repose::test {
namespace {

/// Every file of cases/ that is a case: not the schema, and not in a folder of its own.
std::vector<std::filesystem::path> shipped_cases() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator("cases")) {
    if (entry.path().extension() == ".json" && entry.path().filename() != "case.schema.json")
      files.push_back(entry.path());
  }
  return files;
}

TEST(ShippedCases, AreReadWithoutAFault) {
  const auto files = shipped_cases();
  EXPECT_GE(files.size(), 4U);
  for (const auto& file : files)
    EXPECT_EQ(faults_of(CaseDocument::load(file)), std::vector<std::string>{}) << file;
}

TEST(ShippedCases, HoldTheArticlesScene) {
  const Scene scene = read_scene(std::filesystem::path("cases/iron_ore.json"));
  EXPECT_EQ(scene.particles.material.density, 3886.0);
  EXPECT_EQ(scene.particles.material.shear_modulus, 2.587e9);
  EXPECT_EQ(scene.particles.material.poisson_ratio, 0.283);
  EXPECT_EQ(scene.walls.density, 1200.0);
  EXPECT_EQ(scene.walls.shear_modulus, 1.05e9);
  EXPECT_EQ(scene.walls.poisson_ratio, 0.41);
  EXPECT_EQ(scene.contact.particle_wall.restitution, 0.5);
  EXPECT_EQ(scene.contact.particle_wall.static_friction, 0.6);
  EXPECT_EQ(scene.contact.particle_wall.rolling_friction, 0.05);
  EXPECT_EQ(scene.contact.rolling_model, RollingModel::type_a);
  EXPECT_EQ(scene.test.base_radius, 0.0975);
  EXPECT_EQ(scene.test.base_height, 0.05);
  EXPECT_EQ(scene.test.cylinder_radius, 0.05);
  EXPECT_EQ(scene.test.cylinder_height, 0.3);
  EXPECT_EQ(scene.test.pour_rate, 5.0);
  EXPECT_EQ(scene.test.opening_speed, 1.0);
  EXPECT_EQ(scene.particles.total_mass, 3.0);
  ASSERT_EQ(scene.particles.shapes.size(), 2U);
  for (const Clump& shape : scene.particles.shapes) EXPECT_GE(shape.spheres.size(), 8U);
  // Article Table 1: no. 13 has 165.99 mm³, no. 33 has 141.85 mm³, to the last printed digit
  EXPECT_NEAR(scene.particles.shapes[0].volume, 165.99e-9, 0.005e-9);
  EXPECT_NEAR(scene.particles.shapes[1].volume, 141.85e-9, 0.005e-9);
}

TEST(ShippedCases, HoldThe3160SpheresOfTheComparison) {
  const Scene scene = read_scene(std::filesystem::path("cases/iron_ore_spheres.json"));
  ASSERT_EQ(scene.particles.shapes.size(), 1U);
  EXPECT_TRUE(scene.particles.size_classes.empty());
  const double mass = scene.particles.material.density * scene.particles.shapes[0].volume;
  EXPECT_EQ(scene.particles.shapes[0].spheres[0].radius, 0.00387);
  EXPECT_EQ(std::lround(scene.particles.total_mass / mass), 3160);
}

/// The keys of a JSON schema as patterns, each with its own schema.
void collect(const Json& schema, const std::string& pattern, std::map<std::string, Json>& keys) {
  keys[pattern] = schema;
  if (schema.contains("properties")) {
    EXPECT_EQ(schema.value("additionalProperties", Json(true)), Json(false)) << pattern;
    for (const auto& [name, below] : schema["properties"].items())
      collect(below, pointer_to(pattern, name), keys);
  }
  if (schema.contains("items")) collect(schema["items"], pattern + "/*", keys);
}

std::string type_of(const Json& schema) {
  if (schema.contains("const")) return "const";
  if (schema.contains("enum")) return "enum";
  if (schema.contains("anyOf")) return type_of(schema["anyOf"][0]);
  return schema["type"].is_array() ? schema["type"][0].get<std::string>() : schema["type"].get<std::string>();
}

std::string type_of(const CaseKey& key) {
  switch (key.kind) {
    case KeyKind::object:
    case KeyKind::anything:
      return "object";
    case KeyKind::list:
      return "array";
    case KeyKind::number:
      return "number";
    case KeyKind::integer:
      return "integer";
    case KeyKind::text:
      return key.choices.empty() ? "string" : "enum";
    case KeyKind::marker:
      return "const";
  }
  return "";
}

Json range_of(const Json& schema) {
  const Json& numbers = schema.contains("anyOf") ? schema["anyOf"][0] : schema;
  Json range = Json::object();
  for (const char* name :
       {"minimum", "exclusiveMinimum", "maximum", "exclusiveMaximum", "minItems", "maxItems"})
    if (numbers.contains(name)) range[name] = numbers[name].get<double>();
  return range;
}

Json range_of(const CaseKey& key) {
  Json range = Json::object();
  const bool list = key.kind == KeyKind::list;
  if (std::isfinite(key.range.low))
    range[list ? "minItems" : key.range.low_open ? "exclusiveMinimum" : "minimum"] = key.range.low;
  if (std::isfinite(key.range.high))
    range[list ? "maxItems" : key.range.high_open ? "exclusiveMaximum" : "maximum"] = key.range.high;
  return range;
}

TEST(CaseSchema, SaysTheSameAsTheReader) {
  const Json schema = read_json("cases/case.schema.json");
  std::map<std::string, Json> described;
  collect(schema, "", described);
  std::set<std::string> known;
  for (const CaseKey& key : case_keys()) {
    const std::string pattern(key.pattern);
    known.insert(pattern);
    ASSERT_TRUE(described.contains(pattern)) << pattern;
    const Json& entry = described[pattern];
    EXPECT_EQ(type_of(entry), type_of(key)) << pattern;
    EXPECT_EQ(range_of(entry), range_of(key)) << pattern;
    for (const std::string_view choice : key.choices)
      EXPECT_NE(entry.dump().find("\"" + std::string(choice) + "\""), std::string::npos) << pattern;
    EXPECT_FALSE(entry.value("description", pattern.empty() || pattern.ends_with("/*") ? "-" : "").empty())
        << pattern;
  }
  for (const auto& [pattern, entry] : described) EXPECT_TRUE(known.contains(pattern)) << pattern;
}

TEST(CaseSchema, RequiresTheSameKeysAsTheReader) {
  std::set<std::string> required;
  const std::function<void(const Json&, const std::string&)> visit = [&](const Json& schema,
                                                                         const std::string& pattern) {
    if (schema.contains("required")) {
      for (const auto& name : schema["required"])
        required.insert(pointer_to(pattern, name.get<std::string>()));
    }
    if (!schema.contains("properties")) return;
    for (const auto& [name, below] : schema["properties"].items()) visit(below, pointer_to(pattern, name));
  };
  visit(read_json("cases/case.schema.json")["then"], "");
  std::set<std::string> expected;
  for (const CaseKey& key : case_keys())
    if (key.required) expected.insert(std::string(key.pattern));
  EXPECT_EQ(required, expected);
}

TEST(SceneReadme, ListsEveryKeyOfACase) {
  const std::string readme = text_of("engine/scene/README.md");
  for (const CaseKey& key : case_keys()) {
    if (key.kind == KeyKind::object || key.pattern.ends_with("/*")) continue;
    EXPECT_NE(readme.find("`" + std::string(key.pattern) + "`"), std::string::npos) << key.pattern;
  }
}

}  // namespace
}  // namespace repose::test
