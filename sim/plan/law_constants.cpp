#include "sim/plan/law_constants.h"

#include "sim/material/drucker_prager_make.h"
#include "sim/material/equation_of_state_make.h"
#include "sim/material/herschel_bulkley_make.h"
#include "sim/material/neo_hookean_make.h"
#include "sim/material/newtonian_make.h"
#include "sim/material/snow_make.h"

namespace lather {
namespace {

template <class Real>
struct MakeConstants {
  int dimension;
  LawConstants<Real>& to;

  void operator()(const HerschelBulkleyParameters& p) const {
    to.herschel_bulkley = herschel_bulkley_constants<Real>(p);
  }
  void operator()(const NeoHookeanParameters& p) const {
    to.elastic = neo_hookean_constants<Real>(p.elastic);
    to.viscous = newtonian_constants<Real>(p.viscous);
  }
  void operator()(const DruckerPragerParameters& p) const {
    to.elastic = neo_hookean_constants<Real>(p.elastic);
    to.viscous = newtonian_constants<Real>(p.viscous);
    to.drucker_prager = drucker_prager_constants<Real>(p, dimension);
  }
  void operator()(const SnowParameters& p) const {
    to.elastic = neo_hookean_constants<Real>(p.elastic);
    to.snow = snow_constants<Real>(p);
  }
  void operator()(const LiquidParameters& p) const {
    to.liquid = equation_of_state_constants<Real>(p);
    to.viscous = newtonian_constants<Real>(p.viscous);
  }
};

}  // namespace

template <class Real>
LawConstants<Real> law_constants(const Law& law, int dimension) {
  static_assert(std::variant_size_v<Law> == kLaws);
  LawConstants<Real> c{};
  std::visit(MakeConstants<Real>{dimension, c}, law);
  c.swelling = 1;
  return c;
}

template LawConstants<float> law_constants(const Law&, int);
template LawConstants<double> law_constants(const Law&, int);

}  // namespace lather
