#pragma once

#include <map>
#include <memory>
#include <vector>

#include "render/gl_objects.h"
#include "render/shot.h"

namespace lather::render {

/// Obstacles, the skins of a look that draws them, and the floor or backdrop.
class MeshPass {
 public:
  explicit MeshPass(const Gl& gl);
  ~MeshPass();
  MeshPass(const MeshPass&) = delete;
  MeshPass& operator=(const MeshPass&) = delete;

  /// Uploads the meshes that are new since the last frame and forgets those that are gone.
  void upload(const Frame& frame, const Look& look);
  void draw(const Shot& shot, const Frame& frame, const Look& look) const;
  void draw_shadow(const Shot& shot) const;

 private:
  struct Uploaded;
  struct Thing {  ///< to draw
    const Uploaded* mesh;
    Mat4 world_from_object;
    Vec3 color;  ///< sRGB
  };
  void draw_ground(const Shot& shot, const Frame& frame, const Look& look) const;

  const Gl& gl_;
  Program mesh_, shadow_, ground_;
  VertexArray ground_vertices_;
  Buffer ground_positions_;
  std::vector<Thing> things_;  // of the frame that was uploaded
  std::map<std::shared_ptr<const TriangleMesh>, std::unique_ptr<Uploaded>> meshes_;
};

}  // namespace lather::render
