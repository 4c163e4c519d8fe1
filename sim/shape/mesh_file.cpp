#include "sim/shape/mesh_file.h"

#include <algorithm>
#include <cctype>

namespace lather {
namespace {

std::string ending_of(const std::string& file) {
  const std::size_t dot = file.find_last_of('.');
  std::string ending = dot == std::string::npos ? "" : file.substr(dot);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace

MeshData read_mesh(std::string_view bytes, const std::string& file) {
  if (bytes.size() > kMaxMeshBytes)
    throw MeshError(file + " is too large: " + std::to_string(bytes.size()) +
                        " bytes. Reduce its triangles (\"decimate\"), or save it as binary PLY.",
                    "a file of at most " + std::to_string(kMaxMeshBytes) + " bytes");
  const std::string ending = ending_of(file);
  if (ending == ".obj") return read_obj(bytes, file);
  if (ending == ".ply") return read_ply_mesh(bytes, file);
  throw MeshError(file + " is neither an OBJ nor a PLY file by its name. Export the mesh as one of them.",
                  "a name that ends in .obj or .ply");
}

}  // namespace lather
