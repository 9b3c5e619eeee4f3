#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/shape/rock.hpp"

namespace repose {

/// A number of a table with the decimals that it is printed with.
struct PrintedNumber {
  double value = 0.0;
  int decimals = 0;
};

/// One scanned particle. Millimetres as in the table, since its precision is that of its print.
struct ScannedParticle {
  std::string name;  ///< column `no`, otherwise the number of the row
  int line = 0;
  std::optional<Vec3> extents_mm = {};  ///< columns x_mm, y_mm, z_mm
  double area_mm2 = 0.0;
  PrintedNumber volume_mm3 = {};
  std::optional<PrintedNumber> printed_equivalent_area_mm2 = {};
  std::optional<PrintedNumber> printed_sphericity = {};
  double equivalent_area_mm2 = 0.0;  ///< (36 π V²)^{1/3}, surface of the sphere of equal volume
  double sphericity = 0.0;           ///< Ψ = equivalent area / area (article eq. 10)
};

/// A printed value that is not what the row's volume and area give, rounded to as many decimals.
struct InconsistentValue {
  std::string name;
  int line = 0;
  std::string column;
  double printed = 0.0;
  double recomputed = 0.0;
  bool within_rounding = false;  ///< the rounding of the row's own volume can explain it
};

struct SizeHistogramClass {
  double volume_min_mm3 = 0.0;
  double volume_max_mm3 = 0.0;  ///< not included
  std::size_t count = 0;
  double percent = 0.0;  ///< by number
};

/// Table of scanned particles and what it says of their shape.
struct ScanTable {
  std::string file;
  std::vector<ScannedParticle> particles;
  // Least-squares line: equivalent area = slope · area + intercept (article Figure 4).
  double slope = 0.0;
  double intercept_mm2 = 0.0;
  double r_squared = 0.0;
  double adjusted_r_squared = 0.0;  ///< 1 − (1 − R²)(n−1)/(n−2)
  double mean_sphericity =
      0.0;  ///< of the printed column where every row has it, otherwise of the recomputed values
  double mean_recomputed_sphericity = 0.0;
  std::vector<SizeHistogramClass> size_classes;
  /// π that the column of equivalent areas was computed with: the one of π and 3.14 that more rows agree
  /// with.
  double pi_of_table = 0.0;
  std::vector<InconsistentValue> inconsistent;
};

inline constexpr int kMostSizeClasses = 1000;

struct ScanTableOptions {
  std::optional<double> class_width_mm3 = {};  ///< otherwise 1, 2 or 5 × 10^k with at most six classes
};

/// Reads a table with the columns surface_area_mm2 and volume_mm3, and optionally no, x_mm, y_mm, z_mm,
/// equivalent_sphere_area_mm2, sphericity; others are ignored.
/// Throws InputError with every fault and its line: a column missing, a cell that is no number > 0, a
/// sphericity above 1, computed or printed (no body has that), fewer than three particles, all areas equal, a
/// particle named twice, a class width that makes more than kMostSizeClasses classes.
ScanTable read_scan_table(const std::filesystem::path& file, const ScanTableOptions& options = {});

/// The five figures of a particle in SI. Requires extents_mm.
BodyFigures figures_of(const ScannedParticle& particle);

}  // namespace repose
