#include "render/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "render/canvas.h"
#include "sim/error.h"

namespace lather::render {
namespace {

constexpr int kGap = 6;    // px, between pictures
constexpr int kTitle = 2;  // px, of a title's dots
constexpr int kTime = 1;   // px, of a caption's dots
constexpr Rgba kPaper = {255, 255, 255, 255};
constexpr Rgba kInk = {40, 40, 44, 255};

float linear(std::uint8_t s) {
  const float v = static_cast<float>(s) / 255;
  return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

std::uint8_t encoded(float light) {
  const float s = light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1 / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(s, 0.0F, 1.0F)));
}

/// Which source pixels fall on one of the reduced picture's, along an axis, and how much of each.
struct Span {
  int first = 0;
  std::vector<float> share;  // sums to 1
};

std::vector<Span> spans(int from, int to) {
  std::vector<Span> all(static_cast<std::size_t>(to));
  const double ratio = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    Span& span = all[static_cast<std::size_t>(i)];
    const double low = i * ratio;
    const double high = std::min((i + 1) * ratio, static_cast<double>(from));
    span.first = static_cast<int>(low);
    for (int p = span.first; p < high; ++p)
      span.share.push_back(
          static_cast<float>((std::min(high, p + 1.0) - std::max(low, double(p))) / (high - low)));
  }
  return all;
}

void paste(const Image& from, Image& to, int left, int top) {
  for (int y = 0; y < from.height; ++y)
    std::copy_n(from.rgb.begin() + std::ptrdiff_t{3} * y * from.width, 3 * from.width,
                to.rgb.begin() + std::ptrdiff_t{3} * ((top + y) * to.width + left));
}

int row_height(const SheetRow& row, int width) {
  const Image& first = row.pictures.front().image;
  return std::max(1, static_cast<int>(std::lround(static_cast<double>(first.height) * width / first.width)));
}

}  // namespace

Image reduced(const Image& image, int width, int height) {
  std::array<float, 256> light{};
  for (int s = 0; s < 256; ++s) light[static_cast<std::size_t>(s)] = linear(static_cast<std::uint8_t>(s));
  const std::vector<Span> columns = spans(image.width, width);
  const std::vector<Span> lines = spans(image.height, height);
  Image out{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height))};
  auto to = out.rgb.begin();
  for (const Span& line : lines)
    for (const Span& column : columns)
      for (int c = 0; c < 3; ++c) {
        float sum = 0;
        for (std::size_t j = 0; j < line.share.size(); ++j)
          for (std::size_t i = 0; i < column.share.size(); ++i) {
            const auto at = static_cast<std::size_t>(line.first) + j;
            const auto pixel =
                at * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(column.first) + i;
            sum +=
                line.share[j] * column.share[i] * light[image.rgb[3 * pixel + static_cast<std::size_t>(c)]];
          }
        *to++ = encoded(sum);
      }
  return out;
}

Image contact_sheet(const std::vector<SheetRow>& rows, int width) {
  constexpr int kTitleHeight = kGlyphHeight * kTitle + 2 * kGap;
  constexpr int kCaptionHeight = kGlyphHeight * kTime + kGap;
  std::size_t most = 0;
  std::int64_t wanted = kGap;
  for (const SheetRow& row : rows) {
    most = std::max(most, row.pictures.size());
    wanted += kTitleHeight + row_height(row, width) + kCaptionHeight;
  }
  const std::int64_t across = kGap + static_cast<std::int64_t>(most) * (width + kGap);
  if (across > kLargestSheet || wanted > kLargestSheet)
    throw InputError({{"", std::to_string(across) + " x " + std::to_string(wanted) + " px",
                       "a sheet of at most " + std::to_string(kLargestSheet) + " px a side",
                       "Take fewer runs, fewer pictures of each, or a smaller --width."}});
  const auto height = static_cast<int>(wanted);
  const auto sheet_width = static_cast<int>(across);
  Image sheet{sheet_width, height,
              std::vector<std::uint8_t>(static_cast<std::size_t>(3 * sheet_width * height))};
  Canvas canvas(sheet);
  canvas.fill(0, 0, sheet_width, height, kPaper);
  int top = kGap;
  for (const SheetRow& row : rows) {
    const int high = row_height(row, width);
    canvas.text(kGap, top + kGap, row.title, kTitle, kInk);
    top += kTitleHeight;
    int left = kGap;
    for (const SheetRow::Picture& picture : row.pictures) {
      paste(reduced(picture.image, width, high), sheet, left, top);
      std::array<char, 32> caption{};
      std::snprintf(caption.data(), caption.size(), "%.3g s", picture.time);
      canvas.text(left, top + high + kGap / 2, caption.data(), kTime, kInk);
      left += width + kGap;
    }
    top += high + kCaptionHeight;
  }
  return sheet;
}

}  // namespace lather::render
