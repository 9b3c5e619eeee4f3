#include "engine/scene/case_document.hpp"

#include <gtest/gtest.h>

#include "engine/scene/case_keys.hpp"
#include "support/process.hpp"
#include "unit/scene/good_case.hpp"

namespace repose::test {
namespace {

/// Files of one test by name, in a folder that goes with it.
class Inheritance : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_text(folder_ / name, text);
    return path(name);
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  CaseDocument load(const std::string& name) const { return CaseDocument::load(folder_ / name); }
  [[nodiscard]] std::string fault(const std::string& name) const {
    return message_of([&] { load(name); });
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Inheritance, MergesObjectsAndReplacesTheRest) {
  write("a.json",
        R"({"title": "a", "particles": {"density_kg_m3": 1, "shapes": [1, 2]}, "walls": {"x": 1}})");
  write("b.json", R"({"base": "a.json", "title": "b", "particles": {"shapes": [3]}, "walls": 7})");
  EXPECT_EQ(load("b.json").json(),
            Json::parse(R"({"title": "b", "particles": {"density_kg_m3": 1, "shapes": [3]}, "walls": 7})"));
}

// The examples of RFC 7386, appendix A, that are objects on both sides (a case is one).
TEST_F(Inheritance, IsTheMergePatchOfItsStandard) {
  const struct {
    const char *base, *patch, *result;
  } examples[] = {
      {R"({"a":"b"})", R"({"a":"c"})", R"({"a":"c"})"},
      {R"({"a":"b"})", R"({"b":"c"})", R"({"a":"b","b":"c"})"},
      {R"({"a":"b"})", R"({"a":null})", R"({})"},
      {R"({"a":"b","b":"c"})", R"({"a":null})", R"({"b":"c"})"},
      {R"({"a":["b"]})", R"({"a":"c"})", R"({"a":"c"})"},
      {R"({"a":"c"})", R"({"a":["b"]})", R"({"a":["b"]})"},
      {R"({"a":{"b":"c"}})", R"({"a":{"b":"d","c":"e"}})", R"({"a":{"b":"d","c":"e"}})"},
      {R"({"a":{"b":"c"}})", R"({"a":[1]})", R"({"a":[1]})"},
      {R"({"a":[{"b":"c"}]})", R"({"a":[1]})", R"({"a":[1]})"},
      {R"({"a":"foo"})", R"({"b":null})", R"({"a":"foo"})"},
      {R"({"a":{"b":"c"}})", R"({"a":{"b":"d","c":null}})", R"({"a":{"b":"d"}})"},
      {R"({})", R"({"a":{"bb":{"ccc":null}}})", R"({"a":{"bb":{}}})"},
  };
  for (const auto& example : examples) {
    write("base.json", example.base);
    Json patch = Json::parse(example.patch);
    patch["base"] = "base.json";
    write("patch.json", patch.dump());
    EXPECT_EQ(load("patch.json").json(), Json::parse(example.result)) << example.base << example.patch;
  }
}

TEST_F(Inheritance, FollowsAChainAndFindsEachBaseBesideItsFile) {
  write("common/a.json", R"({"title": "a", "schema": 1})");
  write("common/b.json", R"({"base": "a.json", "title": "b"})");
  write("studies/c.json", R"({"base": "../common/b.json", "walls": {}})");
  const CaseDocument document = load("studies/c.json");
  EXPECT_EQ(document.json(), Json::parse(R"({"title": "b", "schema": 1, "walls": {}})"));
  EXPECT_EQ(document.file(), path("studies/c.json"));
}

TEST_F(Inheritance, RemembersTheFileOfEveryValue) {
  write("a.json", R"({"particles": {"density_kg_m3": 1, "poisson_ratio": 0, "shapes": [{"clump": "x"}]}})");
  write("b.json", R"({"base": "a.json", "particles": {"density_kg_m3": 2}, "walls": {"density_kg_m3": 3}})");
  const CaseDocument document = load("b.json");
  EXPECT_EQ(document.source("/particles/density_kg_m3"), path("b.json"));
  EXPECT_EQ(document.source("/particles/poisson_ratio"), path("a.json"));
  EXPECT_EQ(document.source("/particles/shapes/0/clump"), path("a.json"));
  EXPECT_EQ(document.source("/walls/density_kg_m3"), path("b.json"));
  EXPECT_EQ(document.source("/contact/rolling_model"), path("b.json"));  // nowhere: the case itself
  EXPECT_EQ(document.source("/particles/missing"), path("b.json"));
}

TEST_F(Inheritance, NamesTheFileThatHoldsAFault) {
  Json base = good_case();
  base["walls"]["density_kg_m3"] = -1;
  write("a.json", base.dump());
  write("b.json", R"({"base": "a.json", "contact": {"particle_wall": {"restitution": 2}}})");
  const std::vector<std::string> expected = {
      path("a.json") + ": /walls/density_kg_m3 = -1: must be > 0",
      path("b.json") + ": /contact/particle_wall/restitution = 2: must be between 0 and 1"};
  EXPECT_EQ(faults_of(load("b.json")), expected);
}

TEST_F(Inheritance, FindsPathsBesideTheFileThatGivesThem) {
  write("common/a.json", R"({"particles": {"shapes": [{"clump": "shapes/x.json"}]}})");
  write("b.json", R"({"base": "common/a.json", "sweep": {"table": "points.csv"}})");
  CaseDocument document = load("b.json");
  EXPECT_EQ(document.resolve("/particles/shapes/0/clump", "shapes/x.json"), path("common/shapes/x.json"));
  EXPECT_EQ(document.resolve("/sweep/table", "points.csv"), path("points.csv"));
  EXPECT_EQ(document.resolve("/sweep/table", "/abs/points.csv"), "/abs/points.csv");
  document.set("/particles/shapes/0/clump", "y.json", "--set");
  EXPECT_EQ(document.resolve("/particles/shapes/0/clump", "y.json"), path("y.json"));
}

TEST_F(Inheritance, LetsOneWayToGiveATimeStepReplaceTheOther) {
  write("a.json", R"({"numerics": {"time_step_fraction": 0.2, "stiffness_scale": 1}})");
  write("b.json", R"({"base": "a.json", "numerics": {"time_step_s": 5e-6}})");
  write("c.json", R"({"base": "b.json", "numerics": {"time_step_fraction": 0.4}})");
  EXPECT_EQ(load("b.json").json()["numerics"], Json::parse(R"({"stiffness_scale": 1, "time_step_s": 5e-6})"));
  EXPECT_EQ(load("c.json").json()["numerics"],
            Json::parse(R"({"stiffness_scale": 1, "time_step_fraction": 0.4})"));
}

/// "link" leads to real/inner, whose parent is real, not the folder that the link lies in.
TEST_F(Inheritance, FollowsLinksAsTheSystemDoes) {
  write("parent.json", R"({"title": "beside the link"})");
  write("real/parent.json",
        R"({"title": "above the folder", "particles": {"shapes": [{"mesh": "../a.stl"}]}})");
  write("real/inner/case.json", R"({"base": "../parent.json", "walls": {"x": 1}})");
  std::filesystem::create_directory_symlink(path("real/inner"), path("link"));
  const CaseDocument document = load("link/case.json");
  EXPECT_EQ(document.json().at("title"), "above the folder");
  write("a.stl", "");
  EXPECT_TRUE(
      std::filesystem::equivalent(document.resolve("/particles/shapes/0/mesh", "../a.stl"), path("a.stl")));
}

TEST_F(Inheritance, NamesTheFileThatClosesALoopBelowTheCase) {
  write("a.json", R"({"base": "b.json"})");
  write("b.json", R"({"base": "c.json"})");
  write("c.json", R"({"base": "b.json"})");
  EXPECT_TRUE(fault("a.json").ends_with("inherits from itself: " + path("b.json") + " is reached again"))
      << fault("a.json");
}

TEST_F(Inheritance, RefusesACircle) {
  write("a.json", R"({"base": "sub/b.json"})");
  write("sub/b.json", R"({"base": "../a.json"})");
  EXPECT_EQ(fault("a.json"), path("sub/b.json") + ": /base = \"" + path("a.json") +
                                 "\": inherits from itself: " + path("a.json") + " is reached again");
  write("self.json", R"({"base": "./self.json"})");
  EXPECT_EQ(fault("self.json"), path("self.json") + ": /base = \"" + path("self.json") +
                                    "\": inherits from itself: " + path("self.json") + " is reached again");
}

TEST_F(Inheritance, NamesABaseThatCannotBeRead) {
  write("a.json", R"({"base": "no/such.json"})");
  EXPECT_EQ(fault("a.json"),
            path("a.json") + ": /base = \"no/such.json\": cannot be opened: " + path("no/such.json"));
  write("b.json", R"({"base": 7})");
  EXPECT_EQ(fault("b.json"), path("b.json") + ": /base = 7: must be the path of a case");
  write("c.json", R"({"base": ""})");
  EXPECT_EQ(fault("c.json"), path("c.json") + ": /base = \"\": must be the path of a case");
  write("broken.json", "{");
  write("d.json", R"({"base": "broken.json"})");
  EXPECT_TRUE(fault("d.json").starts_with(path("broken.json") + ": line 1, column 2: is not JSON"))
      << fault("d.json");
}

TEST_F(Inheritance, RefusesACaseThatIsNotAnObject) {
  write("a.json", "[1, 2]");
  EXPECT_EQ(fault("a.json"), path("a.json") + ": [1,2]: must be an object");
}

// Overrides

/// The good case after assignments of a command line, and the faults that they made.
struct Overridden {
  explicit Overridden(const std::vector<std::string>& assignments) {
    for (const std::string& assignment : assignments) document.set_from_command_line(assignment, faults);
  }
  [[nodiscard]] std::vector<std::string> lines() const {
    std::vector<std::string> lines;
    for (const Fault& fault : faults.list()) lines.push_back(fault.text());
    return lines;
  }
  CaseDocument document = patched("{}");
  Faults faults;
};

TEST(CommandLine, SetsByPointerAndByTheNameOfAFactor) {
  const Overridden set({"mu_s=0.4", "e_pw=0.9", "/particles/total_mass_kg=2", "/contact/rolling_model=type_a",
                        "/title=\"a=b\"", "/particles/size_classes/1/volume_mm3/0=210"});
  EXPECT_EQ(set.lines(), std::vector<std::string>{});
  const Scene scene = read_scene(set.document);
  EXPECT_EQ(scene.contact.particle_particle.static_friction, 0.4);
  EXPECT_EQ(scene.contact.particle_wall.restitution, 0.9);
  EXPECT_EQ(scene.particles.total_mass, 2.0);
  EXPECT_EQ(scene.contact.rolling_model, RollingModel::type_a);
  EXPECT_EQ(scene.title, "a=b");
  EXPECT_EQ(scene.particles.size_classes[1].volume_min, 210e-9);
}

TEST(CommandLine, SetsKeysThatTheCaseDoesNotGive) {
  CaseDocument document = patched(R"({"numerics": null})");
  Faults faults;
  document.set_from_command_line("/numerics/stiffness_scale=0.1", faults);
  document.set_from_command_line("/measure={\"window\": [0.3, 0.6]}", faults);
  document.set_from_command_line("/sweep/replicates=5", faults);
  EXPECT_TRUE(faults.empty());
  const Scene scene = read_scene(document);
  EXPECT_EQ(scene.numerics.stiffness_scale, 0.1);
  EXPECT_EQ(scene.measure.window_low, 0.3);
  EXPECT_EQ(*document.find("/sweep/replicates"), 5);
}

TEST(CommandLine, RemovesWithNull) {
  const Overridden set({"/test/base/diameter_mm=null", "/numerics/time_step_s=null"});
  EXPECT_EQ(set.lines(), std::vector<std::string>{});
  EXPECT_EQ(set.document.find("/test/base/diameter_mm"), nullptr);
  EXPECT_EQ(set.document.find("/numerics/time_step_s"), nullptr);
}

TEST(CommandLine, ReplacesTheOtherWayToGiveATimeStep) {
  const Overridden set({"/numerics/time_step_s=5e-6"});
  EXPECT_EQ(read_scene(set.document).numerics.time_step, 5e-6);
  EXPECT_EQ(
      faults_of(Overridden({"/numerics/time_step_s=5e-6", "/numerics/time_step_fraction=0.2"}).document),
      std::vector<std::string>{"--set: /numerics/time_step_s = 5e-06: excludes "
                               "/numerics/time_step_fraction: give one of the two"});
}

TEST(CommandLine, TakesWhatIsNotJsonAsText) {
  const Overridden set({"/test/kind=split_cylinder", "mu_s=high", "mu_r=1e999", "e_pp=nan"});
  EXPECT_EQ(set.lines(), std::vector<std::string>{});
  const std::vector<std::string> expected = {
      "--set: /contact/particle_particle/restitution = \"nan\": must be a number",
      "--set: /contact/particle_particle/static_friction = \"high\": must be a number",
      "--set: /contact/particle_particle/rolling_friction = \"1e999\": must be a number"};
  EXPECT_EQ(faults_of(set.document), expected);
}

TEST(CommandLine, NamesEveryAssignmentThatCannotBeMade) {
  const Overridden set({"mu_s", "=3", "mu_x=1", "friction=1", "/particles/densty_kg_m3=1",
                        "/particles/shapes/1/sphere=true", "/particles/shapes/x=1", "/base=other.json",
                        "/walls/density_kg_m3/x=1", "/particles/shapes/0=null", "particles/density_kg_m3=1"});
  const std::string names = "e_pp, mu_s, mu_r, e_pw, mu_s_pw, mu_r_pw";
  const std::vector<std::string> expected = {
      "--set: mu_s: must be KEY=VALUE",
      "--set: =3: must be KEY=VALUE",
      "--set: mu_x = 1: is not a factor; did you mean \"mu_s\"?",
      "--set: friction = 1: is not a factor: use one of " + names + " or a JSON pointer to a number",
      "--set: /particles/densty_kg_m3 = 1: is not known; did you mean \"density_kg_m3\"?",
      "--set: /particles/shapes/1/sphere = true: cannot be set: /particles/shapes has 1 entry, counted from "
      "0",
      "--set: /particles/shapes/x = 1: is not known; the entries of a list are counted from 0",
      "--set: /base = \"other.json\": cannot be set: what a case inherits is read before",
      "--set: /walls/density_kg_m3/x = 1: is not known",
      "--set: /particles/shapes/0 = null: must be a value: an entry of a list cannot be removed",
      "--set: particles/density_kg_m3 = 1: is not a factor; did you mean \"/particles/density_kg_m3\"?"};
  EXPECT_EQ(set.lines(), expected);
  EXPECT_EQ(set.document.json(), good_case());
}

TEST(CommandLine, CannotSetAnEntryOfAListThatIsNotThere) {
  CaseDocument document = patched(R"({"measure": null})");
  EXPECT_EQ(message_of([&] { document.set("/measure/window/0", 0.3, "factor"); }),
            "factor: /measure/window/0 = 0.3: cannot be set: the case has no list /measure/window");
  EXPECT_EQ(document.find("/measure"), nullptr);
}

// Factors

TEST(FactorPointer, KnowsNamesAndPointersToNumbers) {
  EXPECT_EQ(factor_pointer("e_pp"), "/contact/particle_particle/restitution");
  EXPECT_EQ(factor_pointer("mu_s"), "/contact/particle_particle/static_friction");
  EXPECT_EQ(factor_pointer("mu_r"), "/contact/particle_particle/rolling_friction");
  EXPECT_EQ(factor_pointer("e_pw"), "/contact/particle_wall/restitution");
  EXPECT_EQ(factor_pointer("mu_s_pw"), "/contact/particle_wall/static_friction");
  EXPECT_EQ(factor_pointer("mu_r_pw"), "/contact/particle_wall/rolling_friction");
  for (const char* pointer :
       {"/particles/total_mass_kg", "/numerics/time_step_fraction", "/test/cylinder/height_mm",
        "/particles/size_classes/0/volume_mm3/1", "/particles/shapes/2/spheres", "/measure/window/0"})
    EXPECT_EQ(factor_pointer(pointer), pointer);
  for (const char* other :
       {"", "mu", "/title", "/contact/rolling_model", "/particles", "/particles/shapes/0/sphere",
        "/sweep/replicates", "/no/such", "particles/total_mass_kg"})
    EXPECT_FALSE(factor_pointer(other).has_value()) << other;
}

TEST(FactorPointer, SaysWhatIsWrongWithAName) {
  EXPECT_EQ(factor_rule("/contact/rolling_model"), "is not a number of a case, so it cannot be a factor");
  EXPECT_EQ(factor_rule("/numerics/time_step"), "is not known; did you mean \"time_step_s\"?");
  EXPECT_EQ(factor_rule("mu_ss"), "is not a factor; did you mean \"mu_s\"?");
}

TEST(Factors, MoveEveryNumberOfACaseAndNothingElse) {
  ShapeCache shapes;
  Faults faults;
  const CaseDocument document = patched("{}");
  for (const CaseKey& key : case_keys()) {
    std::string pointer(key.pattern);
    while (pointer.find('*') != std::string::npos) pointer.replace(pointer.find('*'), 1, "0");
    const Json* value = document.find(pointer);
    if (value == nullptr || !value->is_number() || pointer == "/schema") continue;
    CaseDocument moved = document;
    moved.set(pointer, value->get<double>() * 1.0001, "factor");
    Json expected = document.json();
    expected[Json::json_pointer(pointer)] = value->get<double>() * 1.0001;
    EXPECT_EQ(moved.json(), expected) << pointer;
    EXPECT_EQ(moved.source(pointer), "factor") << pointer;
    read_scene(moved, faults, shapes);
    EXPECT_TRUE(faults.empty()) << pointer;
  }
}

}  // namespace
}  // namespace repose::test
