// Scenes with next to nothing in them, or with what cannot be: each ends sound, or is refused with the place
// that is wrong.

#include <gtest/gtest.h>

#include <ostream>

#include "sim/plan/plan.h"
#include "sim/scene/value.h"
#include "sim/study/stability/invariants.h"

namespace lather::study {
namespace {

constexpr double kSpacing = 0.01;       // m
constexpr std::uint64_t kSteps = 2000;  // more than any of them needs

/// A block of foam six spacings wide above a floor, in a domain of twelve; `changes` are made to it.
Scene block_scene(Solver solver, std::vector<Override> changes) {
  static const char* const kBlock = R"({
    "lather": 1, "domain": {"min": [0, 0, 0], "max": [0.12, 0.12, 0.12]}, "duration": 0.02, "frame_rate": 500,
    "spacing": 0.01,
    "materials": [{"name": "foam", "density": 100, "bulk_modulus": 1e4, "shear_modulus": 300,
                   "yield_stress": 30, "viscosity": 10, "flow_index": 0.5}],
    "bodies": [{"name": "block", "material": "foam",
                "shape": {"type": "box", "size": [0.06, 0.06, 0.06], "translate": [0.06, 0.05, 0.06]}}],
    "obstacles": [{"name": "floor", "shape": {"type": "plane", "translate": [0, 0.01, 0]}, "friction": 0.5}]})";
  changes.insert(changes.begin(), {"/solver", solver == Solver::kMpm ? "mpm" : "mlsrk"});
  return parse_scene(kBlock, "", changes);
}

struct Case {
  std::string name;
  std::vector<Override> changes;
};

/// A body that is a box with its centre in the middle of the domain, a little off the lattice's planes.
Override box_of_spacings(double x, double y, double z) {
  const auto text = [](double spacings) { return std::to_string(spacings * kSpacing); };
  return {"/bodies/0/shape", R"({"type": "box", "translate": [0.065, 0.065, 0.065], "size": [)" + text(x) +
                                 "," + text(y) + "," + text(z) + "]}"};
}

std::string many_bodies(int count) {
  std::string list = "[";
  for (int i = 0; i < count; ++i)
    list += std::string(i == 0 ? "" : ",") + R"({"name": ")" + std::to_string(i) +
            R"(", "material": "foam", "shape": {"type": "sphere", )" + R"("radius": 0.0045, "translate": [)" +
            std::to_string(0.015 + 0.01 * (i % 10)) + "," + std::to_string(0.015 + 0.01 * (i / 10 % 10)) +
            "," + std::to_string(0.015 + 0.01 * (i / 100 % 10)) + "]}}";
  return list + "]";
}

std::vector<Case> sound_cases() {
  const std::string block = R"({"type": "box", "size": [0.06, 0.06, 0.06], "translate": [0.06, 0.05, 0.06]})";
  const std::string bigger =
      R"({"type": "box", "size": [0.07, 0.07, 0.07], "translate": [0.06, 0.05, 0.06]})";
  const auto jaw = [](const char* name, const char* x, const char* speed) {
    return std::string(R"({"name": ")") + name + R"(", "friction": 0.3, "shape": {"type": "box", )" +
           R"("size": [0.04, 0.1, 0.1], "translate": [)" + x + R"(, 0.06, 0.06]}, )" +
           R"("motion": {"type": "linear", "velocity": [)" + speed + ", 0, 0]}}";
  };
  return {
      {"OnePointOrFew", {box_of_spacings(0.6, 0.6, 0.6)}},
      {"ARowOfPoints", {box_of_spacings(4, 0.6, 0.6)}},
      {"ASheetThinnerThanTheSpacing", {box_of_spacings(8, 0.6, 8)}},
      {"TwoBodiesThatOverlap",
       {{"/bodies", R"([{"name": "one", "material": "foam", "shape": )" + block +
                        R"(}, {"name": "other", "material": "foam", "velocity": [1, 0, 0], "shape": )" +
                        bigger + "}]"}}},
      {"ABodyInsideAnObstacle",
       {{"/obstacles/0/shape",
         R"({"type": "box", "size": [0.2, 0.2, 0.2], "translate": [0.06, 0.06, 0.06]})"}}},
      {"ABodyInsideAnAdhesiveObstacle",
       {{"/obstacles/0", R"({"name": "jar", "adhesive": true, "shape": {"type": "sphere", "radius": 0.1,
                             "translate": [0.06, 0.06, 0.06]}})"}}},
      {"JawsThatCloseOnMaterial",
       {{"/obstacles", "[" + jaw("left", "0.01", "2") + "," + jaw("right", "0.11", "-2") + "]"}}},
      {"AllThatLeavesAnOpenDomain",
       {{"/domain/boundary", "open"}, {"/obstacles", "[]"}, {"/bodies/0/velocity", "[5, 5, 0]"}}},
      {"NothingThatActs", {{"/gravity", "[0, 0, 0]"}}},
      {"HardlyAnyTime", {{"/duration", "1e-9"}, {"/frame_rate", "1e9"}}},
      {"AThousandSpecks", {{"/bodies", many_bodies(1000)}, {"/duration", "0.004"}}},
      {"APlane",
       {{"/dimension", "2"},
        {"/domain", R"({"min": [0, 0], "max": [0.12, 0.12]})"},
        {"/gravity", "[0, -9.81]"},
        {"/bodies/0/shape", R"({"type": "box", "size": [0.06, 0.006], "translate": [0.06, 0.055]})"},
        {"/obstacles", "[]"}}},
  };
}

struct Named {
  Solver solver = Solver::kMpm;
  Case scene;
};

std::vector<Named> on_both_solvers(const std::vector<Case>& cases) {
  std::vector<Named> all;
  for (const Solver solver : {Solver::kMpm, Solver::kMlsrk})
    for (const Case& c : cases) all.push_back({solver, c});
  return all;
}

std::string name_of(const Named& named) {
  return named.scene.name + (named.solver == Solver::kMpm ? "_Mpm" : "_Mlsrk");
}
void PrintTo(const Named& named, std::ostream* out) {
  *out << name_of(named);
}

class Degenerate : public testing::TestWithParam<Named> {};

TEST_P(Degenerate, StaysSound) {
  const Verdict verdict = examine(block_scene(GetParam().solver, GetParam().scene.changes), {kSteps});
  EXPECT_EQ(verdict.outcome, Outcome::kHeld) << to_string(verdict.outcome) << ": " << verdict.why;
  EXPECT_GT(verdict.steps, 0U);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Degenerate, testing::ValuesIn(on_both_solvers(sound_cases())),
                         [](const auto& test) { return name_of(test.param); });

/// The pointer of the first problem with the scene; "" if it runs.
std::string refused_at(Solver solver, const std::vector<Override>& changes) {
  try {
    const Plan plan = make_plan(block_scene(solver, changes));
    return {};
  } catch (const InputError& error) {
    return error.problems().front().pointer;
  }
}

TEST(Refused, NamesThePlaceOfWhatCannotBe) {
  for (const Solver solver : {Solver::kMpm, Solver::kMlsrk}) {
    EXPECT_EQ(refused_at(solver, {{"/bodies", "[]"}}), "/bodies");
    EXPECT_EQ(refused_at(solver, {{"/materials", "[]"}}), "/materials");
    EXPECT_EQ(refused_at(solver, {{"/duration", "0"}}), "/duration");
    EXPECT_EQ(refused_at(solver, {{"/domain/max", "[0.01, 0.01, 0.01]"}}), "/spacing");
    EXPECT_EQ(refused_at(solver, {{"/bodies", many_bodies(1001)}}), "/bodies");
    EXPECT_EQ(refused_at(solver, {{"/bodies/0/shape/translate", "[9, 9, 9]"}}), "/bodies/0/shape");
    // Between the points of the lattice, and hidden by an earlier one.
    const std::string speck = R"({"type": "sphere", "radius": 1e-5, "translate": [0.061, 0.061, 0.061]})";
    EXPECT_EQ(refused_at(solver, {{"/bodies/0/shape", speck}}), "/bodies/0/shape");
    const std::string ball =
        R"("material": "foam", "shape": {"type": "sphere", "radius": 0.03, "translate": [0.06, 0.06, 0.06]}})";
    EXPECT_EQ(refused_at(solver, {{"/bodies",
                                   R"([{"name": "one", )" + ball + R"(, {"name": "other", )" + ball + "]"}}),
              "/bodies/1/shape");
  }
}

TEST(Refused, ADocumentOfAMillionBodiesEndsInAnErrorNotInTheMachine) {
  EXPECT_THROW(static_cast<void>(parse_json(many_bodies(1'000'000))), InputError);
}

}  // namespace
}  // namespace lather::study
