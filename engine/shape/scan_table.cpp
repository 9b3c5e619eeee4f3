#include "engine/shape/scan_table.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <set>

#include "engine/base/csv.hpp"
#include "engine/base/input_error.hpp"

namespace repose {

namespace {

double equivalent_area(double volume, double pi) { return std::cbrt(36.0 * pi * volume * volume); }

class TableReader {
 public:
  TableReader(const std::filesystem::path& file, std::vector<ScannedParticle>& particles)
      : csv_(read_csv(file, faults_)), particles_(particles) {}

  void read() {
    area_ = required("surface_area_mm2");
    volume_ = required("volume_mm3");
    for (std::size_t k = 0; k < 3; ++k) extents_[k] = csv_.column(std::array{"x_mm", "y_mm", "z_mm"}[k]);
    if (!missing_.empty()) missing_.add(faults_);
    missing_.throw_if_any();
    for (std::size_t row = 0; row < csv_.rows.size(); ++row) read_row(row);
    if (csv_.rows.size() < 3 && faults_.empty())
      faults_.add(csv_.file, "", fmt::format("{} rows", csv_.rows.size()),
                  "a line needs at least three particles");
    faults_.throw_if_any();
  }

 private:
  std::size_t required(const std::string& name) {
    const auto column = csv_.column(name);
    if (!column) missing_.add(csv_.file, "", name, "this column is missing");
    return column.value_or(0);
  }

  std::string where(std::size_t row) const { return fmt::format("line {}", csv_.lines[row]); }

  PrintedNumber positive(std::size_t row, std::size_t column) {
    const std::string& cell = csv_.rows[row][column];
    const auto number = parse_number(cell);
    if (!number || *number <= 0.0) {
      faults_.add(csv_.file, where(row), fmt::format("{} '{}'", csv_.columns[column], cell),
                  "must be a number > 0");
      return {std::nan(""), 0};
    }
    const auto point = cell.find('.');
    const auto end = cell.find_first_of("eE");
    if (point == std::string::npos || end != std::string::npos) return {*number, 0};
    return {*number, static_cast<int>(cell.size() - point - 1)};
  }

  std::optional<PrintedNumber> optional_cell(std::size_t row, const std::string& name) {
    const auto column = csv_.column(name);
    if (!column || csv_.rows[row][*column].empty()) return std::nullopt;
    return positive(row, *column);
  }

  void read_row(std::size_t row) {
    ScannedParticle particle;
    particle.line = csv_.lines[row];
    const auto name = csv_.column("no");
    particle.name = name ? csv_.rows[row][*name] : fmt::format("{}", row + 1);
    if (particle.name.empty() || !names_.insert(particle.name).second)
      faults_.add(csv_.file, where(row), particle.name, "every particle needs a number of its own");
    particle.area_mm2 = positive(row, area_).value;
    particle.volume_mm3 = positive(row, volume_);
    if (extents_[0] && extents_[1] && extents_[2])
      particle.extents_mm = Vec3(positive(row, *extents_[0]).value, positive(row, *extents_[1]).value,
                                 positive(row, *extents_[2]).value);
    particle.printed_equivalent_area_mm2 = optional_cell(row, "equivalent_sphere_area_mm2");
    particle.printed_sphericity = optional_cell(row, "sphericity");
    if (particle.printed_sphericity && particle.printed_sphericity->value > 1.0)
      faults_.add(csv_.file, where(row), fmt::format("sphericity {:g}", particle.printed_sphericity->value),
                  "no body has a sphericity above 1: is the column in per cent?");
    particle.equivalent_area_mm2 = equivalent_area(particle.volume_mm3.value, kPi);
    particle.sphericity = particle.equivalent_area_mm2 / particle.area_mm2;
    if (particle.sphericity > 1.0)
      faults_.add(csv_.file, where(row), fmt::format("{:.3f}", particle.sphericity),
                  "no body has a sphericity above 1: the surface is too small for the volume");
    particles_.push_back(std::move(particle));
  }

  Faults faults_, missing_;
  CsvTable csv_;
  std::vector<ScannedParticle>& particles_;
  std::set<std::string> names_;
  std::size_t area_ = 0;
  std::size_t volume_ = 0;
  std::array<std::optional<std::size_t>, 3> extents_;
};

void fit_line(ScanTable& table) {
  const auto n = static_cast<Eigen::Index>(table.particles.size());
  Eigen::VectorXd x(n);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    x[i] = table.particles[static_cast<std::size_t>(i)].area_mm2;
    y[i] = table.particles[static_cast<std::size_t>(i)].equivalent_area_mm2;
  }
  const Eigen::VectorXd dx = x.array() - x.mean();
  const Eigen::VectorXd dy = y.array() - y.mean();
  if (dx.squaredNorm() <= 1e-20 * x.squaredNorm())
    throw InputError({table.file, "", "", "all surface areas are equal: there is no line through them"});
  table.slope = dx.dot(dy) / dx.squaredNorm();
  table.intercept_mm2 = y.mean() - table.slope * x.mean();
  const double rest = (dy - table.slope * dx).squaredNorm();
  table.r_squared = dy.squaredNorm() > 0.0 ? 1.0 - rest / dy.squaredNorm() : 1.0;
  table.adjusted_r_squared =
      1.0 - (1.0 - table.r_squared) * static_cast<double>(n - 1) / static_cast<double>(n - 2);
}

void average_sphericity(ScanTable& table) {
  const auto count = static_cast<double>(table.particles.size());
  bool printed = true;
  for (const ScannedParticle& particle : table.particles) {
    table.mean_recomputed_sphericity += particle.sphericity / count;
    printed = printed && particle.printed_sphericity.has_value();
  }
  table.mean_sphericity = printed ? 0.0 : table.mean_recomputed_sphericity;
  for (const ScannedParticle& particle : table.particles)
    if (printed) table.mean_sphericity += particle.printed_sphericity->value / count;
}

/// Number of the class of this width that a volume belongs to; one on a boundary, to within rounding, to the
/// class that it begins.
double class_of(double volume, double width) {
  const double classes = volume / width;
  const double nearest = std::round(classes);
  return std::abs(classes - nearest) <= 1e-9 * std::max(nearest, 1.0) ? nearest : std::floor(classes);
}

/// 1, 2 or 5 × 10^k, the least with which the volumes fill at most six classes. Volumes that are all about
/// equal tell nothing of a width: then at least a tenth of them.
double nice_width(double low, double high) {
  const double least = high - low > 1e-6 * high ? 0.0 : 0.1 * high;
  for (int step = -36;; ++step) {
    const double nice = std::array{1.0, 2.0, 5.0}[static_cast<std::size_t>((step + 36) % 3)] *
                        std::pow(10.0, std::floor(step / 3.0));
    if (nice >= least && class_of(high, nice) - class_of(low, nice) < 6.0) return nice;
  }
}

void sort_into_classes(ScanTable& table, const ScanTableOptions& options) {
  double low = table.particles.front().volume_mm3.value;
  double high = low;
  for (const ScannedParticle& particle : table.particles) {
    low = std::min(low, particle.volume_mm3.value);
    high = std::max(high, particle.volume_mm3.value);
  }
  const double width = options.class_width_mm3 ? *options.class_width_mm3 : nice_width(low, high);
  const double first = class_of(low, width);
  const double classes = class_of(high, width) - first + 1.0;
  if (classes > kMostSizeClasses)
    throw InputError({table.file, "", fmt::format("class width {:g} mm3", width),
                      fmt::format("makes {:.0f} size classes of the volumes {:g} to {:g} mm3, at most {} are "
                                  "made: take a larger width",
                                  classes, low, high, kMostSizeClasses)});
  table.size_classes.resize(static_cast<std::size_t>(classes));
  for (std::size_t i = 0; i < table.size_classes.size(); ++i) {
    table.size_classes[i].volume_min_mm3 = (first + static_cast<double>(i)) * width;
    table.size_classes[i].volume_max_mm3 = (first + static_cast<double>(i) + 1.0) * width;
  }
  for (const ScannedParticle& particle : table.particles)
    ++table.size_classes[static_cast<std::size_t>(class_of(particle.volume_mm3.value, width) - first)].count;
  for (SizeHistogramClass& size : table.size_classes)
    size.percent = 100.0 * static_cast<double>(size.count) / static_cast<double>(table.particles.size());
}

double half_unit(int decimals) { return 0.5 * std::pow(10.0, -decimals); }

/// Compares one printed value; d ln(value) = 2/3 d ln V for equivalent areas and sphericities alike.
void compare(const ScannedParticle& particle, const std::string& column, const PrintedNumber& printed,
             double recomputed, std::vector<InconsistentValue>& found) {
  const double rounding = 1e-9 * printed.value;
  const double difference = std::abs(recomputed - printed.value);
  if (difference <= half_unit(printed.decimals) + rounding) return;
  const double of_volume =
      2.0 / 3.0 * recomputed / particle.volume_mm3.value * half_unit(particle.volume_mm3.decimals);
  found.push_back({particle.name, particle.line, column, printed.value, recomputed,
                   difference <= half_unit(printed.decimals) + of_volume + rounding});
}

std::vector<InconsistentValue> compare_areas(const ScanTable& table, double pi) {
  std::vector<InconsistentValue> found;
  for (const ScannedParticle& particle : table.particles)
    if (particle.printed_equivalent_area_mm2)
      compare(particle, "equivalent_sphere_area_mm2", *particle.printed_equivalent_area_mm2,
              equivalent_area(particle.volume_mm3.value, pi), found);
  return found;
}

void check_printed(ScanTable& table) {
  constexpr double kShortPi = 3.14;
  const auto exact = compare_areas(table, kPi);
  const auto rough = compare_areas(table, kShortPi);
  table.pi_of_table = rough.size() < exact.size() ? kShortPi : kPi;
  table.inconsistent = rough.size() < exact.size() ? rough : exact;
  for (const ScannedParticle& particle : table.particles)
    if (particle.printed_sphericity)
      compare(particle, "sphericity", *particle.printed_sphericity, particle.sphericity, table.inconsistent);
  std::stable_sort(table.inconsistent.begin(), table.inconsistent.end(),
                   [](const InconsistentValue& a, const InconsistentValue& b) { return a.line < b.line; });
}

}  // namespace

ScanTable read_scan_table(const std::filesystem::path& file, const ScanTableOptions& options) {
  ScanTable table;
  table.file = file.string();
  TableReader(file, table.particles).read();
  fit_line(table);
  average_sphericity(table);
  sort_into_classes(table, options);
  check_printed(table);
  return table;
}

BodyFigures figures_of(const ScannedParticle& particle) {
  return {1e-3 * *particle.extents_mm, 1e-9 * particle.volume_mm3.value, 1e-6 * particle.area_mm2};
}

}  // namespace repose
