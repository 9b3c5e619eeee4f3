#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace repose::peer {

/// One run of one program.
struct ProgramRun {
  double angle = 0.0;         ///< α [degrees]; NaN without a heap
  double bulk_density = 0.0;  ///< of the column [kg/m³]
  double mass_on_base = 0.0;  ///< [kg]
  double cpu = 0.0;           ///< of the whole process, user and system [s]
  long steps = 0;
  int bodies = 0;  ///< poured
};

/// The two programs on one case, friction set and seed; `cpu` is the median of its pairs.
struct PairedRun {
  std::string scene;  ///< the case and what was set
  std::string seed;
  ProgramRun repose, liggghts;
};

/// Mean and standard error of the mean over seeds.
struct Mean {
  double value = 0.0;
  double standard_error = 0.0;  ///< NaN from fewer than two
  int count = 0;
};

inline constexpr double kAngleBar = 0.5;     ///< [degrees], to which two standard errors are added
inline constexpr double kDensityBar = 0.01;  ///< of the bulk density

struct Comparison {
  std::string scene;
  int bodies = 0;
  int seeds = 0;
  Mean repose_angle, liggghts_angle;            ///< [degrees]
  double angle_difference = 0.0;                ///< Repose − LIGGGHTS [degrees]
  double angle_bar = 0.0;                       ///< 0.5° + 2 √(s_R² + s_L²) [degrees]
  Mean repose_density, liggghts_density;        ///< [kg/m³]
  double density_difference = 0.0;              ///< Repose/LIGGGHTS − 1 [-]
  Mean repose_mass, liggghts_mass;              ///< left on the base [kg]
  double repose_cpu = 0.0, liggghts_cpu = 0.0;  ///< median of the seeds [s]
  double cpu_ratio = 0.0;                       ///< median of LIGGGHTS/Repose over the pairs
  double repose_ns = 0.0, liggghts_ns = 0.0;    ///< CPU per body poured and step [ns], median
  std::vector<PairedRun> runs;

  /// Both bars hold; a missing heap, or one seed alone, misses.
  [[nodiscard]] bool passed() const;
};

Mean mean_of(const std::vector<double>& values);
double median_of(std::vector<double> values);

/// Runs below a folder: every folder in it, at any depth, that holds repose.json, liggghts.json and cpu.txt
/// (a line a pair: seconds of Repose, seconds of LIGGGHTS). Its path below `folder` is SCENE/SEED.
std::vector<PairedRun> read_runs(const std::filesystem::path& folder);

/// One row a scene, in the order of their names.
std::vector<Comparison> compare(const std::vector<PairedRun>& runs);

nlohmann::ordered_json to_json(const std::vector<Comparison>& table);
std::string in_words(const std::vector<Comparison>& table);

}  // namespace repose::peer
