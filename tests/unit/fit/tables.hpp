#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "fit/power_law.hpp"
#include "fit/response_table.hpp"
#include "fit/solver.hpp"

namespace repose::fit::test {

// The article's equation (Li et al. 2017, eq. 13): α = 56.61 e^0.01 μr^0.084 μs^0.25.
inline constexpr double kC = 56.61, kA = 0.01, kB = 0.084, kExponentS = 0.25;
inline double article_angle(double e, double mu_s, double mu_r) {
  return kC * std::pow(e, kA) * std::pow(mu_r, kB) * std::pow(mu_s, kExponentS);
}

// 3 × 3 × 3 factorial inside the article's ranges, each point `replicates` times.
inline std::vector<Observation> article_table(int replicates = 1) {
  std::vector<Observation> table;
  for (const double e : {0.1, 0.3, 0.5}) {
    for (const double mu_s : {0.2, 0.4, 0.8}) {
      for (const double mu_r : {0.05, 0.1, 0.2}) {
        for (int k = 0; k < replicates; ++k) {
          table.push_back({.e = e,
                           .mu_s = mu_s,
                           .mu_r = mu_r,
                           .angle = article_angle(e, mu_s, mu_r),
                           .replicate = k,
                           .standard_error = 0.0,
                           .label = {},
                           .exclusion = {}});
        }
      }
    }
  }
  return table;
}

// Normal deviates by Box-Muller: the same on every machine.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1.0p-53; }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace repose::fit::test
