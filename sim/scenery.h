#pragma once

#include <memory>
#include <vector>

#include "sim/frame.h"
#include "sim/scene/scene.h"

namespace lather {

/// What of a frame follows from the scene and the time alone: all but points and skins.
class Scenery {
 public:
  explicit Scenery(const Scene& scene);

  [[nodiscard]] Frame frame(int index, double time) const;

 private:
  struct Prop {
    std::string name;
    std::shared_ptr<const TriangleMesh> mesh;  ///< shared by all frames
    Motion motion;
  };
  Frame still_;              ///< without points, obstacles and time
  std::vector<Prop> props_;  ///< the obstacles to draw as meshes
};

}  // namespace lather
