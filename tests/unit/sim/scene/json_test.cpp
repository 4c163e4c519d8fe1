#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sim/scene/value.h"

namespace lather::test {
namespace {

Problem refusal(const std::string& text) {
  try {
    (void)parse_json(text);
  } catch (const InputError& error) {
    return error.problems().front();
  }
  return {};
}

TEST(Json, NestedAHundredThousandDeepIsRefused) {
  EXPECT_EQ(refusal(std::string(100'000, '[')).allowed, "at most 32 levels");
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
  EXPECT_EQ(refusal(objects).allowed, "at most 32 levels");
  EXPECT_NO_THROW((void)parse_json(std::string(32, '[') + std::string(32, ']')));
  EXPECT_EQ(refusal(std::string(33, '[') + std::string(33, ']')).allowed, "at most 32 levels");
}

TEST(Json, WithTooManyValuesIsRefused) {
  std::string many = "[0";
  for (int i = 0; i < 200'000; ++i) many += ",0";
  EXPECT_EQ(refusal(many + "]").allowed, "at most 200000 values");
}

TEST(Json, WithALongTextOrKeyIsRefused) {
  const std::string longer(65'537, 'x');
  EXPECT_EQ(refusal("{\"a\": [1, \"" + longer + "\"]}").pointer, "/a/1");
  EXPECT_EQ(refusal("{\"" + longer + "\": 1}").allowed, "at most 65536 bytes");
  EXPECT_NO_THROW((void)parse_json("\"" + std::string(65'536, 'x') + "\""));
}

TEST(Json, WithAKeyTwiceIsRefusedWithItsPointer) {
  const Problem problem = refusal(R"({"a": [0, {"b/c": 1, "d": 2, "b/c": 3}]})");
  EXPECT_EQ(problem.pointer, "/a/1/b~1c");
  EXPECT_NE(problem.message.find("given twice"), std::string::npos);
}

TEST(Json, WithANumberBeyondDoublesIsRefused) {
  EXPECT_NE(refusal("[1e999]").message, "");
  EXPECT_NE(refusal("[NaN]").message, "");
  EXPECT_NE(refusal("[-Infinity]").message, "");
}

TEST(Json, WithInvalidUtf8IsRefusedInValidUtf8) {
  const Problem problem = refusal("{\"name\": \"caf\xe9\"}");
  EXPECT_NE(problem.message.find("UTF-8"), std::string::npos) << problem.message;
  for (const char c : problem.message + problem.value) EXPECT_GE(c, 0x20);
}

TEST(Json, SyntaxErrorsSayWhere) {
  const Problem problem = refusal("{\"a\": 1,\n \"b\": tru}");
  EXPECT_NE(problem.message.find("line 2"), std::string::npos) << problem.message;
  EXPECT_NE(problem.message.find("byte 19"), std::string::npos) << problem.message;
  EXPECT_NE(refusal("").message, "");
  EXPECT_NE(refusal("{} {}").message, "");
}

TEST(Json, NumbersReadBackAsTheSameBits) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> digits(-1, 1);
  std::uniform_int_distribution<int> exponent(-300, 300);
  for (int i = 0; i < 20'000; ++i) {
    const double x = digits(random) * std::pow(10.0, exponent(random));
    const Value back = parse_json(write_json(Value(x)));
    const auto* whole = std::get_if<std::int64_t>(&back.data);
    ASSERT_EQ(whole != nullptr ? static_cast<double>(*whole) : std::get<double>(back.data), x)
        << write_json(Value(x));
  }
  EXPECT_EQ(write_json(Value(0.003)), "0.003");
  EXPECT_EQ(write_json(Value(100000.0)), "100000");
  EXPECT_EQ(write_json(Value(1e30)), "1e+30");
  EXPECT_EQ(write_json(Value(-0.0)), "0");
}

TEST(MergePatch, FollowsTheExamplesOfItsStandard) {
  const std::vector<std::array<const char*, 3>> cases = {
      {R"({"a":"b"})", R"({"a":"c"})", R"({"a":"c"})"},
      {R"({"a":"b"})", R"({"b":"c"})", R"({"a":"b","b":"c"})"},
      {R"({"a":"b"})", R"({"a":null})", R"({})"},
      {R"({"a":"b","b":"c"})", R"({"a":null})", R"({"b":"c"})"},
      {R"({"a":["b"]})", R"({"a":"c"})", R"({"a":"c"})"},
      {R"({"a":{"b":"c"}})", R"({"a":{"b":"d","c":null}})", R"({"a":{"b":"d"}})"},
      {R"({"a":[{"b":"c"}]})", R"({"a":[1]})", R"({"a":[1]})"},
      {R"(["a","b"])", R"(["c","d"])", R"(["c","d"])"},
      {R"({"e":null})", R"({"a":1})", R"({"e":null,"a":1})"},
      {R"([1,2])", R"({"a":"b","c":null})", R"({"a":"b"})"},
      {R"({})", R"({"a":{"bb":{"ccc":null}}})", R"({"a":{"bb":{}}})"},
  };
  for (const auto& [target, patch, result] : cases) {
    Value value = parse_json(target);
    merge_patch(value, parse_json(patch));
    EXPECT_EQ(write_json(value), result) << target << " with " << patch;
  }
}

TEST(Pointer, FindsAndSetsEscapedKeysAndElements) {
  Value root = parse_json(R"({"a/b": {"m~n": [1, 2]}})");
  ASSERT_NE(at_pointer(root, "/a~1b/m~0n/1"), nullptr);
  set_at_pointer(root, "/a~1b/m~0n/1", 5.5);
  set_at_pointer(root, "/new/inner", true);
  EXPECT_EQ(write_json(root), R"({"a/b":{"m~n":[1,5.5]},"new":{"inner":true}})");
  set_at_pointer(root, "/a~1b", nullptr);
  EXPECT_EQ(write_json(root), R"({"new":{"inner":true}})");
  EXPECT_EQ(at_pointer(root, "/new/outer"), nullptr);
}

TEST(Pointer, ThatLeadsNowhereIsRefused) {
  Value root = parse_json(R"({"list": [1], "number": 1})");
  EXPECT_THROW(set_at_pointer(root, "list", 1.0), InputError);
  EXPECT_THROW(set_at_pointer(root, "/list/1", 1.0), InputError);
  EXPECT_THROW(set_at_pointer(root, "/list/00", 1.0), InputError);
  EXPECT_THROW(set_at_pointer(root, "/number/x", 1.0), InputError);
  EXPECT_THROW(set_at_pointer(root, "/a~2b", 1.0), InputError);
}

}  // namespace
}  // namespace lather::test
