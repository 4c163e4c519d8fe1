// lather rheometer and lather verify, as people and programs meet them.

#include <algorithm>
#include <cmath>
#include <fstream>

#include "tests/server/command.h"

namespace lather::server {
namespace {

class StudyCommand : public Command {
 protected:
  [[nodiscard]] std::string file(const std::string& name, const std::string& text = {}) {
    std::string path = (directory_.path() / name).string();
    if (!text.empty()) std::ofstream(path) << text;
    return path;
  }
};

TEST_F(StudyCommand, RheometerGivesStartUpAsJson) {
  ASSERT_EQ(run("rheometer shaving-cream --rate 1 --time 0.5 --steps 50 --json"), 0) << said();
  const Json curve = Json::parse(said());
  for (const char* key : {"t", "tau_xy", "n1", "s"}) EXPECT_EQ(curve.at(key).size(), 51U) << key;
  EXPECT_EQ(curve.at("t")[50], 0.5);
  EXPECT_EQ(curve.at("tau_xy")[0], 0);
  EXPECT_NEAR(curve.at("tau_xy")[1], 2.9, 0.01);  // elastic: 290 Pa times a shear of 0.01
}

TEST_F(StudyCommand, RheometerReadsAMaterialFromAFile) {
  const std::string material = file("foam.json", R"({"preset": "shaving-cream", "shear_modulus": 580})");
  ASSERT_EQ(run("rheometer " + material + " --time 0.01 --steps 1 --json"), 0) << said();
  EXPECT_NEAR(Json::parse(said()).at("tau_xy")[1], 5.8, 0.01);
}

TEST_F(StudyCommand, RheometerBoxAgreesWithTheLaw) {
  const std::string arguments = "rheometer viscoplastic --time 0.05 --steps 2 --json";
  ASSERT_EQ(run(arguments), 0) << said();
  const Json law = Json::parse(said());
  ASSERT_EQ(run(arguments + " --box --threads 1"), 0) << said();
  const Json box = Json::parse(said());
  EXPECT_NEAR(box.at("s")[2], law.at("s")[2], 0.02 * law.at("s")[2].get<double>());
}

TEST_F(StudyCommand, RheometerDrawsAFlowCurve) {
  const std::string chart = file("curve.svg");
  ASSERT_EQ(run("rheometer shaving-cream --rates 0.1:10 --chart " + chart), 0) << said();
  EXPECT_NE(said().find("power law"), std::string::npos) << said();
  EXPECT_EQ(read(chart).compare(0, 4, "<svg"), 0);
  ASSERT_EQ(run("rheometer shaving-cream --rates 0.1:10 --viscosity --chart " + chart), 0) << said();
  EXPECT_NE(read(chart).find("Bargteil"), std::string::npos);
}

TEST_F(StudyCommand, RheometerSetsAMeasuredFlowCurveBesideTheMaterials) {
  const std::string chart = file("curve.svg");
  ASSERT_EQ(run("rheometer shaving-cream --rates 1:100:3 --measured 18:12:0.5 --chart " + chart), 0)
      << said();
  EXPECT_NE(said().find("yield stress 31.1769 Pa"), std::string::npos) << said();  // sqrt(3) 18
  EXPECT_NE(read(chart).find("measured"), std::string::npos);
  ASSERT_EQ(run("rheometer shaving-cream --rates 1:100:3 --measured 18:12:0.5 --json"), 0) << said();
  const Json curve = Json::parse(said());
  EXPECT_NEAR(curve.at("measured")[1], 18 + 12 * std::sqrt(10.0), 1e-9);
  EXPECT_NEAR(curve.at("measured_parameters").at("viscosity"), 12 * std::pow(2.0, 0.75), 1e-9);
}

TEST_F(StudyCommand, RheometerSaysWhatIsWrong) {
  const std::string elastic =
      file("elastic.json", R"({"density": 1000, "bulk_modulus": 1e5, "shear_modulus": 1e4})");
  const std::string wrong = file("wrong.json", R"({"preset": "pie", "viscosty": 3})");
  const std::string snow = file("snow.json", R"({"model": "snow", "density": 400, "youngs_modulus": 1e5,
    "poisson_ratio": 0.2})");
  const std::pair<std::string, std::string> cases[] = {
      {snow, "of the model \"herschel-bulkley\" only"},
      {"shaving-crem", "Did you mean \"shaving-cream\""},
      {"missing.json", "missing.json"},
      {directory_.path().string() + "/", "directory"},
      {wrong, "/viscosty"},
      {"pie --rate -1", "--rate"},
      {"pie --rate 100 --time 100", "--time"},
      {"pie --steps 0", "--steps"},
      {"pie --rates 10:1", "LOWEST:HIGHEST"},
      {"pie --rates 1:10 --box", "--box"},
      {"pie --viscosity", "--rates"},
      {"pie --measured 18:12:0.4", "--rates"},
      {"pie --rates 1:10 --measured 18:12", "YIELD:CONSISTENCY:INDEX"},
      {"pie --steps 1000000000000", "--steps"},
      {"pie --time 0", "--time"},
      {"pie --chart curve.bmp", ".svg"},
      {elastic + " --rates 1:10", "yield"},
  };
  for (const auto& [arguments, words] : cases) {
    EXPECT_EQ(run("rheometer " + arguments), 2) << arguments;
    EXPECT_NE(said().find(words), std::string::npos) << arguments << ": " << said();
  }
}

TEST_F(StudyCommand, VerifyPrintsATableAndJson) {
  ASSERT_EQ(run("verify law"), 0) << said();
  EXPECT_NE(said().find("1 of 1 cases passed"), std::string::npos) << said();
  ASSERT_EQ(run("verify law --json"), 0);
  const Json result = Json::parse(said());
  EXPECT_EQ(result.at("passed"), true);
  EXPECT_EQ(result.at("cases")[0].at("name"), "law");
  EXPECT_GT(result.at("cases")[0].at("findings").size(), 0U);
}

TEST_F(StudyCommand, VerifyNamesItsCases) {
  EXPECT_EQ(run("verify flim"), 2);
  EXPECT_NE(said().find("Did you mean \"film\""), std::string::npos) << said();
}

TEST_F(StudyCommand, BenchSetsAScenesCostBesideThePapers) {
  const std::string papers = std::string("bench --papers ") + LATHER_SOURCE_DIR + "/docs/papers.json ";
  ASSERT_EQ(run(papers + "'falling block' --seconds 0.01 --threads 1 --json"), 0) << said();
  const Json rows = Json::parse(said()).at("papers");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].at("name"), "falling block");
  EXPECT_EQ(rows[0].at("printed"), Json::array({0.031, 0.031}));
  EXPECT_NEAR(rows[0].at("steps_per_frame"), 21, 1e-9);  // a frame of 1/48 s in steps of at most 1e-3 s
  EXPECT_GT(rows[0].at("seconds_per_frame"), 0);
  EXPECT_NE(run(papers + "no-such-scene"), 0);
  EXPECT_NE(said().find("falling block"), std::string::npos) << said();  // among those that there are
}

TEST_F(StudyCommand, TradeoffMeasuresKnobsOfACaseAndDrawsThem) {
  const std::string json = file("trade.json");
  const std::string chart = file("trade.png");
  const std::string arguments =
      "tradeoff mlsrk-couette --quick --knob safety-factor=0.2,0.4 --knob basis=linear,constant ";
  ASSERT_EQ(run(arguments + "--json " + json + " --chart " + chart), 0) << said();
  const Json result = Json::parse(read(json));
  const Json& points = result.at("subjects")[0].at("points");
  ASSERT_EQ(points.size(), 2U) << "as it is, and one combination of first values";
  EXPECT_EQ(points[1].at("settings").at("safety-factor"), 0.2);
  EXPECT_GT(points[1].at("seconds")[0], 0);
  EXPECT_LT(points[1].at("error"), points[0].at("error"));
  EXPECT_EQ(read(chart).compare(1, 3, "PNG"), 0);
  ASSERT_EQ(run(arguments + "--chart " + file("trade.svg")), 0) << said();
  EXPECT_EQ(read(file("trade.svg")).compare(0, 4, "<svg"), 0);
  EXPECT_EQ(run("tradeoff mlsrk-couete"), 2);
  EXPECT_NE(said().find("Did you mean \"mlsrk-couette\""), std::string::npos) << said();
  EXPECT_EQ(run("tradeoff couette --knob kernl"), 2);
  EXPECT_NE(said().find("Did you mean \"kernel\""), std::string::npos) << said();
  EXPECT_EQ(run("tradeoff couette --chart trade.bmp"), 2);
}

TEST_F(StudyCommand, NeedsAndForecastTellOfScenes) {
  const std::string scene = std::string(LATHER_SOURCE_DIR) + "/scenes/falling-block.json --size preview ";
  const std::string json = file("scenes.json");
  ASSERT_EQ(run("needs " + scene + "--seconds 0.05 --json " + json), 0) << said();
  const Json needs = Json::parse(read(json)).at("scenes")[0];
  EXPECT_EQ(needs.at("name"), "falling-block");
  EXPECT_GT(needs.at("materials")[0].at("fields").size(), 3U);
  EXPECT_GT(needs.at("stages").size(), 5U);
  ASSERT_EQ(run("forecast " + scene + "--seconds 0.05 --json " + json), 0) << said();
  const Json forecast = Json::parse(read(json)).at("scenes")[0];
  EXPECT_GT(forecast.at("predicted_seconds"), 0);
  EXPECT_GT(forecast.at("actual_seconds"), 0);
  EXPECT_EQ(forecast.at("predicted_point_steps"), forecast.at("point_steps"));
}

TEST_F(StudyCommand, ARunWithABudgetReportsWhatWasPredictedAndWhatItTook) {
  const std::string scene = std::string(LATHER_SOURCE_DIR) + "/scenes/falling-block.json --size preview ";
  ASSERT_EQ(
      run("run " + scene +
          "--set '/budget={\"seconds\": 1000}' --set /duration=0.05 --threads 1 --json --out " + file("out")),
      0)
      << said();
  EXPECT_NE(said().find("\"budget_seconds\":1000"), std::string::npos) << said();
  const Json budget = Json::parse(read(file("out") + "/report.json")).at("budget");
  EXPECT_EQ(budget.at("seconds"), 1000);
  EXPECT_EQ(budget.at("error"), nullptr);
  EXPECT_GT(budget.at("predicted_seconds"), 0);
  EXPECT_GT(budget.at("actual_seconds"), 0);
  const Json plan = Json::parse(read(file("out") + "/plan.json"));
  EXPECT_EQ(plan.at("choices").at("budget").at("quality"), budget.at("quality"));
  ASSERT_EQ(run("plan " + scene + "--set /quality=fine"), 0) << said();
  EXPECT_NE(said().find("quality        fine"), std::string::npos) << said();
  EXPECT_NE(said().find("/numerics/safety_factor"), std::string::npos) << said();
}

}  // namespace
}  // namespace lather::server
