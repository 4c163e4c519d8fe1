#include <cstdio>
#include <nlohmann/json.hpp>

#include "sim/report/report.h"

namespace lather {
namespace {

using Json = nlohmann::ordered_json;

std::string hex(std::uint64_t bits) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(bits));
  return text;
}

Json vector(const Vec3& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

Json frame(const FrameMeasure& m) {
  Json json = {{"frame", m.frame},
               {"time", m.time},
               {"step", m.step},
               {"points", m.points},
               {"points_emitted", m.points_emitted},
               {"points_left", m.points_left},
               {"fingerprint", hex(m.fingerprint)},
               {"mass", m.mass},
               {"mass_emitted", m.mass_emitted},
               {"mass_left", m.mass_left},
               {"momentum", vector(m.momentum)},
               {"angular_momentum", vector(m.angular_momentum)},
               {"center_of_mass", vector(m.center_of_mass)},
               {"lowest", vector(m.lowest)},
               {"highest", vector(m.highest)},
               {"energy",
                {{"kinetic", m.kinetic_energy},
                 {"elastic_volume", m.elastic_volume_energy},
                 {"elastic_shear", m.elastic_shear_energy},
                 {"gravity", m.gravity_energy}}},
               {"max_speed", m.max_speed},
               {"volume_ratio", {{"min", m.min_volume_ratio}, {"max", m.max_volume_ratio}}},
               {"weak_fraction", m.weak_fraction},
               {"interior_voids", m.interior_voids < 0 ? Json(nullptr) : Json(m.interior_voids)},
               {"resampling",
                {{"points_inserted", m.points_inserted},
                 {"points_merged", m.points_merged},
                 {"momentum_change", m.resampling_momentum}}},
               {"subgrid_removal", {{"points_removed", m.points_removed}, {"mass_removed", m.mass_removed}}},
               {"density",
                {{"interior_nodes", m.interior_nodes},
                 {"mean", m.density_mean},
                 {"min", m.density_min},
                 {"max", m.density_max},
                 {"within_5_percent", m.density_within_5_percent}}},
               {"pieces",
                {{"count", m.pieces},
                 {"largest_share", m.largest_piece_share},
                 {"second_share", m.second_piece_share}}}};
  if (m.skin_volume) json["skin_volume"] = *m.skin_volume;
  if (m.phases)
    json["phases"] = {{"component_mass", m.phases->component_mass},
                      {"concentration", {{"min", m.phases->least}, {"max", m.phases->largest}}},
                      {"rest_volume", m.phases->rest_volume}};
  if (m.lumped)
    json["lumped"] = {{"mass", m.lumped->mass},
                      {"momentum", m.lumped->momentum},
                      {"kinetic_energy", m.lumped->kinetic_energy}};
  return json;
}

Json solver(const SolverTotals& s) {
  if (s.solves == 0) return nullptr;
  return {{"solves", s.solves},
          {"iterations", s.iterations},
          {"mean_iterations", static_cast<double>(s.iterations) / static_cast<double>(s.solves)},
          {"most_iterations", s.most_iterations},
          {"unconverged", s.unconverged},
          {"convex", s.convex}};
}

Json probe(const ProbeSeries& p) {
  Json columns = Json::array({{{"quantity", "time"}, {"unit", "s"}}});
  for (const ProbeSeries::Column& c : p.columns)
    columns.push_back({{"quantity", c.quantity}, {"unit", c.unit}});
  Json samples = Json::array();
  for (std::size_t i = 0; i < p.times.size(); ++i) {
    Json row = Json::array({p.times[i]});
    for (std::size_t c = 0; c < p.columns.size(); ++c) row.push_back(p.values[i * p.columns.size() + c]);
    samples.push_back(std::move(row));
  }
  return {{"name", p.name}, {"type", p.type}, {"columns", columns}, {"samples", samples}};
}

}  // namespace

std::string to_json(const Report& r) {
  Json stages = Json::array();
  for (const StageTime& s : r.stages) stages.push_back({{"name", s.name}, {"seconds", s.seconds}});
  Json emitters = Json::array();
  for (const EmitterReport& e : r.emitters)
    emitters.push_back({{"name", e.name},
                        {"releases", e.releases},
                        {"points", e.points},
                        {"delayed", e.delayed},
                        {"waited", e.waited},
                        {"waiting", e.waiting}});
  Json probes = Json::array();
  for (const ProbeSeries& p : r.probes) probes.push_back(probe(p));
  Json frames = Json::array();
  for (const FrameMeasure& m : r.frames) frames.push_back(frame(m));
  Json json = {{"lather_report", 1},
               {"state", r.state},
               {"error", r.error.empty() ? Json(nullptr) : Json(r.error)},
               {"scene", r.scene_name},
               {"scene_hash", r.scene_hash},
               {"version", r.version},
               {"kernel_level", r.kernel_level},
               {"render_backend", r.render_backend},
               {"threads", r.threads},
               {"steps", r.steps},
               {"point_steps", r.point_steps},
               {"simulated_time", r.simulated_time},
               {"wall_seconds", r.wall_seconds},
               {"render_seconds", r.render_seconds},
               {"point_steps_per_second", r.point_steps_per_second},
               {"largest_cfl", r.largest_cfl},
               {"time_step", {{"smallest", r.smallest_time_step}, {"largest", r.largest_time_step}}},
               {"solver", solver(r.solver)},
               {"regularized_moments", r.regularized_moments},
               {"light_masses", r.light_masses},
               {"emitters", emitters},
               {"probes", probes},
               {"stages", stages},
               {"frames", frames},
               {"warnings", r.warnings}};
  if (r.budget)
    json["budget"] = {{"seconds", r.budget->seconds > 0 ? Json(r.budget->seconds) : Json(nullptr)},
                      {"error", r.budget->error > 0 ? Json(r.budget->error) : Json(nullptr)},
                      {"quality", r.budget->quality},
                      {"predicted_seconds", r.budget->predicted_seconds},
                      {"predicted_error", r.budget->predicted_error},
                      {"actual_seconds", r.budget->actual_seconds}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lather
