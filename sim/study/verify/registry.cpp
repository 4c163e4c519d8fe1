#include "sim/study/verify/blend_viscosity.h"
#include "sim/study/verify/couette.h"
#include "sim/study/verify/film.h"
#include "sim/study/verify/incline.h"
#include "sim/study/verify/law.h"
#include "sim/study/verify/mlsrk/cases.h"
#include "sim/study/verify/resting_block.h"
#include "sim/study/verify/slump.h"
#include "sim/study/verify/standing_wave.h"
#include "sim/study/verify/tearing.h"

namespace lather::study {

const std::vector<VerificationCase>& verification_cases() {
  static const std::vector<VerificationCase> cases = {
      {"law", "The law at single points is what its equations say", true, verify_law},
      {"tearing", "Single points tear and recover as their equations say", true, verify_tearing},
      {"couette", "Start-up of shear in the Maxwell limit follows its exact transient", true, verify_couette},
      {"standing-wave", "An elastic wave keeps its frequency and, with FLIP, its amplitude", true,
       verify_standing_wave},
      {"blend-viscosity", "The FLIP/PIC blend adds the viscosity that plans show, whatever the step", true,
       verify_blend_viscosity},
      {"film", "A Herschel-Bulkley film flows down a slope as it should, and stops below yield", true,
       verify_film},
      {"incline", "A block on an incline slides or sticks as Coulomb says", true, verify_incline},
      {"resting-block", "A block below yield does not creep in single precision", true, verify_resting_block},
      {"tearing-box", "A sheared box tears when it should, and recovers at the rate it should", true,
       verify_tearing_box},
      {"mlsrk-wave", "Particles: an elastic wave keeps its frequency and its amplitude", true,
       mlsrk::verify_wave},
      {"mlsrk-blend", "Particles: the velocity blend adds the viscosity that plans show, whatever the step",
       true, mlsrk::verify_blend},
      {"mlsrk-energy", "Particles: without the blend a closed body keeps its energy and its momentum", true,
       mlsrk::verify_energy},
      {"mlsrk-disk", "Particles: a free disk keeps its angular momentum and its energy", true,
       mlsrk::verify_disk},
      {"mlsrk-diffusion", "Particles: concentrations diffuse as fast as they should and keep their mass",
       true, mlsrk::verify_diffusion},
      {"film-fine", "The film's profile converges at finer spacings", false, verify_fine_film},
      {"slump", "A cylinder slumps to where its weight no longer makes it yield", false, verify_slump},
      {"spreading", "A cylinder of low yield stress spreads to the radius that its floor can hold", false,
       verify_spreading},
      {"mlsrk-cantilever", "Particles: a beam bends under its weight as it should", false,
       mlsrk::verify_cantilever},
      {"mlsrk-column", "Particles: a column of liquid bears its weight by pressure", false,
       mlsrk::verify_column},
      {"mlsrk-dam-break", "Particles: a column of water collapses as measured", false,
       mlsrk::verify_dam_break},
      {"mlsrk-sand-column", "Particles: a column of sand runs out as measured", false,
       mlsrk::verify_sand_column}};
  return cases;
}

}  // namespace lather::study
