#include "sim/scene/mesh_library.h"
#include "sim/scene/tables.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

namespace {

/// Reads the file and makes the solid of it.
void load(const Value& value, MeshShape& s, const Place& place) {
  try {
    MeshLibrary& meshes = place.meshes();
    const std::string& sha256 = meshes.file(s.file).sha256;
    if (!s.sha256.empty() && s.sha256 != sha256) {
      place.at("sha256").refuse(
          value.find("sha256"), sha256,
          s.file +
              " is not the file that the scene was written for: its bytes have changed. "
              "Bring the old one back, or take \"sha256\" out.");
      return;
    }
    s.sha256 = sha256;
    s.solid = meshes.solid(s.file, s.resolution);
  } catch (const MeshError& error) {
    place.at("file").refuse(value.find("file"), error.allowed, error.what());
  }
}

}  // namespace

Table<MeshShape> mesh_table() {
  using S = MeshShape;
  return {"mesh",
          "A closed surface of triangles that face outward, from an OBJ or PLY file, in metres; from the "
          "command line "
          "only.",
          {required<S>("file", &S::file, text(1, 1024),
                       "path of an .obj or .ply file, from the directory of the scene's file"),
           optional<S>("resolution", &S::resolution, integer(16, 256),
                       "cells of its signed distance along the longest side"),
           optional<S>("sha256", &S::sha256, text(64, 64),
                       "of the file's bytes; refused where they are others", "that of the file")},
          {},
          load};
}

}  // namespace lather::tables
