// Frames of points whose materials keep different fields.

#include "sim/snapshot.h"

#include <gtest/gtest.h>

#include "sim/plan/planned_fields.h"

namespace lather {
namespace {

TEST(Snapshot, ShowsTheVolumeByTheLawAndZeroForWhatALawDoesNotKeep) {
  Plan plan;
  Scene& scene = plan.scene;
  scene.solver = Solver::kMlsrk;
  scene.domain.box = {Vec3::Zero(), Vec3::Ones()};
  scene.spacing = 0.1;
  scene.points_per_cell = 1;
  for (const Law& law : {Law(HerschelBulkleyParameters{}), Law(SnowParameters{}), Law(LiquidParameters{})}) {
    Material m;
    m.law = law;
    scene.materials.push_back(m);
  }
  scene.output.scalars = {"J", "plastic_strain", "plasticity", "weak"};
  scene.look.color_by = "J";
  plan.scalars = planned_scalars(scene);
  std::vector<ParticleSet<float>> sets;
  for (const Material& m : scene.materials) {
    sets.emplace_back(3, planned_fields(scene, m), Vec3::Zero(), scene.spacing);
    sets.back().add(Vec3::Constant(0.5), Vec3::Zero(), Mat3::Zero(), static_cast<std::uint32_t>(sets.size()));
  }
  sets[0].values<float>(0, Field::kVolumeChange)[0] = 0.5F;
  sets[0].values<float>(0, Field::kPlasticStrain)[0] = 3;
  sets[1].values<float>(0, Field::kDeformation, 0)[0] = -0.5F;
  sets[1].values<float>(0, Field::kDeformation, 1)[0] = 7;
  sets[1].values<float>(0, Field::kPlasticVolume)[0] = -0.5F;
  sets[2].values<float>(0, Field::kVolumeChange)[0] = -0.25F;

  const Frame f = Snapshot(scene).take(sets, 2, plan, 4);
  EXPECT_EQ(f.index, 4);
  EXPECT_EQ(f.time, 2);
  EXPECT_EQ(f.points.material, (std::vector<std::uint8_t>{0, 1, 2}));
  EXPECT_EQ(f.points.id, (std::vector<std::uint32_t>{1, 2, 3}));
  ASSERT_EQ(f.points.scalars.size(), 4U);
  EXPECT_EQ(f.points.scalars[0].name, "J");
  EXPECT_EQ(f.points.scalars[0].values, (std::vector<float>{1.5F, 0.25F, 0.75F}));
  EXPECT_EQ(f.points.scalars[1].values, (std::vector<float>{3, 0, 0}));
  EXPECT_EQ(f.points.scalars[2].values, (std::vector<float>{0, 0, 0}));
  EXPECT_EQ(f.points.scalars[3].values, (std::vector<float>{0, 0, 0}));
}

}  // namespace
}  // namespace lather
