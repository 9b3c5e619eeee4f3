#include "fit/selection.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace repose::fit {
namespace {

// Values closer than this, relatively, are the same setting written twice.
constexpr double kSameValue = 1e-9;
// Columns of ln x that are this close to dependent leave no digit of the exponents.
constexpr double kDependent = 1e-7;

std::string fault_of(const Observation& row) {
  if (!row.exclusion.empty()) return row.exclusion;
  const Factors factors = factors_of(row);
  for (const Factor factor : kFactors) {
    const double value = value_of(factors, factor);
    if (!std::isfinite(value)) return fmt::format("{} is not a finite number", name_of(factor));
    if (value < 0.0) return fmt::format("{} = {}: must be > 0", name_of(factor), value);
  }
  if (factors.e > 1.0) return fmt::format("{} = {}: must be <= 1", name_of(Factor::e), factors.e);
  if (!std::isfinite(row.angle)) return "the angle is not a finite number";
  if (row.angle <= 0.0) return fmt::format("angle = {} deg: must be > 0", row.angle);
  if (row.angle >= 90.0) return fmt::format("angle = {} deg: must be < 90", row.angle);
  return {};
}

bool varies(const std::vector<Observation>& rows, Factor factor) {
  if (rows.empty()) return false;
  const auto [low, high] =
      std::minmax_element(rows.begin(), rows.end(), [factor](const Observation& p, const Observation& q) {
        return value_of(factors_of(p), factor) < value_of(factors_of(q), factor);
      });
  const double largest = value_of(factors_of(*high), factor);
  return largest - value_of(factors_of(*low), factor) > kSameValue * largest;
}

/// The factor that varies and is 0 in the fewest rows, if one is.
std::optional<Factor> fewest_zeros(const std::vector<Observation>& rows) {
  std::optional<Factor> fewest;
  std::ptrdiff_t least = 0;
  for (const Factor factor : kFactors) {
    if (!varies(rows, factor)) continue;
    const auto zeros = std::ranges::count_if(
        rows, [factor](const Observation& row) { return value_of(factors_of(row), factor) == 0.0; });
    if (zeros > 0 && (!fewest || zeros < least)) fewest = factor, least = zeros;
  }
  return fewest;
}

// A zero only harms where the factor varies: a table simulated at e = 0 throughout still has a law in μs, μr.
// Whether it does can hang on rows that go for another factor's zero.
void exclude_zeros(Selection& selection) {
  while (const auto factor = fewest_zeros(selection.used)) {
    const std::string reason = fmt::format("{} = 0: a power law cannot take a factor at 0", name_of(*factor));
    std::vector<Observation> kept;
    for (Observation& row : selection.used) {
      if (value_of(factors_of(row), *factor) == 0.0)
        selection.excluded.push_back({std::move(row), reason});
      else
        kept.push_back(std::move(row));
    }
    selection.used = std::move(kept);
  }
}

std::string reasons_of(const std::vector<Excluded>& excluded) {
  std::map<std::string, int> count;
  for (const Excluded& row : excluded) ++count[row.reason];
  std::string text;
  for (const auto& [reason, rows] : count) text += fmt::format("\n  {} x {}", rows, reason);
  return text;
}

/// The settings of a factor, ascending: of values that differ by rounding alone the least.
std::vector<double> settings_of(const std::vector<Observation>& rows, Factor factor) {
  std::vector<double> values;
  for (const Observation& row : rows) values.push_back(value_of(factors_of(row), factor));
  std::sort(values.begin(), values.end());
  std::vector<double> settings;
  for (const double value : values)
    if (settings.empty() || value - settings.back() > kSameValue * value) settings.push_back(value);
  return settings;
}

void number_distinct_points(Selection& selection) {
  std::map<std::vector<double>, int> points, places;
  std::vector<std::vector<double>> settings;
  for (const Factor factor : selection.varying) settings.push_back(settings_of(selection.used, factor));
  for (const Observation& row : selection.used) {
    std::vector<double> key;
    for (std::size_t k = 0; k < settings.size(); ++k) {
      const double value = value_of(factors_of(row), selection.varying[k]);
      key.push_back(*std::prev(std::upper_bound(settings[k].begin(), settings[k].end(), value)));
    }
    selection.place_of.push_back(places.emplace(key, static_cast<int>(places.size())).first->second);
    key.push_back(row.cheap ? 1.0 : 0.0);
    selection.point_of.push_back(points.emplace(key, static_cast<int>(points.size())).first->second);
  }
  selection.distinct_points = static_cast<int>(points.size());
  selection.places = static_cast<int>(places.size());
}

std::string list_of(const std::vector<Factor>& factors) {
  std::string text;
  for (const Factor factor : factors) text += (text.empty() ? "" : ", ") + std::string(name_of(factor));
  return text;
}

void require_enough(const Selection& selection) {
  if (selection.used.empty()) {
    throw Unusable(selection.excluded.empty()
                       ? "nothing to fit: the table has no rows"
                       : fmt::format("nothing to fit: none of the {} rows can be used:{}",
                                     selection.excluded.size(), reasons_of(selection.excluded)));
  }
  const std::size_t parameters = selection.varying.size() + 1;
  if (static_cast<std::size_t>(selection.distinct_points) <= parameters) {
    const std::string what = selection.varying.empty()
                                 ? "C alone (no factor varies)"
                                 : fmt::format("C and the exponents of {}", list_of(selection.varying));
    throw Unusable(
        fmt::format("too few points: {} distinct {} cannot determine {}, at least {} are needed{}{}",
                    selection.distinct_points, selection.distinct_points == 1 ? "point" : "points", what,
                    selection.varying.empty() ? 2 : static_cast<int>(parameters) + 1,
                    selection.excluded.empty() ? "" : "; left out:", reasons_of(selection.excluded)));
  }
}

void require_independent(const Selection& selection) {
  Eigen::MatrixXd columns = problem_of(selection).log_factors;
  if (columns.cols() < 2) return;
  columns.rowwise() -= columns.colwise().mean().eval();
  for (Eigen::Index k = 0; k < columns.cols(); ++k) columns.col(k).normalize();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(kDependent);
  if (qr.rank() < columns.cols()) {
    throw Unusable(
        fmt::format("the factors {} only vary together in this table: their exponents cannot be told apart; "
                    "add points that change one of them alone",
                    list_of(selection.varying)));
  }
}

}  // namespace

const char* name_of(Factor factor) {
  switch (factor) {
    case Factor::e:
      return "e_pp";
    case Factor::mu_r:
      return "mu_r";
    case Factor::mu_s:
      return "mu_s";
  }
  return "";
}

double value_of(const Factors& factors, Factor factor) {
  switch (factor) {
    case Factor::e:
      return factors.e;
    case Factor::mu_r:
      return factors.mu_r;
    case Factor::mu_s:
      return factors.mu_s;
  }
  return 0.0;
}

void set(Factors& factors, Factor factor, double value) {
  switch (factor) {
    case Factor::e:
      factors.e = value;
      break;
    case Factor::mu_r:
      factors.mu_r = value;
      break;
    case Factor::mu_s:
      factors.mu_s = value;
      break;
  }
}

const Range& range_of(const Domain& domain, Factor factor) {
  switch (factor) {
    case Factor::mu_r:
      return domain.mu_r;
    case Factor::mu_s:
      return domain.mu_s;
    default:
      return domain.e;
  }
}

Selection select_points(std::span<const Observation> table) {
  Selection selection;
  for (const Observation& row : table) {
    std::string fault = fault_of(row);
    if (fault.empty()) {
      selection.used.push_back(row);
    } else {
      selection.excluded.push_back({row, std::move(fault)});
    }
  }
  exclude_zeros(selection);
  std::copy_if(kFactors.begin(), kFactors.end(), std::back_inserter(selection.varying),
               [&](Factor factor) { return varies(selection.used, factor); });
  number_distinct_points(selection);
  require_enough(selection);
  require_independent(selection);
  return selection;
}

PowerProblem problem_of(const Selection& selection) {
  const auto rows = static_cast<Eigen::Index>(selection.used.size());
  PowerProblem problem;
  problem.log_factors.resize(rows, static_cast<Eigen::Index>(selection.varying.size()));
  problem.response.resize(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Observation& row = selection.used[static_cast<std::size_t>(i)];
    problem.response(i) = row.angle;
    for (std::size_t k = 0; k < selection.varying.size(); ++k) {
      problem.log_factors(i, static_cast<Eigen::Index>(k)) =
          std::log(value_of(factors_of(row), selection.varying[k]));
    }
  }
  return problem;
}

}  // namespace repose::fit
