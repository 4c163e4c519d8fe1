#include "render/mesh_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "render/point_colors.h"
#include "render/shaders.h"

namespace lather::render {
namespace {

constexpr double kFloorKind = 0.25, kBackdropKind = 0.5;  // see shaders_screen.cpp

const std::array<Vec3, 4> kObstacleColors = {Vec3(0.46, 0.33, 0.24), Vec3(0.38, 0.42, 0.47),
                                             Vec3(0.52, 0.46, 0.34), Vec3(0.36, 0.42, 0.37)};

Mat4 world_from_object(const Pose& pose) {
  Mat4 m = Mat4::Identity();
  m.topLeftCorner<3, 3>() = pose.rotation.toRotationMatrix();
  m.topRightCorner<3, 1>() = pose.translation;
  return m;
}

/// 1, 2 or 5 times a power of ten, so that about ten cells span `length`.
double checker_cell(double length) {
  const double rough = std::max(length, 1e-9) / 10;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0})
    if (rough <= step * power) return step * power;
  return 10 * power;
}

std::array<float, 3> as_float(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// A triangle strip: the floor out to where it fades away, or the domain's back in 2D.
std::vector<std::array<float, 3>> ground_strip(const Shot& shot, const Box3& domain) {
  std::vector<std::array<float, 3>> strip;
  for (int i = 0; i < 4; ++i) {
    const double a = i & 1 ? 1 : -1, b = i & 2 ? 1 : -1;
    const Vec3 half = 0.5 * domain.extent();
    if (shot.flat)
      strip.push_back(
          as_float({domain.center().x() + a * half.x(), domain.center().y() + b * half.y(),
                    std::min(domain.min.z(), shot.content.min.z()) - 0.1 * half.head<2>().maxCoeff()}));
    else
      strip.push_back(as_float(shot.floor_center + shot.floor_fade * Vec3(a, 0, b)));
  }
  return strip;
}

}  // namespace

struct MeshPass::Uploaded {
  Uploaded(const Gl& gl, const TriangleMesh& mesh)
      : vertices(gl),
        positions(gl),
        normals(gl),
        triangles(gl),
        indices(static_cast<GLsizei>(3 * mesh.triangles.size())) {
    vertices.bind();
    positions.upload(GL_ARRAY_BUFFER, mesh.positions);
    gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl.EnableVertexAttribArray(0);
    normals.upload(GL_ARRAY_BUFFER, mesh.normals);
    gl.VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl.EnableVertexAttribArray(1);
    triangles.upload(GL_ELEMENT_ARRAY_BUFFER, mesh.triangles);
  }
  void draw(const Gl& gl) const {
    vertices.bind();
    gl.DrawElements(GL_TRIANGLES, indices, GL_UNSIGNED_INT, nullptr);
  }
  VertexArray vertices;
  Buffer positions, normals, triangles;
  GLsizei indices;
};

MeshPass::MeshPass(const Gl& gl)
    : gl_(gl),
      mesh_(gl, "mesh", shaders::mesh().vertex, shaders::mesh().fragment),
      shadow_(gl, "mesh shadow", shaders::mesh_shadow().vertex, shaders::mesh_shadow().fragment),
      ground_(gl, "ground", shaders::ground().vertex, shaders::ground().fragment),
      ground_vertices_(gl),
      ground_positions_(gl) {}

MeshPass::~MeshPass() = default;

void MeshPass::upload(const Frame& frame, const Look& look) {
  decltype(meshes_) kept;
  things_.clear();
  const auto add = [&](const std::shared_ptr<const TriangleMesh>& mesh, const Mat4& place,
                       const Vec3& color) {
    if (!mesh || mesh->triangles.empty()) return;
    auto& slot = kept[mesh];
    if (!slot) {
      const auto known = meshes_.find(mesh);
      slot = known != meshes_.end() ? std::move(known->second) : std::make_unique<Uploaded>(gl_, *mesh);
    }
    things_.push_back({slot.get(), place, color});
  };
  std::size_t index = 0;
  for (const FrameObstacle& obstacle : frame.obstacles)
    add(obstacle.mesh, world_from_object(obstacle.pose), kObstacleColors[index++ % kObstacleColors.size()]);
  if (look.style == "skin")
    for (const FrameSkin& skin : frame.skins) {
      const std::array<double, 3> color = material_color(look, skin.material);
      add(skin.mesh, Mat4::Identity(), Vec3(color[0], color[1], color[2]));
    }
  meshes_ = std::move(kept);
}

void MeshPass::draw(const Shot& shot, const Frame& frame, const Look& look) const {
  mesh_.use();
  for (const Thing& thing : things_) {
    const Mat4 camera_from_object = shot.view.camera_from_world * thing.world_from_object;
    mesh_.set("camera_from_object", camera_from_object);
    mesh_.set("clip_from_object", Mat4(shot.view.clip_from_camera * camera_from_object));
    mesh_.set("color", thing.color);
    thing.mesh->draw(gl_);
  }
  if (shot.ground) draw_ground(shot, frame, look);
}

void MeshPass::draw_ground(const Shot& shot, const Frame& frame, const Look& look) const {
  const Vec3 background(look.background[0], look.background[1], look.background[2]);
  ground_vertices_.bind();
  ground_positions_.upload(GL_ARRAY_BUFFER, ground_strip(shot, frame.domain));
  gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl_.EnableVertexAttribArray(0);
  ground_.use();
  ground_.set("clip_from_world", Mat4(shot.view.clip_from_camera * shot.view.camera_from_world));
  ground_.set("color", Vec3(background * (shot.flat ? 0.97 : 0.86)));
  ground_.set("normal", shot.flat ? Vec3(0, 0, 1) : shot.view.rotate(Vec3(0, 1, 0)));
  ground_.set("origin", frame.domain.min);
  ground_.set("cell", checker_cell(frame.domain.extent().maxCoeff()));
  ground_.set("kind", shot.flat ? kBackdropKind : kFloorKind);
  ground_.set("flat_scene", shot.flat ? 1 : 0);
  gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void MeshPass::draw_shadow(const Shot& shot) const {
  shadow_.use();
  for (const Thing& thing : things_) {
    shadow_.set("clip_from_object", Mat4(shot.shadow_clip_from_world * thing.world_from_object));
    thing.mesh->draw(gl_);
  }
}

}  // namespace lather::render
