#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "render/render.h"
#include "tests/unit/render/sample_frames.h"

namespace lather::render {
namespace {

TEST(Picture, X) {
  for (int n : {50000}) {
    const Frame frame = dollop_under_block(n);
    for (const char* by : {"material", "speed"}) {
      Look look;
      look.color_by = by; if (getenv("PS")) look.point_scale = atof(getenv("PS"));
      Output output;
      auto renderer = Renderer::create(Backend::kOsmesa, look, output);
      std::printf("%s, %zu points\n", renderer->backend().c_str(), frame.points.size());
      std::string png;
      for (int i = 0; i < 2; ++i) png = renderer->draw_png(frame, {"abc", "0.1", "x", 0, 0});
      for (const auto& [name, seconds] : renderer->pass_times()) std::printf("%s %.3f\n", name.c_str(), seconds);
      std::printf("%zu bytes\n", png.size());
      std::ofstream("out_" + std::string(by) + std::to_string(n) + ".png", std::ios::binary) << png;
    }
  }
}

}  // namespace
}  // namespace lather::render
