#include <string>

#include "render/render.h"
#include "sim/error.h"

namespace lather::render {

Backend backend_from_string(std::string_view name) {
  if (name == "auto") return Backend::kAuto;
  if (name == "osmesa") return Backend::kOsmesa;
  if (name == "egl") return Backend::kEgl;
  Problem problem;
  problem.value = '"' + std::string(name) + '"';
  problem.allowed = "auto, osmesa, egl";
  problem.message = "No such render backend; choose auto to take the first that works.";
  throw InputError({problem});
}

}  // namespace lather::render
