#include <gtest/gtest.h>

#include "sweep/plan.hpp"
#include "sweep_fixture.hpp"

namespace repose::sweep {
namespace {

/// What a design is refused with.
struct Bad {
  const char* name;
  const char* sweep;    ///< JSON of /sweep
  const char* message;  ///< one line of the message, whole
};

void PrintTo(const Bad& bad, std::ostream* stream) { *stream << bad.name; }

class BadDesign : public testing::TestWithParam<Bad> {};

TEST_P(BadDesign, IsRefusedWithItsPlaceAndRule) {
  const CaseDocument document = document_of(case_with(Json::parse(GetParam().sweep)));
  const std::string message = message_of([&] { make_plan(document); });
  EXPECT_NE(("\n" + message + "\n").find("\n" + std::string(GetParam().message) + "\n"), std::string::npos)
      << message;
}

const Bad kBad[] = {
    {"NotAnObject", R"([1])", "case.json: /sweep = [1]: must be an object"},
    {"NoDesign", R"({"factors": {"mu_s": [0.1]}})",
     "case.json: /sweep/design: is required: full_factorial, latin_hypercube, sobol, table or chart"},
    {"UnknownDesign", R"({"design": "grid", "factors": {"mu_s": [0.1]}})",
     "case.json: /sweep/design = \"grid\": must be full_factorial, latin_hypercube, sobol, table or chart"},
    {"DesignNotAText", R"({"design": 3, "factors": {"mu_s": [0.1]}})",
     "case.json: /sweep/design = 3: must be full_factorial, latin_hypercube, sobol, table or chart"},
    {"NoFactors", R"({"design": "full_factorial"})",
     "case.json: /sweep/factors: is required: at least one factor with its values"},
    {"EmptyFactors", R"({"design": "full_factorial", "factors": {}})",
     "case.json: /sweep/factors = {}: must be an object with at least one factor"},
    {"FactorsAList", R"({"design": "sobol", "runs": 4, "factors": ["mu_s"]})",
     "case.json: /sweep/factors = [\"mu_s\"]: must be an object with at least one factor"},
    {"EmptyList", R"({"design": "full_factorial", "factors": {"mu_s": []}})",
     "case.json: /sweep/factors/mu_s = []: must be a list of at least one number"},
    {"NumberForAList", R"({"design": "full_factorial", "factors": {"mu_s": 0.4}})",
     "case.json: /sweep/factors/mu_s = 0.4: must be a list of at least one number"},
    {"TextInAList", R"({"design": "full_factorial", "factors": {"mu_s": [0.1, "0.2"]}})",
     "case.json: /sweep/factors/mu_s/1 = \"0.2\": must be a number"},
    {"ValueTwice", R"({"design": "full_factorial", "factors": {"mu_s": [0.1, 0.2, 0.1]}})",
     "case.json: /sweep/factors/mu_s/2 = 0.1: stands in this list twice"},
    {"RangeOfThree", R"({"design": "sobol", "runs": 4, "factors": {"mu_s": [0.1, 0.2, 0.3]}})",
     "case.json: /sweep/factors/mu_s = [0.1,0.2,0.3]: must be a range [low, high]"},
    {"RangeUpsideDown", R"({"design": "latin_hypercube", "runs": 4, "factors": {"mu_s": [0.8, 0.2]}})",
     "case.json: /sweep/factors/mu_s = [0.8,0.2]: low must be below high"},
    {"RangeOfNothing", R"({"design": "sobol", "runs": 4, "factors": {"mu_s": [0.2, 0.2]}})",
     "case.json: /sweep/factors/mu_s = [0.2,0.2]: low must be below high"},
    {"NoRuns", R"({"design": "sobol", "factors": {"mu_s": [0.2, 0.4]}})",
     "case.json: /sweep/runs: is required: how many points the design has"},
    {"ZeroRuns", R"({"design": "latin_hypercube", "runs": 0, "factors": {"mu_s": [0.2, 0.4]}})",
     "case.json: /sweep/runs = 0: must be an integer from 1 to 1000000"},
    {"HalfARun", R"({"design": "latin_hypercube", "runs": 2.5, "factors": {"mu_s": [0.2, 0.4]}})",
     "case.json: /sweep/runs = 2.5: must be an integer from 1 to 1000000"},
    {"RunsOfAFactorial", R"({"design": "full_factorial", "runs": 8, "factors": {"mu_s": [0.2, 0.4]}})",
     "case.json: /sweep/runs = 8: does not belong to a design of this kind"},
    {"NoReplicates", R"({"design": "full_factorial", "replicates": 0, "factors": {"mu_s": [0.2]}})",
     "case.json: /sweep/replicates = 0: must be an integer from 1 to 1000000"},
    {"NegativeSeed", R"({"design": "full_factorial", "seed": -1, "factors": {"mu_s": [0.2]}})",
     "case.json: /sweep/seed = -1: must be an integer from 0 to 9007199254740991"},
    {"WordForABoolean",
     R"({"design": "full_factorial", "common_random_numbers": "yes", "factors": {"mu_s": [0.2]}})",
     "case.json: /sweep/common_random_numbers = \"yes\": must be true or false"},
    {"FactorTwice",
     R"({"design": "full_factorial", "factors": {"mu_s": [0.2], "/contact/particle_particle/static_friction": [0.3]}})",
     "case.json: /sweep/factors/~1contact~1particle_particle~1static_friction: is the same number as mu_s"},
    {"TooManyRuns",
     R"({"design": "latin_hypercube", "runs": 1000000, "replicates": 2, "factors": {"mu_s": [0.2, 0.4]}})",
     "case.json: /sweep = 2000000 runs: must be at most 1000000"},
    {"TableWithoutFile", R"({"design": "table"})",
     "case.json: /sweep/table: is required: a CSV with a column for each factor"},
    {"TableNotAPath", R"({"design": "table", "table": 3})",
     "case.json: /sweep/table = 3: must be the path of a CSV"},
    {"TableMissing", R"({"design": "table", "table": "no_such.csv"})", "no_such.csv: cannot be opened"},
    {"FactorsOfATable", R"({"design": "table", "table": "no_such.csv", "factors": {"mu_s": [0.2]}})",
     "case.json: /sweep/factors = {\"mu_s\":[0.2]}: does not belong to a design of this kind"},
};

std::string name_of_case(const testing::TestParamInfo<Bad>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(All, BadDesign, testing::ValuesIn(kBad), name_of_case);

TEST(DesignReader, NamesAnUnknownFactorAndAnUnknownKey) {
  const Json sweep = Json::parse(R"({"design": "full_factorial", "replicate": 2,
      "factors": {"mu_S": [0.2], "/contact/friction": [0.3], "/test/kind": [1]}})");
  const std::string message = message_of([&] { make_plan(document_of(case_with(sweep))); });
  EXPECT_NE(message.find("/sweep/replicate = 2: is not known here; did you mean \"replicates\"?"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("/sweep/factors/mu_S: "), std::string::npos) << message;
  EXPECT_NE(message.find("/sweep/factors/~1contact~1friction: "), std::string::npos) << message;
  EXPECT_NE(message.find("/sweep/factors/~1test~1kind: "), std::string::npos) << message;
}

TEST(DesignReader, NamesACaseWithoutADesign) {
  Json json = case_with({});
  json.erase("sweep");
  EXPECT_EQ(message_of([&] { make_plan(document_of(json)); }),
            "case.json: /sweep: is missing: the case has no design to sweep");
}

TEST(DesignReader, NamesMoreFactorsThanSobolKnows) {
  Json sweep = {{"design", "sobol"}, {"runs", 4}, {"factors", Json::object()}};
  Json json = case_with(sweep);
  Json size_class = {{"volume_mm3", {100, 200}}, {"percent", 4.0}};
  for (int i = 0; i < 25; ++i) {
    json["particles"]["size_classes"].push_back(size_class);
    json["sweep"]["factors"]["/particles/size_classes/" + std::to_string(i) + "/percent"] = {3.0, 5.0};
  }
  json["particles"]["shapes"] = {{{"sphere", true}}};
  EXPECT_NE(message_of([&] {
              make_plan(document_of(json));
            }).find("/sweep/factors = 25 factors: a sobol design takes at most 21"),
            std::string::npos);
}

TEST(DesignReader, NamesEveryFaultOfDesignAndCaseAtOnce) {
  Json json = case_with(Json::parse(R"({"design": "full_factorial", "replicates": 0, "foo": 1,
                                        "factors": {"mu_s": [], "mu_r": [0.1, "x"]}})"));
  json["particles"]["density_kg_m3"] = -1;
  json["walls"]["poisson_ratio"] = 0.7;
  const std::string message = message_of([&] { make_plan(document_of(json)); });
  for (const char* pointer : {"/sweep/replicates", "/sweep/foo", "/sweep/factors/mu_s",
                              "/sweep/factors/mu_r/1", "/particles/density_kg_m3", "/walls/poisson_ratio"})
    EXPECT_NE(message.find(pointer), std::string::npos) << pointer << "\n" << message;
}

class BadTable : public testing::Test {
 protected:
  std::string refused(const std::string& csv, const Json& more = Json::object()) {
    test::write_text(folder_ / "points.csv", csv);
    Json sweep = {{"design", "table"}, {"table", "points.csv"}};
    sweep.update(more);
    const auto document = CaseDocument::from_json(case_with(sweep), folder_ / "case.json");
    std::string message = message_of([&] { make_plan(document); });
    const std::string prefix = folder_.path().string() + "/";
    for (std::size_t i = 0; (i = message.find(prefix, i)) != std::string::npos;)
      message.erase(i, prefix.size());
    return message;
  }
  test::TemporaryFolder folder_;
};

TEST_F(BadTable, WithoutRowsIsNamed) {
  EXPECT_EQ(refused("mu_s,mu_r\n"), "points.csv: holds no row below its header");
}
TEST_F(BadTable, WithoutFactorsIsNamed) {
  EXPECT_EQ(refused("replicate\n1\n"), "points.csv: has no column with a factor");
}
TEST_F(BadTable, WithAnUnknownColumnIsNamed) {
  EXPECT_TRUE(refused("mu_s,colour\n0.2,3\n").starts_with("points.csv: column colour: "));
}
TEST_F(BadTable, WithTextForANumberIsNamedByItsLine) {
  EXPECT_EQ(refused("mu_s,mu_r\n0.2,0.1\n0.3,low\n"), "points.csv: line 3, mu_r = low: must be a number");
}
TEST_F(BadTable, WithARepeatedPointIsNamedByBothLines) {
  EXPECT_EQ(refused("mu_s\n0.2\n0.3\n0.20\n"), "points.csv: line 4: is the same run as line 2");
}
TEST_F(BadTable, WithARepeatedReplicateIsNamed) {
  EXPECT_EQ(refused("mu_s,replicate\n0.2,1\n0.2,2\n0.2,1\n"),
            "points.csv: line 4: is the same run as line 2");
}
TEST_F(BadTable, WithAReplicateOfZeroIsNamed) {
  EXPECT_EQ(refused("mu_s,replicate\n0.2,0\n"),
            "points.csv: line 2, replicate = 0: must be a positive integer");
}
TEST_F(BadTable, WithReplicatesOfItsOwnExcludesThoseOfTheCase) {
  EXPECT_EQ(refused("mu_s,replicate\n0.2,1\n", {{"replicates", 2}}),
            "case.json: /sweep/replicates = 2: the table numbers its replicates itself");
}
TEST_F(BadTable, WithAValueThatTheSceneRefusesIsNamedByItsColumn) {
  EXPECT_EQ(refused("mu_s\n0.2\n-0.3\n"), "points.csv: column mu_s = -0.3: must be >= 0");
}

TEST(Plan, NamesAValueThatTheSceneRefusesAtItsFactorOnce) {
  Json sweep = factorial();
  sweep["factors"]["mu_s"] = {0.2, -0.1};
  sweep["factors"]["e_pp"] = {0.3, 1.5};
  EXPECT_EQ(message_of([&] { make_plan(document_of(case_with(sweep))); }),
            "case.json: /sweep/factors/e_pp = 1.5: must be between 0 and 1\n"
            "case.json: /sweep/factors/mu_s = -0.1: must be >= 0");
}

TEST(Plan, NamesTheValuesAtWhichTheCaseBreaks) {
  Json sweep = {{"design", "full_factorial"}, {"factors", {{"/test/base/diameter_mm", {195, 50}}}}};
  const std::string message = message_of([&] { make_plan(document_of(case_with(sweep))); });
  EXPECT_NE(message.find("50"), std::string::npos) << message;  // narrower than the cylinder of 60 mm
  EXPECT_EQ(message.find("195"), std::string::npos) << message;
}

TEST(Plan, NamesAFaultOfTheCaseOnceHoweverManyPointsHaveIt) {
  Json json = case_with(factorial());
  json["particles"]["density_kg_m3"] = -1;
  EXPECT_EQ(message_of([&] { make_plan(document_of(json)); }),
            "case.json: /particles/density_kg_m3 = -1: must be > 0");
}

}  // namespace
}  // namespace repose::sweep
