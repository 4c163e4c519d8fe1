#include "sim/mpm/checkpoint.h"

#include "sim/checkpoint_bytes.h"

namespace lather::mpm {
namespace {

/// What has come in, gone out and been probed; the plan says how many emitters, materials and probes there
/// are.
template <class AnyState, class Visit>
void for_counts(AnyState& state, const Visit& visit) {
  visit(state.next_id);
  for (auto& e : state.emitters)
    visit(e.releases), visit(e.points), visit(e.delayed), visit(e.waited), visit(e.last), visit(e.travelled),
        visit(e.waiting);
  for (auto& count : state.points_emitted) visit(count);
  for (auto& left : state.left) visit(left.points), visit(left.shares);
  visit(state.removed.points), visit(state.removed.mass);
  for (auto& p : state.probes) {
    visit(p.sample), visit(p.since), visit(p.passed), visit(p.passed_before);
    for (int a = 0; a < 3; ++a) visit(p.load.impulse[a]), visit(p.load.moment[a]);
  }
}

}  // namespace

template <class Real>
std::string write_checkpoint(const State<Real>& state, const Report& report, int frame,
                             const std::string& key) {
  checkpoint::Writer w(key);
  w.put(frame);
  w.put(state.step), w.put(state.time), w.put(state.drift), w.put(state.sorted);
  w.put(state.max_speed), w.put(state.stiffest);
  w.put(state.resampled);
  for (const double since : state.since_recovery) w.put(since);
  for_counts(state, [&](const auto& value) { w.put(value); });
  w.put_report(report);
  for (const auto& set : state.sets) set.save(w.bytes);
  return std::move(w.bytes);
}

template <class Real>
void read_checkpoint(const std::string& bytes, const std::string& key, State<Real>& state, Report& report,
                     int& frame) {
  checkpoint::Reader r(bytes, key);
  r.get(frame);
  r.get(state.step), r.get(state.time), r.get(state.drift), r.get(state.sorted);
  r.get(state.max_speed), r.get(state.stiffest);
  r.get(state.resampled);
  for (double& since : state.since_recovery) r.get(since);
  for_counts(state, [&](auto& value) { r.get(value); });
  r.get_report(report);
  r.get_sets(state.sets);
}

template std::string write_checkpoint(const State<float>&, const Report&, int, const std::string&);
template std::string write_checkpoint(const State<double>&, const Report&, int, const std::string&);
template void read_checkpoint(const std::string&, const std::string&, State<float>&, Report&, int&);
template void read_checkpoint(const std::string&, const std::string&, State<double>&, Report&, int&);

}  // namespace lather::mpm
