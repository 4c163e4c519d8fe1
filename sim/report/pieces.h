#pragma once

#include <optional>
#include <vector>

#include "sim/particles/particle_set.h"
#include "sim/report/report.h"

/// Connected pieces of the material. A cell is occupied when it holds a point, of any material; occupied
/// cells that share a face, an edge or a corner are connected (across periodic faces, too). So two pieces are
/// more than a cell apart along some axis.
namespace lather {

/// Pieces with fewer points, as a share of all, are crumbs and are not counted.
inline constexpr double kLeastPiece = 0.01;

/// How the material falls apart.
struct Pieces {
  std::uint64_t count = 0;   ///< pieces with at least kLeastPiece of the points
  double largest_share = 0;  ///< of all points, in the largest piece
  double second_share = 0;   ///< … in the second largest, 0 where there is none

  void put(FrameMeasure& m) const {
    m.pieces = count;
    m.largest_piece_share = largest_share;
    m.second_piece_share = second_share;
  }
};

/// In cells of `width` spacings; a power of two, so that it divides the periods.
template <class Real>
[[nodiscard]] Pieces find_pieces(const std::vector<ParticleSet<Real>>& sets, const CellBounds& bounds,
                                 int width = 1);

/// When the material tore: the time (s) of the first frame in which it lies in two pieces, the second holding
/// at least `share` of the points, and does so in every frame of the `lasting` seconds after it. None where
/// it never did, or where the frames end before `lasting` is over.
[[nodiscard]] std::optional<double> tear_time(const std::vector<FrameMeasure>& frames, double share,
                                              double lasting);

}  // namespace lather
