// Emitters: what comes in, when, and that nothing is lost or doubled.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/support/run_scene.h"

namespace lather {
namespace {

using testing_support::run;

/// A slip box of 0.4 m without gravity and bodies; the foam is soft, so that a step of 1 ms holds.
std::string box_with(const std::string& emitter) {
  return R"({"lather": 1, "domain": {"min": [0, 0, 0], "max": [0.4, 0.4, 0.4]}, "gravity": [0, 0, 0],
    "duration": 0.2, "frame_rate": 20, "spacing": 0.025, "jitter": 0.2,
    "materials": [{"name": "foam", "preset": "shaving-cream", "bulk_modulus": 2000}],
    "numerics": {"time_step": 1e-3}, "emitters": [)" +
         emitter + "]}";
}

constexpr const char* kDrops =
    R"({"name": "drops", "material": "foam", "shape": {"type": "sphere", "radius": 0.04, "translate": [0.2, 0.3, 0.2]},
        "velocity": [0, -2, 0], "start": 0.03, "interval": 0.06, "count": 3})";

TEST(Emission, CopiesComeAtTheirTimesAndAllWeighTheSame) {
  const Plan plan = make_plan(parse_scene(box_with(kDrops)));
  const auto simulation = Simulation::create(plan, 1);
  const auto go_on = [](const Progress&) { return true; };
  std::vector<std::uint64_t> seen;
  for (int f = 0; f < plan.frames; ++f) {
    simulation->step_to_frame(f, go_on);
    seen.push_back(simulation->report().frames.back().points);
  }
  // Releases at 0.03, 0.09 and 0.15 s; frames every 0.05 s. The last comes with the step that starts at
  // 0.15 s, after that frame.
  const std::uint64_t copy = seen[1];
  ASSERT_GT(copy, 100U);
  EXPECT_EQ(seen, (std::vector<std::uint64_t>{0, copy, 2 * copy, 2 * copy, 3 * copy}));
  EXPECT_EQ(plan.points, 3 * copy);
  EXPECT_EQ(plan.points_emitted, 3 * copy);
  const Report& r = simulation->report();
  ASSERT_EQ(r.emitters.size(), 1U);
  EXPECT_EQ(r.emitters[0].releases, 3U);
  EXPECT_EQ(r.emitters[0].delayed, 0U);
  // The mass of a point is rounded to a float once.
  EXPECT_NEAR(r.frames.back().mass, r.frames.back().mass_emitted, 6e-8 * r.frames.back().mass);
}

TEST(Emission, ACopyIsTheBodyOfTheSameShapeMoved) {
  // Emitted at t = 0 without jitter, a copy runs as the body does, but for the order of its first sort.
  const std::string body =
      R"({"name": "b", "material": "foam", "velocity": [0.5, -1, 0.25], "spin_deg": [90, 0, 720],
          "shape": {"type": "sphere", "radius": 0.06, "translate": [0.2, 0.25, 0.2]}})";
  std::vector<Override> set;
  set.push_back({"/jitter", "0"});
  const Report emitted = run(box_with(body), set);
  set.push_back({"/bodies", '[' + body + ']'});
  set.push_back({"/emitters", "[]"});
  const Report present = run(box_with(body), set);
  EXPECT_EQ(emitted.frames.back().fingerprint, present.frames.back().fingerprint);
  EXPECT_EQ(present.frames.back().points_emitted, 0U);
}

TEST(Emission, AReleaseWaitsUntilItsPlaceIsFree) {
  // Slow drops: each needs 0.1 m / (1 m/s) = 0.1 s to clear a place of radius 0.04 m and half a distance of
  // points, twice the interval.
  std::vector<Override> set;
  set.push_back({"/emitters/0/velocity", "[0, -1, 0]"});
  set.push_back({"/emitters/0/interval", "0.03"});
  set.push_back({"/emitters/0/start", "0"});
  const Report r = run(box_with(kDrops), set);
  EXPECT_EQ(r.emitters[0].releases, 3U);
  EXPECT_EQ(r.emitters[0].delayed, 2U);
  // Each copy must fall one diameter and half a distance of points, 0.08625 m, less what the lattice leaves
  // free (a distance of points at either end): between 0.062 and 0.087 s after the one before it. Due at 0.03
  // and 0.06 s, so the two waited 3 times that time less 0.09 s.
  EXPECT_GT(r.emitters[0].waited, 3 * 0.062 - 0.09 - 2e-3);
  EXPECT_LT(r.emitters[0].waited, 3 * 0.087 - 0.09 + 2e-3);
  // Nothing overlaps: no density above rest but for what the impact on the floor packs.
  EXPECT_LT(r.frames[2].max_volume_ratio, 1.05);
  EXPECT_GT(r.frames[2].min_volume_ratio, 0.95);
}

TEST(Emission, ABlockedPlaceNeverGetsItsRelease) {
  const Report r = run(box_with(kDrops), {{"/emitters/0/velocity", "[0, 0, 0]"}});
  EXPECT_EQ(r.emitters[0].releases, 1U);
  EXPECT_EQ(r.emitters[0].delayed, 1U);
  EXPECT_TRUE(r.emitters[0].waiting);
  EXPECT_EQ(r.frames.back().points_emitted, r.frames.back().points);
}

constexpr const char* kStream =
    R"({"name": "inlet", "material": "foam", "shape": {"type": "box", "size": [0.1, 0.025, 0.1], "translate": [0.2, 0.3, 0.2]},
        "velocity": [0, -1, 0], "stream": true})";

TEST(Emission, AStreamIsAColumnAtRestDensity) {
  const Report r = run(box_with(kStream), {{"/jitter", "0"}});
  // The opening holds two layers of 8 x 8 points. Later ones come every 13 steps of 1 ms, the last at 0.195
  // s, when the lattice has moved by 0.195 m. Its next layer stood 6.25 mm above the opening, the others 12.5
  // mm apart: floor((195 - 6.25)/12.5) + 1 = 16 have come in, just what the velocity brings.
  EXPECT_EQ(r.frames.back().points_emitted, 64U * (2 + 16));
  // The layers keep their distance: the column is as long as 17 layers (less its fall on the floor).
  const FrameMeasure& half = r.frames[2];
  EXPECT_NEAR(half.max_speed, 1, 0.02);
  EXPECT_NEAR(half.min_volume_ratio, 1, 0.02);
  EXPECT_NEAR(half.max_volume_ratio, 1, 0.02);
  EXPECT_NEAR(half.highest.y() - half.lowest.y(), 0.1 * 1 + 0.0125, 0.0131);
  EXPECT_EQ(r.emitters[0].delayed, 0U);
}

TEST(Emission, AStreamHaltsWhileItsPlaceIsOccupied) {
  // The box is closed below the inlet and fills up.
  std::vector<Override> set;
  set.push_back({"/domain", R"({"min": [0.15, 0.2, 0.15], "max": [0.25, 0.4, 0.25]})"});
  set.push_back({"/emitters/0/velocity", "[0, -2, 0]"});
  const Report r = run(box_with(kStream), set);
  // Nine layers of 64 points fill what lies below the inlet's upper face, 16 the whole box; the ram pressure,
  // rho v^2 = 311 Pa, squeezes the foam by 14 %: at most 19. Without halting, 34 layers would come.
  EXPECT_GE(r.frames.back().points_emitted, 9U * 64);
  EXPECT_LE(r.frames.back().points_emitted, 19U * 64);
  EXPECT_GT(r.emitters[0].delayed, 0U);
  EXPECT_GT(r.emitters[0].waited, 0.05);
}

/// Two emitters and a body of two materials in an open box that everything leaves in the end.
std::string busy(const char* precision, int dimension) {
  const std::string flat = dimension == 2 ? "0" : "0.2";
  return R"({"lather": 1, "domain": {"min": [0, 0, 0], "max": [0.4, 0.4, 0.4], "boundary": "open", "periodic": [true, false, false]},
    "dimension": )" +
         std::to_string(dimension) +
         R"(, "duration": 0.3, "frame_rate": 20, "spacing": 0.025, "jitter": 0.3, "seed": 5,
    "materials": [{"name": "foam", "preset": "shaving-cream", "bulk_modulus": 2000}, {"name": "goo", "preset": "pie", "bulk_modulus": 2000}],
    "bodies": [{"name": "b", "material": "goo", "velocity": [3, 0, 0], "shape": {"type": "sphere", "radius": 0.05, "translate": [0.1, 0.3, )" +
         flat + R"(]}}],
    "emitters": [
      {"name": "drops", "material": "goo", "velocity": [0, -3, 0], "spin_deg": [0, 0, 90], "interval": 0.05, "count": 100,
       "shape": {"type": "sphere", "radius": 0.05, "translate": [0.3, 0.2, )" +
         flat + R"(]}},
      {"name": "stream", "material": "foam", "velocity": [0.5, -2, 0], "stream": true, "start": 0.02, "end": 0.2,
       "shape": {"type": "box", "size": [0.06, 0.03, 0.1], "translate": [0.1, 0.2, )" +
         flat + R"(]}}],
    "numerics": {"precision": ")" +
         precision + R"(", "time_step": 1e-3}})";
}

TEST(Emission, EmittedAndFirstPointsArePresentOrHaveLeftExactly) {
  for (const int dimension : {2, 3})
    for (const char* precision : {"float", "double"}) {
      const Report r = run(busy(precision, dimension), {});
      for (const FrameMeasure& m : r.frames)
        EXPECT_EQ(r.frames[0].points + m.points_emitted, m.points + m.points_left) << m.frame;
      EXPECT_GT(r.frames.back().points_left, 0U);
      EXPECT_GT(r.frames.back().points_emitted, r.frames[0].points);
      EXPECT_EQ(r.emitters[0].points + r.emitters[1].points, r.frames.back().points_emitted);
      // Masses are products of counts: equal but for the order of their sums.
      const FrameMeasure& m = r.frames.back();
      EXPECT_NEAR(r.frames[0].mass + m.mass_emitted, m.mass + m.mass_left, 1e-9 * m.mass_emitted);
    }
}

TEST(Emission, IdsAreUniqueOverTheRun) {
  const Plan plan = make_plan(parse_scene(busy("float", 3)));
  const auto simulation = Simulation::create(plan, 2);
  std::set<std::uint32_t> before;
  for (int f = 0; f < plan.frames; ++f) {
    simulation->step_to_frame(f, [](const Progress&) { return true; });
    const Frame frame = simulation->frame();
    const std::set<std::uint32_t> ids(frame.points.id.begin(), frame.points.id.end());
    EXPECT_EQ(ids.size(), frame.points.size());
    for (const std::uint32_t id : ids) {  // an id that is gone does not come back
      const bool is_new = !before.empty() && before.count(id) == 0;
      EXPECT_TRUE(!is_new || id > *before.rbegin()) << id;
    }
    before.insert(ids.begin(), ids.end());
  }
}

TEST(Emission, IsBitEqualForAnyNumberOfThreadsAndAfterRestoringAtAnyFrame) {
  for (const char* precision : {"float", "double"}) {
    const Plan plan = make_plan(parse_scene(busy(precision, 3)));
    const auto go_on = [](const Progress&) { return true; };
    const auto whole = Simulation::create(plan, 1);
    std::vector<std::string> saved;
    for (int f = 0; f < plan.frames; ++f) {
      int left = 4;  // stop between frames, too
      whole->step_to_frame(f, [&](const Progress&) { return --left > 0; });
      saved.push_back(whole->save());
      whole->step_to_frame(f, go_on);
    }
    const FrameMeasure& end = whole->report().frames.back();
    for (std::size_t f = 0; f < saved.size(); f += precision[0] == 'f' ? 1 : 3) {
      const auto resumed = Simulation::create(plan, 3);
      resumed->restore(saved[f]);
      for (int g = 0; g < plan.frames; ++g) resumed->step_to_frame(g, go_on);
      EXPECT_EQ(resumed->report().frames.back().fingerprint, end.fingerprint) << f;
      EXPECT_EQ(resumed->report().frames.back().points_emitted, end.points_emitted);
      EXPECT_EQ(resumed->report().emitters[1].points, whole->report().emitters[1].points);
    }
  }
}

TEST(Emission, AnEmitterWithoutPointsOrWithTooManyIsRefusedByThePlan) {
  const auto pointer_of = [](const std::string& pointer, const std::string& json) -> std::string {
    try {
      (void)make_plan(parse_scene(box_with(kDrops), "", {{pointer, json}}));
    } catch (const InputError& error) {
      return error.problems().at(0).pointer;
    }
    return "";
  };
  EXPECT_EQ(pointer_of("/emitters/0/shape/translate", "[2, 2, 2]"), "/emitters/0/shape");
  EXPECT_EQ(pointer_of("/emitters/0/shape/radius", "0.001"), "/emitters/0/shape");
  EXPECT_EQ(pointer_of("/emitters/0",
                       R"({"name": "flood", "material": "foam", "velocity": [0, -1e6, 0], "stream": true,
      "shape": {"type": "box", "size": [0.4, 0.4, 0.4], "translate": [0.2, 0.2, 0.2]}})"),
            "/emitters/0");
}

TEST(Emission, ASceneWithoutEmittersHasNoSuchStage) {
  const Plan plan = make_plan(parse_scene(testing_support::ball_scene()));
  EXPECT_EQ(plan.points_emitted, 0U);
  EXPECT_EQ(plan.stages.front(), "sort");
  EXPECT_EQ(make_plan(parse_scene(box_with(kDrops))).stages.front(), "emit");
}

}  // namespace
}  // namespace lather
