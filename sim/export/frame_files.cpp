#include "sim/export/frame_files.h"

#include <algorithm>

namespace lather {

const std::vector<FrameFileKind>& frame_file_kinds() {
  static const std::vector<FrameFileKind> kinds = {{"particles", "ply", particles_ply},
                                                   {"particles", "vdb", particles_vdb},
                                                   {"skin", "obj", skin_obj},
                                                   {"skin", "ply", skin_ply},
                                                   {"skin", "vdb", skin_vdb}};
  return kinds;
}

std::vector<FrameFileKind> planned_files(const Output& output) {
  std::vector<FrameFileKind> planned;
  for (const FrameFileKind& kind : frame_file_kinds()) {
    const std::vector<std::string>& wanted = kind.folder == "skin" ? output.skin : output.particles;
    if (std::find(wanted.begin(), wanted.end(), kind.ending) != wanted.end()) planned.push_back(kind);
  }
  return planned;
}

}  // namespace lather
