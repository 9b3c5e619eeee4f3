#include "sweep/design.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "engine/base/random.hpp"
#include "sweep/sobol.hpp"

namespace repose::sweep {

namespace {

using Values = std::vector<double>;

std::vector<Values> full_factorial(const std::vector<Factor>& factors) {
  std::vector<Values> points{{}};
  for (const Factor& factor : factors) {
    std::vector<Values> longer;
    longer.reserve(points.size() * factor.levels.size());
    for (const Values& point : points) {
      for (const double level : factor.levels) longer.emplace_back(point).push_back(level);
    }
    points = std::move(longer);
  }
  return points;
}

/// Fused by hand, because a compiler may or may not fuse it and the bits of a point enter seeds and run keys.
double within(const Factor& factor, double x) {
  return std::fma(factor.levels[1] - factor.levels[0], x, factor.levels[0]);
}

std::vector<Values> latin_hypercube(const Design& design) {
  const auto n = static_cast<std::size_t>(design.runs);
  std::vector<Values> points(n, Values(design.factors.size()));
  std::vector<std::size_t> strata(n);
  for (std::size_t f = 0; f < design.factors.size(); ++f) {
    RandomStream random(design.seed, f);
    std::iota(strata.begin(), strata.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i) std::swap(strata[i - 1], strata[random.below(i)]);
    for (std::size_t i = 0; i < n; ++i) {
      const double x = (static_cast<double>(strata[i]) + random.uniform()) / static_cast<double>(n);
      points[i][f] = within(design.factors[f], x);
    }
  }
  return points;
}

std::vector<Values> sobol(const Design& design) {
  const std::size_t d = design.factors.size();
  std::vector<std::uint32_t> shift;
  if (design.scramble) {
    for (std::size_t f = 0; f < d; ++f)
      shift.push_back(static_cast<std::uint32_t>(RandomStream(design.seed, f).next() >> 32));
  }
  SobolSequence sequence(static_cast<int>(d), std::move(shift));
  std::vector<Values> points;
  for (int i = 0; i < design.runs; ++i) {
    Values& point = points.emplace_back(sequence.next());
    for (std::size_t f = 0; f < d; ++f) point[f] = within(design.factors[f], point[f]);
  }
  return points;
}

std::vector<int> one_to(int n) {
  std::vector<int> numbers(static_cast<std::size_t>(n));
  std::iota(numbers.begin(), numbers.end(), 1);
  return numbers;
}

std::vector<DesignPoint> table(const Design& design) {
  std::vector<DesignPoint> points;
  std::map<Values, std::size_t> known;
  for (const TableRow& row : design.rows) {
    const auto [place, is_new] = known.emplace(row.values, points.size());
    if (is_new) points.push_back({row.values, {}, 0});
    std::vector<int>& replicates = points[place->second].replicates;
    if (row.replicate > 0)
      replicates.push_back(row.replicate);
    else
      replicates = one_to(design.replicates);
  }
  return points;
}

std::vector<DesignPoint> rungs_and_frictions(const Design& design) {
  std::vector<DesignPoint> points;
  for (std::size_t rung = 0; rung <= design.ladder.rungs.size(); ++rung)
    for (const Values& values : design.ladder.frictions)
      points.push_back({values, one_to(design.ladder.replicates_of(rung)), rung});
  return points;
}

std::uint64_t hash_of(const std::string& text) { return XXH3_64bits(text.data(), text.size()); }

}  // namespace

std::vector<DesignPoint> points_of(const Design& design) {
  if (design.kind == DesignKind::table) return table(design);
  if (design.kind == DesignKind::chart) return rungs_and_frictions(design);
  std::vector<Values> all = design.kind == DesignKind::full_factorial    ? full_factorial(design.factors)
                            : design.kind == DesignKind::latin_hypercube ? latin_hypercube(design)
                                                                         : sobol(design);
  std::vector<DesignPoint> points;
  points.reserve(all.size());
  for (Values& values : all) points.push_back({std::move(values), one_to(design.replicates), 0});
  return points;
}

std::uint64_t hash_of_point(const Design& design, const std::vector<double>& values) {
  std::vector<std::string> parts;
  for (std::size_t f = 0; f < values.size(); ++f)  // + 0.0 turns −0 into 0
    parts.push_back(fmt::format("{}={};", design.factors[f].pointer, values[f] + 0.0));
  std::sort(parts.begin(), parts.end());
  return hash_of(std::accumulate(parts.begin(), parts.end(), std::string{}));
}

std::uint64_t seed_of(const Design& design, const std::vector<double>& values, int replicate) {
  const std::uint64_t point = design.common_random_numbers ? 0 : hash_of_point(design, values);
  return RandomStream(design.seed, mix64(point) + static_cast<std::uint64_t>(replicate)).next() >> 11;
}

}  // namespace repose::sweep
