#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/error.h"
#include "sim/material/drucker_prager_parameters.h"
#include "sim/material/herschel_bulkley_parameters.h"
#include "sim/material/liquid_parameters.h"
#include "sim/material/neo_hookean_parameters.h"
#include "sim/material/snow_parameters.h"
#include "sim/material/tearing_parameters.h"
#include "sim/math/vec.h"
#include "sim/scene/look.h"
#include "sim/scene/phase.h"
#include "sim/scene/probe.h"
#include "sim/shape/motion.h"
#include "sim/shape/shape.h"

/// A scene: what the user asked for, as plain validated structs. SI units, y up, angles in degrees.
namespace lather {

inline constexpr int kSceneFormat = 1;  ///< the value of the key "lather"

enum class Boundary { kSlip, kStick, kOpen };  ///< kOpen: points that leave are removed and counted
enum class Solver { kMpm, kMlsrk };
enum class Kernel { kQuadratic, kCubic };
enum class Transfer { kFlip, kApic };
enum class Precision { kFloat, kDouble };
enum class Integration { kExplicit, kSemiImplicit };

struct Domain {
  Box3 box;
  std::array<bool, 3> periodic = {false, false, false};  ///< extent there: a multiple of four spacings
  Boundary boundary = Boundary::kSlip;                   ///< of all faces that are not periodic
};

/// The constitutive law of a material, by its parameters.
using Law = std::variant<HerschelBulkleyParameters, NeoHookeanParameters, DruckerPragerParameters,
                         SnowParameters, LiquidParameters>;

/// At rest, kg/m^3.
[[nodiscard]] double density(const Law& law);

struct Material {
  std::string name;
  std::string preset;  ///< the card it was made from, "" if none
  Law law;
  TearingParameters tearing;   ///< of Herschel-Bulkley materials
  std::optional<Phase> phase;  ///< none: takes no part in diffusion; else `law` is that of its concentration

  [[nodiscard]] double density() const { return lather::density(law); }  ///< at rest, at t = 0, kg/m^3
  /// The law at kConcentrationNodes + 1 concentrations, evenly from 0 to 1; where nothing changes with the
  /// concentration, the law alone.
  [[nodiscard]] std::vector<Law> laws() const;
  /// Whether its volume may follow from its neighbours [MLSRK eq. 19]: a liquid, or grains without cohesion
  /// at any concentration. What coheres keeps the volume of its own deformation: one from its neighbours is
  /// at most that at rest beside empty space, which would bear no tension there.
  [[nodiscard]] bool takes_volume_correction() const;
  /// The law of a material that is known to be a Herschel-Bulkley one.
  [[nodiscard]] const HerschelBulkleyParameters& herschel_bulkley() const {
    return std::get<HerschelBulkleyParameters>(law);
  }
};

/// One of the materials of a body that is a mixture.
struct MixturePart {
  std::string material;
  double share = 1;  ///< of the body's points, over the sum of all shares
};

struct Body {
  std::string name;
  std::string material;              ///< "" for a mixture
  std::vector<MixturePart> mixture;  ///< every point is of one of these, at random; empty: one material
  ShapePtr shape;
  Vec3 velocity = Vec3::Zero();  ///< m/s
  Vec3 spin_deg = Vec3::Zero();  ///< angular velocity about the body's centre of mass, degrees/s
  Mat3 velocity_gradient =
      Mat3::Zero();  ///< added as grad * x (x from the world origin), 1/s: simple shear and the like

  /// The name of its material, or those of its mixture.
  [[nodiscard]] std::vector<std::string> material_names() const;
};

/// Points that are held or driven: those that at t = 0 belong to `body` and lie inside `shape`.
struct Grip {
  std::string name;
  std::string body;  ///< "": every body
  ShapePtr shape;    ///< null: the whole body
  Motion motion =
      AtRest{};       ///< what the points do between start and end, relative to where they are at start
  double start = 0;   ///< s
  double end = 1e30;  ///< s
};

/// A source of material: it releases copies of its shape, or lets material stream through it.
struct Emitter {
  std::string name;
  std::string material;
  ShapePtr shape;
  Vec3 velocity = Vec3::Zero();  ///< m/s, of what is released
  Vec3 spin_deg = Vec3::Zero();  ///< angular velocity about each copy's centre of mass, degrees/s
  double start = 0;              ///< s, of the first release
  double interval = 0;           ///< s, between releases; 0 with a single one
  int count = 1;                 ///< releases
  bool stream = false;           ///< material comes in through the shape at `velocity`, from start to end
  double end = 1e30;             ///< s, of a stream
};

struct Obstacle {
  std::string name;
  ShapePtr shape;
  bool adhesive = false;
  double friction = 0;  ///< Coulomb coefficient, dimensionless; not used when adhesive
  Motion motion = AtRest{};
  bool visible = true;
};

/// How a new point gets its velocity: from the points that give it mass, which conserves momentum, or
/// interpolated on the grid, which does not.
enum class NewVelocity { kConserving, kInterpolated };

/// "Avoid a void": points inserted where deformation thins them out, and merged where it crowds them.
struct Resampling {
  double interval = 5e-4;  ///< s, simulated, between two resamplings: 50 of the paper's steps
  NewVelocity velocity = NewVelocity::kConserving;
};

/// Removal of weak points whose surroundings the grid cannot resolve ("Continuum Foam", section 7.4).
struct SubgridRemoval {
  double interval = 5e-4;    ///< s, simulated, between two searches
  double anisotropy = 1e-5;  ///< least eigenvalue of the surroundings' covariance over the largest one
  double extent = 1e-5;      ///< largest eigenvalue over the squared cell width
};

struct MeshFile;

enum class Basis { kConstant, kLinear, kQuadratic };
enum class KernelShape { kTensor, kRadial };
/// What a force is divided by: the lumped mass of the shape functions [MLSRK eq. 11], or the point's own
/// mass.
enum class InertialMass { kLumped, kOwn };

/// How the MLSRK solver computes.
struct Mlsrk {
  Basis basis = Basis::kLinear;
  KernelShape kernel_shape = KernelShape::kTensor;
  double support_radius = 3;                    ///< R = 2 a, over the spacing
  double regularization = 1e-3;                 ///< r, dimensionless; 0: fully consistent shape functions
  bool regularize_constant = false;             ///< r on the constant too: forces then do not balance
  double velocity_blend = 0.95;                 ///< alpha_b at the reference step, dimensionless; 1: none
  double velocity_blend_reference_step = 1e-4;  ///< s: alpha_b of a step is velocity_blend^(dt / this)
  InertialMass inertial_mass = InertialMass::kLumped;
  bool volume_correction = true;  ///< of liquids and of grains without cohesion [MLSRK eq. 19]
  PhaseNumerics phases;
};

struct Numerics {
  Kernel kernel = Kernel::kCubic;
  Transfer transfer = Transfer::kFlip;
  Precision precision = Precision::kFloat;
  double flip_blend = 0.95;                 ///< alpha at the reference step, dimensionless
  double flip_blend_reference_step = 1e-5;  ///< s: alpha of a step is flip_blend^(dt / this)
  double time_step = 0;                     ///< s; 0: from the step bound
  double safety_factor = 0.4;               ///< of the step bound, dimensionless
  double max_time_step = 1e30;              ///< s, of the automatic step
  double allowed_energy_gain = 0.1;         ///< of a scene that nothing drives, over its energy at t = 0
  Integration integration = Integration::kExplicit;
  // Of the semi-implicit step only:
  double implicit_step_factor = 10;      ///< automatic step over the explicit one's, dimensionless
  double implicit_share = 1;             ///< beta: weight of the change of force over the step, dimensionless
  double solver_tolerance = 1e-2;        ///< residual over the first one, in the norm of the kinetic energy
  int solver_iterations = 200;           ///< most of one step
  std::optional<Resampling> resampling;  ///< none: off
  std::optional<SubgridRemoval> subgrid_removal;  ///< none: off
  Mlsrk mlsrk;                                    ///< of the MLSRK solver only
};

/// Named choices of the numerics, picked from what was measured; see sim/scene/quality.h. kOwn: none of them,
/// but what the scene says, and the defaults.
enum class Quality { kOwn, kDraft, kStandard, kFine, kReference };

/// What a run may take, or by how much it may err; one of the two, the other is 0. The quality is chosen for
/// it once, before the run.
struct Budget {
  double seconds = 0;  ///< of the run, wall clock, s
  double error = 0;    ///< the largest of what the solver's exact cases were off by, dimensionless
};

struct Scene {
  std::string name;
  Solver solver = Solver::kMpm;
  int dimension = 3;
  Domain domain;
  Vec3 gravity = {0, -9.81, 0};  ///< m/s^2
  double duration = 0;           ///< s
  double frame_rate = 30;        ///< 1/s
  double spacing = 0;            ///< MPM: cell width of the grid; MLSRK: distance of the points, m
  int points_per_cell = 0;       ///< n^dimension; default 8 in 3D, 4 in 2D; MLSRK: 1
  std::vector<Material> materials;
  std::vector<Body> bodies;
  std::vector<Emitter> emitters;
  std::vector<Obstacle> obstacles;
  std::vector<Grip> grips;  ///< of the MLSRK solver
  std::vector<Probe> probes;
  std::uint64_t seed = 0;
  double jitter = 0;  ///< of the initial points, fraction of their distance, 0 … 1
  Quality quality = Quality::kOwn;
  std::optional<Budget> budget;
  Numerics numerics;
  std::string given_numerics;  ///< "numerics" as it was read, JSON; "": none. Its keys win over a quality's
  Look look;
  Output output;
  std::vector<std::shared_ptr<const MeshFile>> meshes;  ///< that the shapes name, as they were read

  /// Does any of its materials carry a concentration?
  [[nodiscard]] bool has_phases() const;

  /// Does anything in it ask for the surface of the points?
  [[nodiscard]] bool wants_skin() const;

  /// Volume that a point is sampled with, m^3; m^3 per metre of depth in 2D.
  [[nodiscard]] double point_volume() const;

  /// Frames 0 … last; frame 0 is t = 0.
  [[nodiscard]] int last_frame() const;
};

/// A change of one field before the scene is read, as `--set /json/pointer=value`.
struct Override {
  std::string pointer;
  std::string json;  ///< the value as JSON text; text that is no JSON is taken as a string
};

/// Gives the bytes of a mesh by the name that a scene has for it, or throws MeshError with the reason why
/// not.
using MeshSource = std::function<std::string(const std::string& file)>;

/// Reads a scene. `size` names one of its "sizes" ("" for none). Sizes are merged first, then overrides.
/// Without `meshes` a scene that names a mesh is refused. Throws InputError with all problems found, each
/// with its pointer.
[[nodiscard]] Scene parse_scene(std::string_view json, std::string_view size = {},
                                const std::vector<Override>& overrides = {}, const MeshSource& meshes = {});

/// The scene with every field written out, canonical: parse_scene(to_json(s)) gives s, and equal scenes give
/// equal text. A mesh stands in it by name and SHA-256.
[[nodiscard]] std::string to_json(const Scene& scene);

/// SHA-256 of to_json(scene), 64 hex digits.
[[nodiscard]] std::string scene_hash(const Scene& scene);

/// JSON Schema (2020-12) of a scene, made from the descriptor tables.
[[nodiscard]] std::string scene_schema();

/// The scene format and the material cards as Markdown tables, made from the descriptor tables.
[[nodiscard]] std::string scene_reference();

/// The material cards ("shaving-cream", …) as a JSON array.
[[nodiscard]] std::string material_cards();

}  // namespace lather
