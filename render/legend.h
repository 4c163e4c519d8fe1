#pragma once

#include <string>
#include <vector>

#include "render/point_colors.h"
#include "render/render.h"

namespace lather::render {

/// Round values (1, 2 or 5 times a power of ten apart) within [low, high], three to seven of them.
[[nodiscard]] std::vector<double> tick_values(double low, double high);

/// The shortest text that tells ticks `step` apart: "0.25", "1.5e-06", "-3".
[[nodiscard]] std::string tick_text(double value, double step);

/// Draws the bar with its ticks, name and unit at the right side of the picture.
void draw_legend(Image& image, const ColorScale& scale);

}  // namespace lather::render
