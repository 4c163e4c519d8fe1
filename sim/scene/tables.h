#pragma once

#include "sim/scene/models.h"
#include "sim/scene/scene.h"
#include "sim/scene/tagged.h"

/// The descriptor tables of everything a scene holds. Ranges are wide: they catch slips of unit and sign, not
/// bold ideas.
namespace lather::tables {

/// Coordinates and sizes, m.
inline constexpr double kMaxLength = 1e6;
/// Velocities, m/s.
inline constexpr double kMaxSpeed = 1e6;
/// "never" as a time, s.
inline constexpr double kForever = 1e30;
/// R of the MLSRK solver over the spacing.
inline constexpr double kMaxSupportRadius = 4;

[[nodiscard]] const descriptor::Table<Scene>& scene();
[[nodiscard]] const descriptor::Table<Domain>& domain();
[[nodiscard]] const descriptor::Table<Material>& material();
[[nodiscard]] const descriptor::Table<TearingParameters>& tearing();
[[nodiscard]] const descriptor::Table<Phase>& phase();
[[nodiscard]] const descriptor::Table<MixturePart>& mixture_part();
[[nodiscard]] const descriptor::Table<Body>& body();
[[nodiscard]] const descriptor::Table<Grip>& grip();
[[nodiscard]] const descriptor::Table<Emitter>& emitter();
[[nodiscard]] const descriptor::Table<Obstacle>& obstacle();
[[nodiscard]] const descriptor::Table<Numerics>& numerics();
[[nodiscard]] const descriptor::Table<Mlsrk>& mlsrk();
[[nodiscard]] const descriptor::Table<PhaseNumerics>& phase_numerics();
[[nodiscard]] const descriptor::Table<Budget>& budget();
[[nodiscard]] const descriptor::Codec<Quality>& quality_codec();
[[nodiscard]] const descriptor::Table<Resampling>& resampling();
[[nodiscard]] const descriptor::Table<SubgridRemoval>& subgrid_removal();
[[nodiscard]] const descriptor::Table<Look>& look();
[[nodiscard]] const descriptor::Table<Look::Camera>& camera();
[[nodiscard]] const descriptor::Table<Output>& output();
[[nodiscard]] descriptor::Table<MeshShape> mesh_table();
[[nodiscard]] const descriptor::Tagged<decltype(Shape::kind)>& shapes();
[[nodiscard]] const descriptor::Tagged<Motion>& motions();
[[nodiscard]] const descriptor::Tagged<Curve>& curves();
[[nodiscard]] const descriptor::Tagged<decltype(Probe::kind)>& probes();

[[nodiscard]] descriptor::Codec<Material> material_codec();
[[nodiscard]] descriptor::Codec<ShapePtr> shape_codec();
[[nodiscard]] descriptor::Codec<Motion> motion_codec();
[[nodiscard]] descriptor::Codec<Curve> curve_codec();
[[nodiscard]] descriptor::Codec<Probe> probe_codec();

/// Schemas that others refer to as "#/$defs/…".
[[nodiscard]] Object material_schema();

/// Keys of a scene document that are not kept in Scene: the format's version and the sizes.
[[nodiscard]] std::vector<descriptor::FieldInfo> document_fields();

}  // namespace lather::tables
