#include "sim/checkpoint_bytes.h"

#include "sim/error.h"

namespace lather::checkpoint {
namespace {

constexpr char kMagic[8] = {'l', 'a', 't', 'h', 'e', 'r', 'C', '5'};

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
  visit(m.skin_volume), visit(m.phases), visit(m.lumped);
  visit(m.pieces), visit(m.largest_piece_share), visit(m.second_piece_share);
}

template <class AnyReport, class Visit>
void for_totals(AnyReport& r, const Visit& visit) {
  visit(r.steps), visit(r.point_steps), visit(r.simulated_time), visit(r.wall_seconds),
      visit(r.render_seconds);
  visit(r.largest_cfl), visit(r.smallest_time_step), visit(r.largest_time_step);
  visit(r.solver.solves), visit(r.solver.iterations), visit(r.solver.most_iterations);
  visit(r.solver.unconverged), visit(r.solver.convex);
  visit(r.regularized_moments), visit(r.light_masses);
}

}  // namespace

void refuse(const std::string& why) {
  throw InputError({{"", "", "the bytes of a checkpoint of the same scene, kernel level and version", why}});
}

Writer::Writer(const std::string& key) {
  put(kMagic);
  put_text(key);
}

void Writer::put_text(const std::string& text) {
  put(text.size());
  bytes += text;
}

void Writer::put_numbers(const std::vector<double>& numbers) {
  put(numbers.size());
  for (const double x : numbers) put(x);
}

void Writer::put_report(const Report& report) {
  for_totals(report, [&](const auto& value) { put(value); });
  put(report.frames.size());
  for (const FrameMeasure& m : report.frames) for_figures(m, [&](const auto& value) { put(value); });
  for (const ProbeSeries& p : report.probes) put_numbers(p.times), put_numbers(p.values);
}

Reader::Reader(const std::string& bytes, const std::string& key)
    : at_(bytes.data()), end_(bytes.data() + bytes.size()) {
  char magic[sizeof kMagic];
  get(magic);
  if (std::memcmp(magic, kMagic, sizeof magic) != 0) refuse("These bytes are no checkpoint.");
  if (const std::string found = get_text(); found != key)
    refuse("The checkpoint was made for another scene, kernel level or version: " + found + ", not " + key +
           ".");
}

std::string Reader::get_text() {
  std::size_t n = 0;
  get(n);
  if (static_cast<std::size_t>(end_ - at_) < n) refuse("The checkpoint ends too early.");
  at_ += n;
  return {at_ - n, n};
}

void Reader::get_numbers(std::vector<double>& numbers) {
  std::size_t n = 0;
  get(n);
  if (static_cast<std::size_t>(end_ - at_) / sizeof(double) < n) refuse("The checkpoint ends too early.");
  numbers.resize(n);
  for (double& x : numbers) get(x);
}

void Reader::get_report(Report& report) {
  for_totals(report, [&](auto& value) { get(value); });
  std::size_t frames = 0;
  get(frames);
  if (frames > static_cast<std::size_t>(end_ - at_)) refuse("The checkpoint is damaged.");
  report.frames.assign(frames, {});
  for (FrameMeasure& m : report.frames) for_figures(m, [&](auto& value) { get(value); });
  for (ProbeSeries& p : report.probes) {
    get_numbers(p.times), get_numbers(p.values);
    if (p.values.size() != p.times.size() * p.columns.size()) refuse("The checkpoint is damaged.");
  }
}

}  // namespace lather::checkpoint
