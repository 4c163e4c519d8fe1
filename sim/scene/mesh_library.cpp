#include "sim/scene/mesh_library.h"

#include "sim/scene/sha256.h"

namespace lather {
namespace {

/// A plan carries its meshes to the machine that runs it.
constexpr std::size_t kMaxBytesOfAll = kMaxMeshBytes;

}  // namespace

const MeshFile& MeshLibrary::file(const std::string& name) {
  std::size_t bytes_of_all = 0;
  for (const auto& known : files_) {
    if (known->file == name) return *known;
    bytes_of_all += known->bytes.size();
  }
  if (!source_)
    throw MeshError(
        "Meshes come to a server by upload, not by a path, and this server takes no uploads: run the "
        "scene with 'lather run', or build the shape of others.",
        "a shape of another type");
  MeshFile read{name, "", source_(name)};
  if (bytes_of_all + read.bytes.size() > kMaxBytesOfAll)
    throw MeshError("With " + name + " the scene's meshes have " +
                        std::to_string(bytes_of_all + read.bytes.size()) +
                        " bytes. Reduce their triangles (\"decimate\"), or save them as binary PLY.",
                    "at most " + std::to_string(kMaxBytesOfAll) + " bytes of all meshes together");
  read.sha256 = sha256_hex(read.bytes);
  files_.push_back(std::make_shared<const MeshFile>(std::move(read)));
  return *files_.back();
}

std::shared_ptr<const MeshSolid> MeshLibrary::solid(const std::string& name, int resolution) {
  const MeshFile& known = file(name);
  auto& solid = solids_[{name, resolution}];
  if (!solid) solid = std::make_shared<const MeshSolid>(known.bytes, name, resolution);
  return solid;
}

}  // namespace lather
