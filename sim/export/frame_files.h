#pragma once

#include <string>
#include <vector>

#include "sim/frame.h"
#include "sim/scene/scene.h"

/// Frames as files of other programs: whole files as bytes, SI units, y up.
namespace lather {

/// Points: float x y z, vx vy vz, uint id, uchar material, then every scalar by its name as float. Binary
/// little endian. Comments hold the frame's index and time and the materials' names.
[[nodiscard]] std::string particles_ply(const Frame& frame);
/// The same as OpenVDB points, 32-bit: P, v, id, material and the scalars.
[[nodiscard]] std::string particles_vdb(const Frame& frame);

/// All skins in one file: an object a material (OBJ), a uchar "material" a face (binary PLY), or a level set
/// a material with voxels of half the points' distance (VDB).
[[nodiscard]] std::string skin_obj(const Frame& frame);
[[nodiscard]] std::string skin_ply(const Frame& frame);
[[nodiscard]] std::string skin_vdb(const Frame& frame);

/// One kind of file that a scene asks for.
struct FrameFileKind {
  std::string folder;  ///< "particles" or "skin"
  std::string ending;  ///< "ply", "obj" or "vdb"
  std::string (*bytes)(const Frame&);
};

/// All kinds of file that there are.
[[nodiscard]] const std::vector<FrameFileKind>& frame_file_kinds();
/// Those that `output` names.
[[nodiscard]] std::vector<FrameFileKind> planned_files(const Output& output);

}  // namespace lather
