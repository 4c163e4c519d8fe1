#pragma once

#include <map>
#include <memory>

#include "render/gl_objects.h"
#include "render/shot.h"

namespace lather::render {

/// Obstacles, and the floor or backdrop.
class MeshPass {
 public:
  explicit MeshPass(const Gl& gl);
  ~MeshPass();
  MeshPass(const MeshPass&) = delete;
  MeshPass& operator=(const MeshPass&) = delete;

  /// Uploads the meshes that are new since the last frame and forgets those that are gone.
  void upload(const Frame& frame);
  void draw(const Shot& shot, const Frame& frame, const Look& look) const;
  void draw_shadow(const Shot& shot, const Frame& frame) const;

 private:
  struct Uploaded;
  void draw_ground(const Shot& shot, const Frame& frame, const Look& look) const;

  const Gl& gl_;
  Program mesh_, shadow_, ground_;
  VertexArray ground_vertices_;
  Buffer ground_positions_;
  std::map<std::shared_ptr<const TriangleMesh>, std::unique_ptr<Uploaded>> meshes_;
};

}  // namespace lather::render
