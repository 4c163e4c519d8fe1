#include "tests/unit/sim/shape/mesh_texts.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace lather::test {
namespace {

/// Corner i of a cube lies at the signs of its bits.
float corner(int i, int axis, double side) {
  return static_cast<float>((i >> axis & 1) != 0 ? 0.5 * side : -0.5 * side);
}

constexpr std::array<std::array<int, 3>, 12> kCube = {{{0, 2, 3},
                                                       {0, 3, 1},
                                                       {4, 5, 7},
                                                       {4, 7, 6},
                                                       {0, 1, 5},
                                                       {0, 5, 4},
                                                       {2, 6, 7},
                                                       {2, 7, 3},
                                                       {0, 4, 6},
                                                       {0, 6, 2},
                                                       {1, 3, 7},
                                                       {1, 7, 5}}};

}  // namespace

std::string ball_obj(double radius, int turns) {
  std::ostringstream obj;
  obj.precision(9);
  const int rings = turns / 2;
  for (int j = 0; j <= rings; ++j)
    for (int i = 0; i < turns; ++i) {
      const double up = M_PI * j / rings, around = 2 * M_PI * i / turns;
      // All points of a pole are one place.
      const double s = j == 0 || j == rings ? 0 : std::sin(up);
      obj << "v " << radius * s * std::cos(around) << ' ' << radius * std::cos(up) << ' '
          << radius * s * std::sin(around) << '\n';
    }
  for (int j = 0; j < rings; ++j)
    for (int i = 0; i < turns; ++i) {
      const int a = j * turns + i + 1, b = j * turns + (i + 1) % turns + 1;
      obj << "f " << a << "/1/1 " << b << "//2 " << b + turns << ' ' << a + turns << "/3\n";
    }
  return obj.str();
}

std::string cube_obj(double side) {
  std::ostringstream obj;
  obj << "# a cube\no cube\n";
  for (int i = 0; i < 8; ++i)
    obj << "v " << corner(i, 0, side) << ' ' << corner(i, 1, side) << ' ' << corner(i, 2, side) << "\r\n";
  for (const auto& t : kCube) obj << "f " << t[0] - 8 << ' ' << t[1] - 8 << ' ' << t[2] - 8 << '\n';
  return obj.str();
}

std::string cube_ply(double side, bool binary) {
  std::ostringstream ply;
  ply << "ply\nformat " << (binary ? "binary_little_endian" : "ascii")
      << " 1.0\ncomment a cube\nelement vertex 8\nproperty double z\nproperty uchar red\nproperty float "
         "x\nproperty "
         "float y\nelement face 12\nproperty list uchar int vertex_index\nproperty list uint8 float "
         "uv\nend_header\n";
  const auto put = [&](auto value) {
    if (binary)
      ply.write(reinterpret_cast<const char*>(&value), sizeof value);
    else
      ply << +value << ' ';
  };
  for (int i = 0; i < 8; ++i) {
    put(static_cast<double>(corner(i, 2, side)));
    put(static_cast<unsigned char>(200));
    put(corner(i, 0, side));
    put(corner(i, 1, side));
  }
  for (const auto& t : kCube) {
    put(static_cast<unsigned char>(3));
    for (const int i : t) put(static_cast<std::int32_t>(i));
    put(static_cast<unsigned char>(1));
    put(0.5F);
  }
  return ply.str();
}

}  // namespace lather::test
