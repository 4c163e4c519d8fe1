// Random scenes over all that a scene may hold: none breaks what none may break. `lather soak` runs others.

#include "sim/study/soak/soak.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>

#include "sim/scene/value.h"

namespace lather::study {
namespace {

void expect_none_breaks(std::uint64_t seed, std::uint64_t scenes, std::uint64_t most_steps) {
  std::array<std::uint64_t, 4> counts = {};
  for (std::uint64_t i = 0; i < scenes; ++i) {
    const Soaked soaked = soak(seed, i, most_steps);
    ++counts[static_cast<std::size_t>(soaked.verdict.outcome)];
    EXPECT_NE(soaked.verdict.outcome, Outcome::kBroken) << "scene " << i << ": " << soaked.verdict.why << "\n"
                                                        << soaked.scene.document;
    // Scenes that cannot be planned are not drawn.
    EXPECT_NE(soaked.verdict.outcome, Outcome::kRefused) << soaked.verdict.why << "\n"
                                                         << soaked.scene.document;
  }
  std::printf("%llu scenes: %llu held, %llu stopped with an error\n", static_cast<unsigned long long>(scenes),
              static_cast<unsigned long long>(counts[0]), static_cast<unsigned long long>(counts[2]));
  // A program that stops at whatever it is given would not break either.
  EXPECT_GT(2 * counts[0], scenes);
}

TEST(Soak, NoneOfAHundredRandomScenesBreaks) {
  expect_none_breaks(1, 100, 60);
}

TEST(LongSoak, NoneOfThousandsOfRandomScenesBreaks) {
  expect_none_breaks(2, 2500, 200);
}

void add_keys(const Value& value, std::set<std::string>& keys) {
  if (const Object* object = value.object())
    for (const auto& [key, member] : *object) {
      keys.insert(key);
      add_keys(member, keys);
    }
  if (const Array* list = value.array())
    for (const Value& item : *list) add_keys(item, keys);
}

/// Keys of all properties that a schema names, at any depth.
void add_properties(const Value& schema, std::set<std::string>& keys) {
  if (const Value* properties = schema.find("properties"))
    for (const auto& [key, field] : *properties->object()) keys.insert(key);
  if (const Object* object = schema.object())
    for (const auto& [key, member] : *object) add_properties(member, keys);
  if (const Array* list = schema.array())
    for (const Value& item : *list) add_properties(item, keys);
}

TEST(RandomScenes, HoldEveryFieldThatASceneMayHold) {
  std::set<std::string> drawn;
  int refusals = 0;
  constexpr int kScenes = 600;
  for (std::uint64_t i = 0; i < kScenes; ++i) {
    const RandomScene random = random_scene(3, i, 100);
    refusals += random.refusals;
    add_keys(parse_json(random.document), drawn);
  }
  std::set<std::string> wanted;
  add_properties(parse_json(scene_schema()), wanted);
  // Sizes change a scene before it is read; points_per_cell is left at its default so that scenes stay small.
  for (const char* const left_out : {"sizes", "points_per_cell"}) wanted.erase(left_out);
  for (const std::string& key : wanted) EXPECT_TRUE(drawn.count(key) > 0) << key;
  std::printf("%zu fields in %d scenes; %d changes to what was drawn\n", wanted.size(), kScenes, refusals);
}

TEST(RandomScenes, AreTheSameForTheSameSeedAndIndex) {
  EXPECT_EQ(random_scene(5, 7, 100).document, random_scene(5, 7, 100).document);
  EXPECT_NE(random_scene(5, 7, 100).document, random_scene(5, 8, 100).document);
  EXPECT_NE(random_scene(5, 7, 100).document, random_scene(6, 7, 100).document);
}

}  // namespace
}  // namespace lather::study
