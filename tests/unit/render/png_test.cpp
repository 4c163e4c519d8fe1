#include <gtest/gtest.h>

#include <map>

#include "render/render.h"

namespace lather::render {
namespace {

Image pattern(int width, int height) {
  Image image{width, height, {}};
  std::uint32_t random = 1;
  for (int i = 0; i < 3 * width * height; ++i) {
    random = random * 1664525U + 1013904223U;
    image.rgb.push_back(static_cast<std::uint8_t>((i / 7 + (random >> 29)) & 0xff));
  }
  return image;
}

const PngText kText = {std::string(64, 'a'), "0.1.0", "Rasierschaum \xc3\xbc", 0.125, 42};

TEST(Png, PixelsSurviveTheRoundTrip) {
  const Image image = pattern(37, 23);
  const Image back = decode_png(encode_png(image, kText));
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 23);
  EXPECT_EQ(back.rgb, image.rgb);
}

TEST(Png, TextChunksTellSceneVersionNameTimeAndFrame) {
  const auto list = png_text(encode_png(pattern(8, 8), kText));
  const std::map<std::string, std::string> texts(list.begin(), list.end());
  EXPECT_EQ(texts.at("lather:scene"), kText.scene_hash);
  EXPECT_EQ(texts.at("lather:version"), "0.1.0");
  EXPECT_EQ(texts.at("Title"), kText.scene_name);
  EXPECT_EQ(texts.at("lather:time"), "0.125");
  EXPECT_EQ(texts.at("lather:frame"), "42");
}

TEST(Png, TheSceneIsKeptWhole) {
  PngText text = kText;
  text.scene_json = R"({"name": "Rasierschaum \u00fc )" + std::string(20'000, 'a') + "\"}";
  const std::string png = encode_png(pattern(8, 8), text);
  const auto list = png_text(png);
  const std::map<std::string, std::string> texts(list.begin(), list.end());
  EXPECT_EQ(texts.at("lather:scene-json"), text.scene_json);
  EXPECT_LT(png.size(), 2'000U);  // compressed
}

TEST(Png, EmptyTextsAreLeftOut) {
  const auto texts = png_text(encode_png(pattern(8, 8), {"", "", "", 0, 0}));
  EXPECT_EQ(texts.size(), 2U);  // time and frame
}

TEST(Png, EveryTruncationIsRefused) {
  const std::string png = encode_png(pattern(16, 16), kText);
  for (std::size_t size = 0; size < png.size(); ++size)
    EXPECT_THROW((void)decode_png(png.substr(0, size)), std::runtime_error) << size;
}

TEST(Png, AFlippedBitInThePictureIsRefused) {
  const std::string png = encode_png(pattern(64, 64), kText);
  const std::size_t data = png.find("IDAT") + 4;
  for (std::size_t at = data; at < png.size() - 16; at += 97) {
    std::string damaged = png;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    EXPECT_THROW((void)decode_png(damaged), std::runtime_error) << at;
  }
}

TEST(Png, WhatIsNoPngIsRefused) {
  EXPECT_THROW((void)decode_png("GIF89a, not a PNG at all"), std::runtime_error);
}

}  // namespace
}  // namespace lather::render
