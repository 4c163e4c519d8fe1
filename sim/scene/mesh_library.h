#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/shape/mesh_solid.h"

namespace lather {

/// The meshes of one reading of a scene: each file is read once, and made a solid once for each resolution.
class MeshLibrary {
 public:
  explicit MeshLibrary(MeshSource source) : source_(std::move(source)) {}

  /// All throw MeshError.
  [[nodiscard]] const MeshFile& file(const std::string& name);
  [[nodiscard]] std::shared_ptr<const MeshSolid> solid(const std::string& name, int resolution);

  /// In the order in which they were first asked for.
  [[nodiscard]] const std::vector<std::shared_ptr<const MeshFile>>& files() const { return files_; }

 private:
  MeshSource source_;
  std::vector<std::shared_ptr<const MeshFile>> files_;
  std::map<std::pair<std::string, int>, std::shared_ptr<const MeshSolid>> solids_;
};

}  // namespace lather
