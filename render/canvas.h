#pragma once

#include <string_view>

#include "render/render.h"
#include "render/rgba.h"

namespace lather::render {

inline constexpr int kGlyphWidth = 5, kGlyphHeight = 7;  ///< dots; glyphs stand 6 dots apart

/// Width in px of a line of text whose dots are squares of `dot` px.
[[nodiscard]] int text_width(std::string_view text, int dot);

/// Flat shapes and text on a finished picture. Coordinates are px from the top left; what lies outside is cut
/// off.
class Canvas {
 public:
  explicit Canvas(Image& image) : image_(image) {}
  void fill(int left, int top, int width, int height, const Rgba& color);
  /// Printable ASCII; anything else becomes a box.
  void text(int left, int top, std::string_view text, int dot, const Rgba& color);

 private:
  Image& image_;
};

}  // namespace lather::render
