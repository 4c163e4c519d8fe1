// Qualities and budgets of scenes: what they set, what wins over them, what is refused.

#include "sim/scene/quality.h"

#include <gtest/gtest.h>

#include "sim/error.h"

namespace lather {
namespace {

Scene read(const std::string& keys, const std::string& numerics = {}) {
  return parse_scene(
      R"({"lather": 1, "domain": {"min": [0, 0, 0], "max": [1, 1, 1]}, "duration": 1, "spacing": 0.1,
    "materials": [{"name": "m", "preset": "shaving-cream", "tear_threshold": "infinity"}],
    "bodies": [{"name": "b", "material": "m", "shape": {"type": "box", "size": [0.5, 0.5, 0.5]}}])" +
      (keys.empty() ? "" : ", " + keys) + (numerics.empty() ? "" : R"(, "numerics": )" + numerics) + "}");
}

/// What is wrong with the scene, in words.
std::string problem_of(const std::string& keys) {
  try {
    static_cast<void>(read(keys));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const std::string kParticles = R"("solver": "mlsrk", "quality": ")";

TEST(Quality, SetsTheNumericsOfItsSolver) {
  for (const QualityPoint& point : quality_points(Solver::kMpm)) {
    const Scene scene = read(std::string(R"("quality": ")") + point.name + '"');
    EXPECT_EQ(scene.quality, point.quality);
    const Value numerics = *parse_json(to_json(scene)).find("numerics");
    const Value wanted = parse_json(point.numerics);
    EXPECT_EQ(write_json(*numerics.find("kernel")), write_json(*wanted.find("kernel"))) << point.name;
    EXPECT_EQ(write_json(*numerics.find("safety_factor")), write_json(*wanted.find("safety_factor")))
        << point.name;
  }
  for (const QualityPoint& point : quality_points(Solver::kMlsrk)) {
    const Numerics numerics = read(kParticles + point.name + '"').numerics;
    const Value wanted = parse_json(point.numerics);
    EXPECT_EQ(numerics.kernel, Numerics{}.kernel) << "of the other solver";
    EXPECT_EQ(numerics.mlsrk.kernel_shape, *wanted.find("mlsrk")->find("kernel_shape")->text() == "radial"
                                               ? KernelShape::kRadial
                                               : KernelShape::kTensor);
  }
}

TEST(Quality, IsOfNumericsOnly) {
  Scene scene = read(R"("quality": "reference")");
  const Scene plain = read("");
  scene.numerics = plain.numerics;
  scene.quality = Quality::kOwn;
  EXPECT_EQ(to_json(scene), to_json(plain));
}

TEST(Quality, WhatTheSceneSaysItselfWins) {
  const Scene scene = read(R"("quality": "draft")", R"({"safety_factor": 0.123, "flip_blend": 0.5})");
  EXPECT_EQ(scene.numerics.safety_factor, 0.123);
  EXPECT_EQ(scene.numerics.flip_blend, 0.5);
  EXPECT_EQ(scene.numerics.transfer, numerics_of(Solver::kMpm, Quality::kDraft).transfer);
  const Scene particles = read(kParticles + "draft\"", R"({"mlsrk": {"support_radius": 3.5}})");
  EXPECT_EQ(particles.numerics.mlsrk.support_radius, 3.5);
  EXPECT_EQ(particles.numerics.mlsrk.kernel_shape,
            numerics_of(Solver::kMlsrk, Quality::kDraft).mlsrk.kernel_shape);
}

TEST(Quality, CanBeChangedLater) {
  const Scene scene = read("", R"({"safety_factor": 0.123})");
  const Scene changed = with_quality(scene, Quality::kFine);
  EXPECT_EQ(to_json(changed), to_json(read(R"("quality": "fine")", R"({"safety_factor": 0.123})")));
}

TEST(Quality, IsWrittenAndReadAgain) {
  const Scene scene = read(R"("quality": "fine")", R"({"safety_factor": 0.123})");
  EXPECT_EQ(to_json(parse_scene(to_json(scene))), to_json(scene));
  EXPECT_EQ(to_json(read("")).find("quality"), std::string::npos) << "scenes without one keep their hash";
  EXPECT_EQ(to_json(read("")).find("budget"), std::string::npos);
}

TEST(Quality, UnknownOnesAreRefused) {
  EXPECT_NE(problem_of(R"("quality": "best")").find("reference"), std::string::npos);
  EXPECT_NE(problem_of(R"("quality": 3)"), "");
}

TEST(Budget, IsOfSecondsOrOfAnError) {
  EXPECT_EQ(read(R"("budget": {"seconds": 60})").budget->seconds, 60);
  EXPECT_EQ(read(R"("budget": {"error": 0.1})").budget->error, 0.1);
  EXPECT_FALSE(read(R"("budget": null)").budget);
  const Scene scene = read(R"("budget": {"seconds": 60})");
  EXPECT_EQ(to_json(parse_scene(to_json(scene))), to_json(scene));
  EXPECT_NE(problem_of(R"("budget": {})").find("one of the two"), std::string::npos);
  EXPECT_NE(problem_of(R"("budget": {"seconds": 1, "error": 1})").find("one of the two"), std::string::npos);
  EXPECT_NE(problem_of(R"("budget": {"seconds": 0})"), "");
  EXPECT_NE(problem_of(R"("budget": {"seconds": 1}, "quality": "fine")").find("take out"), std::string::npos);
}

}  // namespace
}  // namespace lather
