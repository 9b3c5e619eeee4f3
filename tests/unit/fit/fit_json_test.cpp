#include "fit/fit_json.hpp"

#include <gtest/gtest.h>

#include "unit/fit/tables.hpp"

namespace repose::fit {
namespace {

using nlohmann::json;
using test::article_table;

PowerLaw sample_law(Loss loss = Loss::least_squares) {
  test::Noise noise(9);
  std::vector<Observation> table = article_table(2);
  for (Observation& row : table) row.angle += noise.normal();
  table[0].exclusion = "no_heap: everything rolled off";
  table[0].label = "run 1";
  return fit_power_law(table, loss);
}

json article_equation() {
  return json::parse(R"({"C": 56.61, "a": 0.01, "b": 0.084, "c": 0.25,
    "domain": {"e_pp": [0.05, 0.6], "mu_s": [0.1, 0.8], "mu_r": [0.01, 0.2]}})");
}

std::string reading_message(const json& root) {
  try {
    power_law_from_json(root, "fit.json");
  } catch (const Unusable& error) {
    return error.what();
  }
  return "read";
}

TEST(FitJson, HasTheNamesOfTheInterface) {
  const json object = to_json(sample_law());
  for (const char* name :
       {"C", "a", "b", "c", "standard_error", "interval_95", "correlation", "worst_error_deg", "worst_point",
        "rms_error_deg", "r_squared", "points", "excluded", "domain"}) {
    EXPECT_TRUE(object.contains(name)) << name;
  }
  EXPECT_EQ(object["points"], 53);
  EXPECT_EQ(object["excluded"][0]["reason"], "no_heap: everything rolled off");
  EXPECT_EQ(object["excluded"][0]["label"], "run 1");
  EXPECT_EQ(object["domain"]["mu_s"], json::array({0.2, 0.8}));
  EXPECT_EQ(object["correlation"].size(), 4U);
  EXPECT_EQ(object["correlation"][2][2], 1.0);
  EXPECT_GT(object["standard_error"]["C"].get<double>(), 0.0);
}

TEST(FitJson, IsReadBackToTheBit) {
  for (const Loss loss : {Loss::least_squares, Loss::minimax}) {
    const json first = to_json(sample_law(loss));
    const PowerLaw law = power_law_from_json(json::parse(first.dump()), "fit.json");
    json second = to_json(law);
    // Only the scaling of the covariance rounds.
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        const double expected = first["covariance"][i][j];
        EXPECT_NEAR(second["covariance"][i][j].get<double>(), expected, 1e-15 * std::abs(expected));
        EXPECT_NEAR(second["correlation"][i][j].get<double>(), first["correlation"][i][j].get<double>(),
                    1e-14);
      }
    }
    second["covariance"] = first["covariance"];
    second["correlation"] = first["correlation"];
    EXPECT_EQ(first, second);
  }
}

TEST(FitJson, ASavedFitInvertsLikeTheFit) {
  const PowerLaw law = sample_law();
  const PowerLaw saved = power_law_from_json(to_json(law), "fit.json");
  const Question question{.angle = 33.0, .sigma = 1.0, .mu_r = 0.1};
  EXPECT_NEAR(invert(saved, question).solution->low.mu_s, invert(law, question).solution->low.mu_s, 1e-13);
}

TEST(FitJson, WritesNullForWhatIsNotIdentified) {
  std::vector<Observation> table;
  for (const Observation& row : article_table()) {
    if (row.e == 0.3) table.push_back(row);
  }
  const json object = json::parse(to_json(fit_power_law(table)).dump());
  EXPECT_EQ(object["a"], 0.0);
  EXPECT_TRUE(object["standard_error"]["a"].is_null());
  EXPECT_TRUE(object["interval_95"]["a"].is_null());
  EXPECT_FALSE(object["identified"]["a"].get<bool>());
  EXPECT_NO_THROW(power_law_from_json(object, "fit.json"));
}

TEST(FitJson, TakesAnEquationWrittenByHand) {
  const PowerLaw law = power_law_from_json(article_equation(), "article.json");
  EXPECT_NEAR(law.predict({0.3, 0.5, 0.1}), test::article_angle(0.3, 0.5, 0.1), 1e-12);
  const Inversion answer = invert(law, {.angle = 33.0, .sigma = 0.0, .e = 0.3, .mu_r = 0.1});
  EXPECT_NEAR(test::article_angle(0.3, answer.solution->value.mu_s, 0.1), 33.0, 1e-9);
}

TEST(FitJson, RefusesWhatIsNoCovariance) {
  nlohmann::json root = to_json(fit_power_law(test::article_table()));
  const auto entry = [&root](int i, int j) -> nlohmann::json& { return root["covariance"][i][j]; };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) entry(i, j) = i == j ? 1e-4 : 0.0;
  entry(1, 2) = entry(2, 1) = 0.9999999e-4;  // a correlation just below 1
  EXPECT_EQ(reading_message(root), "read");
  const std::string fault = "must be symmetric and positive semidefinite (are all its digits there?)";
  entry(1, 2) = entry(2, 1) = 2e-4;
  EXPECT_NE(reading_message(root).find(fault), std::string::npos) << "a correlation of 2";
  entry(1, 2) = 0.0;
  EXPECT_NE(reading_message(root).find(fault), std::string::npos) << "not symmetric";
  entry(1, 1) = 0.0, entry(2, 1) = 0.0, entry(1, 3) = entry(3, 1) = 1e-5;
  EXPECT_NE(reading_message(root).find(fault), std::string::npos) << "depends on what has no error";
}

TEST(FitJson, NamesEveryFaultOfASavedFitAtOnce) {
  json root = article_equation();
  root["C"] = -1;
  root.erase("b");
  root["c"] = "0.25";
  root["domain"]["mu_s"] = {0.8, 0.1};
  root["domain"]["e_pp"] = {0, 0.6};
  root["degrees_of_freedom"] = 0;
  root["covariance"] = json::array({1, 2});
  EXPECT_EQ(reading_message(root),
            "fit.json: /b: is missing\n"
            "fit.json: /c = \"0.25\": must be a number\n"
            "fit.json: /C = -1: must be > 0\n"
            "fit.json: /domain/mu_s = [0.8,0.1]: must be [low, high] with 0 <= low <= high\n"
            "fit.json: /domain/e_pp = [0,0.6]: must be > 0 where the exponent is identified\n"
            "fit.json: /covariance = [1,2]: must be 4 rows of 4 numbers\n"
            "fit.json: /degrees_of_freedom = 0: must be >= 1");
  EXPECT_EQ(reading_message(json::array()), "fit.json: must be the JSON object of a saved fit");
  root = article_equation();
  root["loss"] = "huber";
  root["identified"]["a"] = false;
  EXPECT_EQ(reading_message(root),
            "fit.json: /a = 0.01: must be 0 where it is not identified\n"
            "fit.json: /loss = \"huber\": must be least-squares or minimax");
}

TEST(InversionJson, HasTheNamesOfTheInterface) {
  const PowerLaw law = sample_law();
  const json curve = to_json(invert(law, {.angle = 33.0, .sigma = 1.0}));
  EXPECT_EQ(curve["level_set"].size(), 41U);
  for (const char* name : {"mu_s", "mu_r", "mu_s_band", "mu_r_band"}) {
    EXPECT_TRUE(curve["level_set"][0].contains(name)) << name;
  }
  EXPECT_EQ(curve["identifiable"], false);
  EXPECT_FALSE(curve.contains("solution"));
  const json point = to_json(invert(law, {.angle = 37.0, .sigma = 1.0, .mu_s = 0.4}));
  EXPECT_EQ(point["identifiable"], true);
  EXPECT_EQ(point["solution"]["mu_s"], 0.4);
  EXPECT_EQ(point["solution"]["solved_for"], "mu_r");
  const double mu_r = point["solution"]["mu_r"];
  EXPECT_LE(point["solution"]["interval_95"]["mu_r"][0], mu_r);
  EXPECT_GE(point["solution"]["interval_95"]["mu_r"][1], mu_r);
}

}  // namespace
}  // namespace repose::fit
