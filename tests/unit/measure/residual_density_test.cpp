#include "engine/measure/residual_density.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace repose {
namespace {

// Tops in one line and one far from it have no width: the density must still be one of bounded size. (It
// asked for more memory than a machine has.)
TEST(ResidualDensity, OfALineWithoutWidthFitsIntoMemory) {
  const std::vector<double> residuals{0.0, 0.0, 0.0, 0.0, 0.05}, weights(5, 1.0);
  for (const double bandwidth : {0.0, 1e-18}) {
    const ResidualDensity density(residuals, weights, bandwidth);
    for (const double residual : {-1.0, 0.0, 0.02, 0.05, 1.0})
      EXPECT_TRUE(std::isfinite(density.score(residual)));
  }
}

}  // namespace
}  // namespace repose
