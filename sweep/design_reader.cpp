#include "sweep/design_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "engine/base/json_file.hpp"
#include "engine/scene/case_keys.hpp"
#include "engine/scene/did_you_mean.hpp"
#include "sweep/factor.hpp"
#include "sweep/sobol.hpp"
#include "sweep/table_reader.hpp"

namespace repose::sweep {

namespace {

using Json = CaseDocument::Json;

const std::map<std::string, DesignKind> kKinds = {{"full_factorial", DesignKind::full_factorial},
                                                  {"latin_hypercube", DesignKind::latin_hypercube},
                                                  {"sobol", DesignKind::sobol},
                                                  {"table", DesignKind::table},
                                                  {"chart", DesignKind::chart}};

const std::set<std::string> kCommonKeys = {"design", "replicates", "seed", "common_random_numbers"};

const std::map<DesignKind, std::set<std::string>> kKeysOfKind = {
    {DesignKind::full_factorial, {"factors"}},
    {DesignKind::latin_hypercube, {"factors", "runs"}},
    {DesignKind::sobol, {"factors", "runs", "scramble"}},
    {DesignKind::table, {"table"}},
    {DesignKind::chart, {}}};

class DesignReader {
 public:
  DesignReader(const CaseDocument& document, Faults& faults)
      : document_(document), sweep_(document.find("/sweep")), faults_(faults) {}

  Design read() {
    if (sweep_ == nullptr || !sweep_->is_object()) {
      if (sweep_ == nullptr)
        fault("", "", "is missing: the case has no design to sweep");
      else
        fault("", shown(*sweep_), "must be an object");
      return {};
    }
    Design design;
    const std::optional<DesignKind> kind = read_kind();
    design.kind = kind.value_or(DesignKind::full_factorial);
    check_keys(kind);
    if (kind == DesignKind::chart) {
      read_chart(design);
      return design;
    }
    design.replicates = static_cast<int>(read_integer("replicates", 1, 1, kMostRuns));
    design.seed = static_cast<std::uint64_t>(read_integer("seed", 1, 0, 0x1p53 - 1.0));
    design.common_random_numbers = read_boolean("common_random_numbers");
    design.scramble = read_boolean("scramble");
    if (kind == DesignKind::latin_hypercube || kind == DesignKind::sobol) {
      if (!sweep_->contains("runs")) fault("/runs", "", "is required: how many points the design has");
      design.runs = static_cast<int>(read_integer("runs", 1, 1, kMostRuns));
    }
    if (kind == DesignKind::table)
      read_table(design);
    else
      read_factors(design, kind);
    check_size(design);
    return design;
  }

 private:
  void fault(const std::string& pointer, const std::string& value, const std::string& rule) {
    const std::string whole = "/sweep" + pointer;
    faults_.add(document_.source(whole), whole, value, rule);
  }

  std::optional<DesignKind> read_kind() {
    const std::string names = "full_factorial, latin_hypercube, sobol, table or chart";
    if (!sweep_->contains("design")) {
      fault("/design", "", "is required: " + names);
      return std::nullopt;
    }
    const Json& value = sweep_->at("design");
    const auto found = value.is_string() ? kKinds.find(value.get<std::string>()) : kKinds.end();
    if (found != kKinds.end()) return found->second;
    fault("/design", shown(value), "must be " + names);
    return std::nullopt;
  }

  void check_keys(std::optional<DesignKind> kind) {
    std::set<std::string> known = kCommonKeys;
    for (const auto& [of_kind, keys] : kKeysOfKind) known.insert(keys.begin(), keys.end());
    const std::vector<std::string_view> names(known.begin(), known.end());
    for (const auto& [key, value] : sweep_->items()) {
      if (!known.contains(key))
        fault(pointer_to("", key), shown(value), "is not known here" + did_you_mean(key, names));
      else if (kind && key != "design" && (kind == DesignKind::chart || !kCommonKeys.contains(key)) &&
               !kKeysOfKind.at(*kind).contains(key))
        fault("/" + key, shown(value), "does not belong to a design of this kind");
    }
  }

  /// An integer of [low, high], or the default where the key is missing or a fault was added.
  std::int64_t read_integer(const char* key, std::int64_t otherwise, std::int64_t low, double high) {
    if (!sweep_->contains(key)) return otherwise;
    const Json& value = sweep_->at(key);
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!(number >= static_cast<double>(low) && number <= high && number == std::floor(number))) {
      fault(std::string("/") + key, shown(value),
            fmt::format("must be an integer from {} to {:.0f}", low, high));
      return otherwise;
    }
    return static_cast<std::int64_t>(number);
  }

  bool read_boolean(const char* key) {
    if (!sweep_->contains(key)) return false;
    const Json& value = sweep_->at(key);
    if (!value.is_boolean()) fault(std::string("/") + key, shown(value), "must be true or false");
    return value.is_boolean() && value.get<bool>();
  }

  void read_factors(Design& design, std::optional<DesignKind> kind) {
    if (!sweep_->contains("factors")) {
      fault("/factors", "", "is required: at least one factor with its values");
      return;
    }
    const Json& factors = sweep_->at("factors");
    if (!factors.is_object() || factors.empty()) {
      fault("/factors", shown(factors), "must be an object with at least one factor");
      return;
    }
    for (const auto& [name, levels] : factors.items()) {
      const std::string place = pointer_to("/factors", name);
      add_factor(name, document_.source("/sweep" + place), "/sweep" + place, design.factors, faults_);
      if (kind) design.factors.back().levels = read_levels(place, levels, *kind);
    }
    if (kind == DesignKind::sobol && factors.size() > static_cast<std::size_t>(kSobolDimensions))
      fault("/factors", std::to_string(factors.size()) + " factors",
            fmt::format("a sobol design takes at most {}", kSobolDimensions));
  }

  std::vector<double> read_levels(const std::string& place, const Json& levels, DesignKind kind) {
    const bool is_range = kind != DesignKind::full_factorial;
    if (!levels.is_array() || levels.empty() || (is_range && levels.size() != 2)) {
      fault(place, shown(levels),
            is_range ? "must be a range [low, high]" : "must be a list of at least one number");
      return {};
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const std::string where = fmt::format("{}/{}", place, i);
      if (!levels[i].is_number()) {
        fault(where, shown(levels[i]), "must be a number");
        continue;
      }
      const auto value = levels[i].get<double>();
      if (!is_range && std::find(values.begin(), values.end(), value) != values.end())
        fault(where, shown(levels[i]), "stands in this list twice");
      values.push_back(value);
    }
    if (is_range && values.size() == 2 && !(values[0] < values[1]))
      fault(place, shown(levels), "low must be below high");
    return values;
  }

  void read_chart(Design& design) {
    design.ladder = read_ladder(document_, faults_);
    design.replicates = design.ladder.replicates;
    design.seed = design.ladder.seed;
    for (const std::string& name : design.ladder.friction_names)
      if (factor_pointer(name))
        add_factor(name, document_.source("/chart/frictions"), "/chart/frictions", design.factors, faults_);
    const Ladder& ladder = design.ladder;
    const double runs =
        static_cast<double>(ladder.frictions.size()) *
        (ladder.replicates + static_cast<double>(ladder.rungs.size()) * ladder.rung_replicates);
    if (runs > kMostRuns)
      faults_.add(document_.source("/chart"), "/chart", fmt::format("{:.0f} runs", runs),
                  fmt::format("must be at most {:.0f}", kMostRuns));
  }

  void read_table(Design& design) {
    if (!sweep_->contains("table")) {
      fault("/table", "", "is required: a CSV with a column for each factor");
      return;
    }
    const Json& value = sweep_->at("table");
    if (!value.is_string() || value.get<std::string>().empty()) {
      fault("/table", shown(value), "must be the path of a CSV");
      return;
    }
    design.table_file = value.get<std::string>();
    read_design_table(document_.resolve("/sweep/table", design.table_file), design, faults_);
    if (sweep_->contains("replicates") && !design.rows.empty() && design.rows.front().replicate > 0)
      fault("/replicates", shown(sweep_->at("replicates")), "the table numbers its replicates itself");
  }

  void check_size(const Design& design) {
    double runs = design.replicates;
    if (design.kind == DesignKind::full_factorial)
      for (const Factor& factor : design.factors) runs *= static_cast<double>(factor.levels.size());
    else
      runs *= design.kind == DesignKind::table ? static_cast<double>(design.rows.size()) : design.runs;
    if (runs > kMostRuns)
      fault("", fmt::format("{:.0f} runs", runs), fmt::format("must be at most {:.0f}", kMostRuns));
  }

  const CaseDocument& document_;
  const Json* sweep_;
  Faults& faults_;
};

}  // namespace

Design read_design(const CaseDocument& document, Faults& faults) {
  return DesignReader(document, faults).read();
}

}  // namespace repose::sweep
