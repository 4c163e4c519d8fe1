#include "sim/mpm/resample/false_tears.h"

#include <algorithm>
#include <cmath>

#include "sim/mpm/resample/field_values.h"

namespace lather::mpm::resample {
namespace {

/// |dev C^p|_F of a point's values.
double plasticity_of(const double* point, const PointValues& list, const TearTest& test) {
  double state[7] = {point[list.at(Field::kVolumeChange)]};
  std::copy_n(point + list.at(Field::kElasticStrain), list.components(Field::kElasticStrain), state + 1);
  const double* g = point + list.at(Field::kDeformation);
  double deformation[9] = {};
  if (list.components(Field::kDeformation) == 9) {
    std::copy_n(g, 9, deformation);
  } else {  // xx xy yx yy zz
    deformation[0] = g[0], deformation[1] = g[1];
    deformation[3] = g[2], deformation[4] = g[3];
    deformation[8] = g[4];
  }
  return test.plasticity(state, deformation);
}

}  // namespace

template <class Real>
void mend_false_tears(const std::vector<NewPoint>& points, const PointBins& bins,
                      const std::vector<ParticleSet<Real>>& sets, const TearTest& test,
                      std::vector<double>& values) {
  const std::size_t stride = values_stride(sets);
  std::vector<double> donor(stride);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const NewPoint& point = points[i];
    const double threshold = test.tear_threshold[point.set];
    if (!std::isfinite(threshold)) continue;
    const PointValues list(sets[point.set].layout());
    double* own = values.data() + i * stride;
    if (plasticity_of(own, list, test) <= threshold) continue;
    const Gift* most = nullptr;
    bool among_weak = false;
    for (const Gift& gift : point.gifts) {
      list.read(sets[point.set], bins.point(gift.donor).slot, donor.data());
      among_weak = among_weak || plasticity_of(donor.data(), list, test) > threshold;
      if (most == nullptr || gift.share > most->share) most = &gift;
    }
    if (among_weak || most == nullptr) continue;
    list.read(sets[point.set], bins.point(most->donor).slot, donor.data());
    for (const Field f : {Field::kVolumeChange, Field::kElasticStrain, Field::kDeformation})
      std::copy_n(donor.data() + list.at(f), list.components(f), own + list.at(f));
  }
}

template void mend_false_tears(const std::vector<NewPoint>&, const PointBins&,
                               const std::vector<ParticleSet<float>>&, const TearTest&, std::vector<double>&);
template void mend_false_tears(const std::vector<NewPoint>&, const PointBins&,
                               const std::vector<ParticleSet<double>>&, const TearTest&,
                               std::vector<double>&);

}  // namespace lather::mpm::resample
