#pragma once

#include <vector>

#include "sim/particles/particle_set.h"

namespace lather::mpm::resample {

/// The values of a point that are averaged, not shared out, as one list of doubles: every field of real
/// numbers in its set's layout but the share.
class PointValues {
 public:
  explicit PointValues(const TileLayout& layout);

  [[nodiscard]] std::size_t count() const { return rows_.size(); }

  template <class Real>
  void read(const ParticleSet<Real>& set, const PointSlot& slot, double* to) const {
    for (const Row& row : rows_)
      *to++ = static_cast<double>(set.template values<Real>(slot.tile, row.field, row.component)[slot.lane]);
  }
  template <class Real>
  void write(ParticleSet<Real>& set, const PointSlot& slot, const double* from) const {
    for (const Row& row : rows_)
      set.template values<Real>(slot.tile, row.field, row.component)[slot.lane] = static_cast<Real>(*from++);
  }

  /// Index of a field's first component in the list; the field must be there.
  [[nodiscard]] std::size_t at(Field field) const;
  [[nodiscard]] bool has(Field field) const;
  [[nodiscard]] std::size_t components(Field field) const;

  /// Makes a mean of states a state again: det be = 1, by be <- det(be)^(-1/3) be, and det F = J, by
  /// F <- (J / det F)^(1/3) F. [Foam section 6.1]
  void renormalize(double* values) const;

 private:
  void renormalize_strain(double* values) const;
  void renormalize_deformation(double* values) const;

  struct Row {
    Field field;
    int component;
  };
  std::vector<Row> rows_;
};

}  // namespace lather::mpm::resample
