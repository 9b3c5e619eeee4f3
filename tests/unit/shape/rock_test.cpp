#include "engine/shape/rock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/input_error.hpp"
#include "engine/shape/mesh_check.hpp"
#include "engine/shape/mesh_file.hpp"
#include "engine/shape/scan_table.hpp"

namespace repose {
namespace {

using ::testing::HasSubstr;

TEST(Rock, HasTheFiveFiguresOfEveryScan) {
  for (const ScannedParticle& particle : read_scan_table("cases/table1_particles.csv").particles) {
    const BodyFigures wanted = figures_of(particle);
    // Coarse and few candidates: the figures must hold for any of them.
    const Rock rock = make_rock(wanted, {.subdivision = 3, .candidates = 12}, "table", particle.name);
    const MeshMeasures body = measure(rock.mesh);
    EXPECT_LT((body.extents - wanted.extents).cwiseQuotient(wanted.extents).cwiseAbs().maxCoeff(), 1e-3)
        << particle.name;
    EXPECT_NEAR(body.volume / wanted.volume, 1.0, 1e-3) << particle.name;
    EXPECT_NEAR(body.area / wanted.area, 1.0, 1e-3) << particle.name;
    EXPECT_TRUE(check_mesh(rock.mesh, "rock").empty()) << particle.name;
  }
}

TEST(Rock, OfTheCasesAreTheirRowsOfTheTable) {
  const ScanTable table = read_scan_table("cases/table1_particles.csv");
  for (const std::size_t row : {std::size_t{12}, std::size_t{32}}) {
    const ScannedParticle& particle = table.particles[row];
    const MeshMeasures body = measure(read_mesh("cases/shapes/particle_" + particle.name + ".stl"));
    EXPECT_NEAR(1e9 * body.volume / particle.volume_mm3.value, 1.0, 1e-3);
    EXPECT_NEAR(body.sphericity() / particle.sphericity, 1.0, 1e-3);
    EXPECT_TRUE((1e3 * body.extents).isApprox(*particle.extents_mm, 1e-3));
  }
}

TEST(Rock, IsTheSameForTheSameSeedOnly) {
  const BodyFigures figures = {Vec3(0.010, 0.007, 0.0075), 1.66e-7, 1.89e-4};
  const RockOptions options = {.subdivision = 2, .candidates = 8};
  RockOptions other = options;
  other.seed = 2;
  EXPECT_EQ(make_rock(figures, options, "", "").mesh.vertices,
            make_rock(figures, options, "", "").mesh.vertices);
  EXPECT_NE(make_rock(figures, options, "", "").mesh.vertices,
            make_rock(figures, other, "", "").mesh.vertices);
}

TEST(Rock, RefusesFiguresThatNoBodyHas) {
  const auto fault = [](const BodyFigures& figures) {
    try {
      make_rock(figures, {.subdivision = 2, .candidates = 4}, "table.csv", "line 3");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(fault({Vec3(1, 1, 1), 1.2, 8.0}), HasSubstr("below that of the box"));
  EXPECT_THAT(fault({Vec3(1, 1, 1), 0.5, 1.0}), HasSubstr("the sphericity exceeds 1"));
  EXPECT_THAT(fault({Vec3(1, 0, 1), 0.5, 1.0}), HasSubstr("must be > 0"));
  // A needle's worth of surface on a body that nearly fills its cube.
  EXPECT_THAT(fault({Vec3(1, 1, 1), 0.9, 40.0}), HasSubstr("table.csv: line 3: no body was found"));
}

}  // namespace
}  // namespace repose
