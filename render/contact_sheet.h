#pragma once

#include <string>
#include <vector>

#include "render/render.h"

namespace lather::render {

/// Pictures of one run, in order of time.
struct SheetRow {
  std::string title;
  struct Picture {
    Image image;
    double time = 0;  ///< s
  };
  std::vector<Picture> pictures;
};

inline constexpr int kLargestSheet = 16'384;  ///< px, of either side

/// The picture at another size: each pixel is the mean of the light (not of the sRGB values) that falls on
/// it. It may be smaller, not larger.
[[nodiscard]] Image reduced(const Image& image, int width, int height);

/// All rows on one picture, each picture `width` px wide (no more than the pictures are), captioned with its
/// time, under its row's title. Heights follow each row's first picture. Throws InputError where that is
/// larger than kLargestSheet.
[[nodiscard]] Image contact_sheet(const std::vector<SheetRow>& rows, int width);

}  // namespace lather::render
