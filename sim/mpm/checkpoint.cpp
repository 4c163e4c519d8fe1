#include "sim/mpm/checkpoint.h"

#include <cstring>
#include <type_traits>

namespace lather::mpm {
namespace {

constexpr char kMagic[8] = {'l', 'a', 't', 'h', 'e', 'r', 'C', '3'};

[[noreturn]] void refuse(const std::string& why) {
  throw InputError({{"", "", "the bytes of a checkpoint of the same scene, kernel level and version", why}});
}

class Writer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put_text(const std::string& text) {
    put(text.size());
    bytes += text;
  }
  void put_numbers(const std::vector<double>& numbers) {
    put(numbers.size());
    for (const double x : numbers) put(x);
  }
  std::string bytes;
};

class Reader {
 public:
  explicit Reader(const std::string& bytes) : at(bytes.data()), end(bytes.data() + bytes.size()) {}
  template <class T>
  void get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (static_cast<std::size_t>(end - at) < sizeof value) refuse("The checkpoint ends too early.");
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
  }
  std::string get_text() {
    std::size_t n = 0;
    get(n);
    if (static_cast<std::size_t>(end - at) < n) refuse("The checkpoint ends too early.");
    at += n;
    return {at - n, n};
  }
  void get_numbers(std::vector<double>& numbers) {
    std::size_t n = 0;
    get(n);
    if (static_cast<std::size_t>(end - at) / sizeof(double) < n) refuse("The checkpoint ends too early.");
    numbers.resize(n);
    for (double& x : numbers) get(x);
  }
  const char* at;
  const char* end;
};

/// Calls visit(field) for every plain field of a frame's figures, in a fixed order.
template <class Measure, class Visit>
void for_figures(Measure& m, const Visit& visit) {
  visit(m.frame), visit(m.time), visit(m.step), visit(m.points), visit(m.fingerprint), visit(m.mass);
  visit(m.points_emitted), visit(m.points_left), visit(m.mass_emitted), visit(m.mass_left);
  for (auto* v : {&m.momentum, &m.angular_momentum, &m.center_of_mass, &m.lowest, &m.highest})
    for (int a = 0; a < 3; ++a) visit((*v)[a]);
  visit(m.kinetic_energy), visit(m.elastic_volume_energy), visit(m.elastic_shear_energy),
      visit(m.gravity_energy);
  visit(m.max_speed), visit(m.min_volume_ratio), visit(m.max_volume_ratio), visit(m.weak_fraction);
  visit(m.interior_nodes), visit(m.interior_voids), visit(m.points_inserted), visit(m.points_merged),
      visit(m.resampling_momentum), visit(m.points_removed), visit(m.mass_removed);
  visit(m.density_mean), visit(m.density_min), visit(m.density_max), visit(m.density_within_5_percent);
  visit(m.skin_volume);
  visit(m.pieces), visit(m.largest_piece_share), visit(m.second_piece_share);
}

template <class AnyReport, class Visit>
void for_totals(AnyReport& r, const Visit& visit) {
  visit(r.steps), visit(r.point_steps), visit(r.simulated_time), visit(r.wall_seconds),
      visit(r.render_seconds);
  visit(r.largest_cfl), visit(r.smallest_time_step), visit(r.largest_time_step);
  visit(r.solver.solves), visit(r.solver.iterations), visit(r.solver.most_iterations);
  visit(r.solver.unconverged), visit(r.solver.convex);
}

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
  Writer w;
  w.put(kMagic);
  w.put_text(key);
  w.put(frame);
  w.put(state.step), w.put(state.time), w.put(state.drift), w.put(state.max_speed), w.put(state.sorted);
  w.put(state.resampled);
  for (const double since : state.since_recovery) w.put(since);
  for_counts(state, [&](const auto& value) { w.put(value); });
  for_totals(report, [&](const auto& value) { w.put(value); });
  w.put(report.frames.size());
  for (const FrameMeasure& m : report.frames) for_figures(m, [&](const auto& value) { w.put(value); });
  for (const ProbeSeries& p : report.probes) w.put_numbers(p.times), w.put_numbers(p.values);
  for (const auto& set : state.sets) set.save(w.bytes);
  return std::move(w.bytes);
}

template <class Real>
void read_checkpoint(const std::string& bytes, const std::string& key, State<Real>& state, Report& report,
                     int& frame) {
  Reader r(bytes);
  char magic[sizeof kMagic];
  r.get(magic);
  if (std::memcmp(magic, kMagic, sizeof magic) != 0) refuse("These bytes are no checkpoint.");
  if (const std::string found = r.get_text(); found != key)
    refuse("The checkpoint was made for another scene, kernel level or version: " + found + ", not " + key +
           ".");
  r.get(frame);
  r.get(state.step), r.get(state.time), r.get(state.drift), r.get(state.max_speed), r.get(state.sorted);
  r.get(state.resampled);
  for (double& since : state.since_recovery) r.get(since);
  for_counts(state, [&](auto& value) { r.get(value); });
  for_totals(report, [&](auto& value) { r.get(value); });
  std::size_t frames = 0;
  r.get(frames);
  if (frames > bytes.size()) refuse("The checkpoint is damaged.");
  report.frames.assign(frames, {});
  for (FrameMeasure& m : report.frames) for_figures(m, [&](auto& value) { r.get(value); });
  for (ProbeSeries& p : report.probes) {
    r.get_numbers(p.times), r.get_numbers(p.values);
    if (p.values.size() != p.times.size() * p.columns.size()) refuse("The checkpoint is damaged.");
  }
  try {
    for (auto& set : state.sets) set.restore(r.at, r.end);
  } catch (const std::runtime_error& e) {
    refuse(e.what());
  }
  if (r.at != r.end) refuse("The checkpoint is longer than its state.");
}

template std::string write_checkpoint(const State<float>&, const Report&, int, const std::string&);
template std::string write_checkpoint(const State<double>&, const Report&, int, const std::string&);
template void read_checkpoint(const std::string&, const std::string&, State<float>&, Report&, int&);
template void read_checkpoint(const std::string&, const std::string&, State<double>&, Report&, int&);

}  // namespace lather::mpm
