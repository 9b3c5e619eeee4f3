#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "fit/fit_json.hpp"
#include "fit/selection.hpp"

namespace repose::fit {
namespace {

using nlohmann::json;

/// Reads a saved fit and keeps every fault that it meets.
class Reader {
 public:
  Reader(const json& root, std::string source) : root_(root), source_(std::move(source)) {}

  void fault(const std::string& pointer, const std::string& rule) {
    const json::json_pointer at(pointer);
    std::string value = root_.contains(at) ? root_.at(at).dump() : std::string();
    if (value.size() > 57) value = value.substr(0, 54) + "...";
    faults_.push_back({pointer, value, rule});
  }

  void throw_if_any() const {
    if (!faults_.empty()) throw BadSavedFit(source_, faults_);
  }

  double required(const std::string& pointer) {
    const json::json_pointer at(pointer);
    if (root_.contains(at) && is_finite(root_.at(at))) return root_.at(at).get<double>();
    fault(pointer, root_.contains(at) ? "must be a number" : "is missing");
    return kNaN;
  }

  /// null and absent both mean "not known".
  double optional(const std::string& pointer, double otherwise) {
    const json::json_pointer at(pointer);
    if (!root_.contains(at) || root_.at(at).is_null()) return otherwise;
    return required(pointer);
  }

  int count(const std::string& pointer) {
    const double value = optional(pointer, 0.0);
    if (value >= 0.0 && value <= 1e9) return static_cast<int>(value);
    if (std::isfinite(value)) fault(pointer, "must be a count");
    return 0;
  }

  bool flag(const std::string& pointer, bool otherwise) {
    const json::json_pointer at(pointer);
    if (!root_.contains(at)) return otherwise;
    if (root_.at(at).is_boolean()) return root_.at(at).get<bool>();
    fault(pointer, "must be true or false");
    return otherwise;
  }

  Range range(const std::string& pointer) {
    const json::json_pointer at(pointer);
    if (!root_.contains(at)) {
      fault(pointer, "is missing");
      return {kNaN, kNaN};
    }
    const json& value = root_.at(at);
    const bool two = value.is_array() && value.size() == 2 && is_finite(value[0]) && is_finite(value[1]);
    if (!two || value[0].get<double>() > value[1].get<double>() || value[0].get<double>() < 0.0) {
      fault(pointer, "must be [low, high] with 0 <= low <= high");
      return {kNaN, kNaN};
    }
    return {value[0].get<double>(), value[1].get<double>()};
  }

  bool has(const std::string& pointer) const {
    const json::json_pointer at(pointer);
    return root_.contains(at) && !root_.at(at).is_null();
  }

  const json& at(const std::string& pointer) const { return root_.at(json::json_pointer(pointer)); }

  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

 private:
  static bool is_finite(const json& value) { return value.is_number() && std::isfinite(value.get<double>()); }

  const json& root_;
  std::string source_;
  std::vector<BadSavedFit::Fault> faults_;
};

Estimate estimate(Reader& reader, const std::string& name) {
  Estimate result;
  result.value = reader.required("/" + name);
  result.identified = reader.flag("/identified/" + name, true);
  result.standard_error = reader.optional("/standard_error/" + name, Reader::kNaN);
  result.interval_95 = {Reader::kNaN, Reader::kNaN};
  if (reader.has("/interval_95/" + name)) {
    result.interval_95 = {reader.required("/interval_95/" + name + "/0"),
                          reader.required("/interval_95/" + name + "/1")};
  }
  return result;
}

/// Symmetric and positive semidefinite, but for the rounding of numbers written with seven digits; its
/// diagonal is not negative.
bool is_covariance(const Eigen::Matrix4d& matrix) {
  constexpr double kDigits = 1e-6;
  Eigen::Vector4d scale = matrix.diagonal().cwiseSqrt();
  for (double& s : scale) s = s > 0.0 ? 1.0 / s : 0.0;
  const Eigen::Matrix4d correlation = scale.asDiagonal() * matrix * scale.asDiagonal();
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index j = 0; j < 4; ++j)
      if (scale[i] * scale[j] == 0.0 && matrix(i, j) != 0.0) return false;
  if (!correlation.allFinite() || !correlation.isApprox(correlation.transpose(), kDigits)) return false;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(correlation).eigenvalues().minCoeff() > -kDigits;
}

void read_covariance(Reader& reader, PowerLaw& law) {
  if (!reader.has("/covariance")) return;
  const json& rows = reader.at("/covariance");
  bool square = rows.is_array() && rows.size() == 4;
  for (std::size_t i = 0; square && i < 4; ++i) square = rows[i].is_array() && rows[i].size() == 4;
  if (!square) {
    reader.fault("/covariance", "must be 4 rows of 4 numbers");
    return;
  }
  for (Eigen::Index i = 0; i < 4; ++i) {
    for (Eigen::Index j = 0; j < 4; ++j) {
      const double factor = (i == 0 ? law.C.value : 1.0) * (j == 0 ? law.C.value : 1.0);
      law.covariance(i, j) = reader.optional(fmt::format("/covariance/{}/{}", i, j), 0.0) / factor;
    }
    if (law.covariance(i, i) < 0.0) {
      reader.fault(fmt::format("/covariance/{}/{}", i, i), "must be >= 0");
      return;
    }
  }
  if (!is_covariance(law.covariance))
    reader.fault("/covariance", "must be symmetric and positive semidefinite (are all its digits there?)");
}

void read_error(Reader& reader, PowerLaw& law) {
  law.error.standard_deviation = reader.optional("/residual_sd_deg", 0.0);
  law.error.misfit = reader.optional("/misfit_deg", 0.0);
  if (law.error.misfit < 0.0) reader.fault("/misfit_deg", "must be >= 0");
  law.error.degrees_of_freedom =
      reader.optional("/degrees_of_freedom", std::numeric_limits<double>::infinity());
  law.error.pure_error = reader.optional("/pure_error_deg", Reader::kNaN);
  law.error.lack_of_fit_p = reader.optional("/lack_of_fit_p", Reader::kNaN);
  if (law.error.standard_deviation < 0.0) reader.fault("/residual_sd_deg", "must be >= 0");
  if (law.error.degrees_of_freedom < 1.0) reader.fault("/degrees_of_freedom", "must be >= 1");
  law.worst_error = reader.optional("/worst_error_deg", Reader::kNaN);
  law.rms_error = reader.optional("/rms_error_deg", Reader::kNaN);
  law.r_squared = reader.optional("/r_squared", Reader::kNaN);
  law.points = reader.count("/points");
  law.distinct_points = reader.count("/distinct_points");
}

Observation observation(Reader& reader, const std::string& pointer) {
  Observation row;
  row.e = reader.optional(pointer + "/e_pp", Reader::kNaN);
  row.mu_s = reader.optional(pointer + "/mu_s", Reader::kNaN);
  row.mu_r = reader.optional(pointer + "/mu_r", Reader::kNaN);
  row.angle = reader.optional(pointer + "/angle_deg", Reader::kNaN);
  row.replicate = reader.count(pointer + "/replicate");
  if (reader.has(pointer + "/label") && reader.at(pointer + "/label").is_string()) {
    row.label = reader.at(pointer + "/label").get<std::string>();
  }
  return row;
}

void read_notes(Reader& reader, PowerLaw& law) {
  if (reader.has("/worst_point")) law.worst_point = observation(reader, "/worst_point");
  if (reader.has("/excluded") && reader.at("/excluded").is_array()) {
    for (std::size_t i = 0; i < reader.at("/excluded").size(); ++i) {
      const std::string pointer = fmt::format("/excluded/{}", i);
      const bool said = reader.has(pointer + "/reason") && reader.at(pointer + "/reason").is_string();
      law.excluded.push_back({observation(reader, pointer),
                              said ? reader.at(pointer + "/reason").get<std::string>() : std::string()});
    }
  }
  if (reader.has("/remarks") && reader.at("/remarks").is_array()) {
    for (const json& remark : reader.at("/remarks")) {
      if (remark.is_string()) law.remarks.push_back(remark.get<std::string>());
    }
  }
}

void check_factor(Reader& reader, const PowerLaw& law, Factor factor, const std::string& exponent) {
  const Estimate& estimate = *law.parameters()[static_cast<std::size_t>(factor) + 1];
  const std::string domain = std::string("/domain/") + name_of(factor);
  if (estimate.identified && range_of(law.domain, factor).low <= 0.0) {
    reader.fault(domain, "must be > 0 where the exponent is identified");
  }
  if (!estimate.identified && estimate.value != 0.0) {
    reader.fault("/" + exponent, "must be 0 where it is not identified");
  }
}

std::string lines_of(const std::string& source, const std::vector<BadSavedFit::Fault>& faults) {
  std::vector<std::string> lines;
  for (const auto& [pointer, value, rule] : faults)
    lines.push_back(fmt::format("{}: {}{}{}{}{}", source, pointer, value.empty() ? "" : " = ", value,
                                pointer.empty() ? "" : ": ", rule));
  return fmt::format("{}", fmt::join(lines, "\n"));
}

}  // namespace

BadSavedFit::BadSavedFit(const std::string& source, std::vector<Fault> faults)
    : Unusable(lines_of(source, faults)), faults_(std::move(faults)) {}

PowerLaw power_law_from_json(const json& root, const std::string& source) {
  if (!root.is_object()) throw BadSavedFit(source, {{"", "", "must be the JSON object of a saved fit"}});
  Reader reader(root, source);
  PowerLaw law;
  law.C = estimate(reader, "C");
  law.a = estimate(reader, "a");
  law.b = estimate(reader, "b");
  law.c = estimate(reader, "c");
  if (law.C.value <= 0.0) reader.fault("/C", "must be > 0");
  law.domain.e = reader.range("/domain/e_pp");
  law.domain.mu_s = reader.range("/domain/mu_s");
  law.domain.mu_r = reader.range("/domain/mu_r");
  if (reader.has("/domain/angle_deg")) law.domain.angle = reader.range("/domain/angle_deg");
  check_factor(reader, law, Factor::e, "a");
  check_factor(reader, law, Factor::mu_r, "b");
  check_factor(reader, law, Factor::mu_s, "c");
  if (reader.has("/loss")) {
    const json& loss = reader.at("/loss");
    if (loss == name_of(Loss::minimax)) {
      law.loss = Loss::minimax;
    } else if (loss != name_of(Loss::least_squares)) {
      reader.fault("/loss", "must be least-squares or minimax");
    }
  }
  read_covariance(reader, law);
  read_error(reader, law);
  read_notes(reader, law);
  reader.throw_if_any();
  return law;
}

}  // namespace repose::fit
