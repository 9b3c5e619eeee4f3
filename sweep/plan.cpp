#include "sweep/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "engine/base/json_file.hpp"
#include "engine/base/random.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/case_keys.hpp"
#include "engine/scene/scene_reader.hpp"
#include "sweep/design_reader.hpp"

namespace repose::sweep {

namespace {

using Json = CaseDocument::Json;

/// Name under which the values of a design go into a case, to know them again in the faults of the scene.
constexpr const char* kOfDesign = "the design of the sweep";
/// The same of a ladder; where the value stands follows.
constexpr std::string_view kOfLadder = "the ladder of the chart: ";

Json as_json(const Factor& factor, double value) {
  const CaseKey* key = find_case_key(factor.pointer);
  const bool whole = key != nullptr && key->kind == KeyKind::integer && std::abs(value) < 0x1p53 &&
                     value == std::floor(value);
  return whole ? Json(static_cast<std::int64_t>(value)) : Json(value);
}

/// Reads the scene at each point of a design and collects what is wrong there.
class ScenesOfPoints {
 public:
  ScenesOfPoints(const CaseDocument& document, const Design& design) : document_(document), design_(design) {}

  /// Factors that stand for no number of a case are left out.
  Scene at(const DesignPoint& point) {
    const std::vector<double>& values = point.values;
    CaseDocument document = document_;
    Faults faults;
    set(design_.ladder.reference, document, faults);
    for (std::size_t f = 0; f < values.size(); ++f) {
      const Factor& factor = design_.factors[f];
      if (factor.pointer.empty() || !std::isfinite(values[f])) continue;
      try {
        document.set(factor.pointer, as_json(factor, values[f]), kOfDesign);
      } catch (const InputError& error) {
        faults.add(error);
      }
    }
    if (point.rung > 0) set(design_.ladder.rungs[point.rung - 1], document, faults);
    Scene scene = read_scene(document, faults, shapes_);
    ++points_;
    for (const Fault& fault : faults.list()) note(placed(fault), words_of(point));
    return scene;
  }

  /// The faults, each once; one that only some points have names the first of them.
  void add_to(Faults& faults) const {
    for (const Noted& noted : noted_) {
      std::string rule = noted.fault.rule;
      if (noted.points < points_ && !noted.of_factor) rule += " (with " + noted.values + ")";
      faults.add(noted.fault.file, noted.fault.pointer, noted.fault.value, rule);
    }
  }

 private:
  struct Noted {
    Fault fault;
    bool of_factor = false;
    std::string values;
    int points = 0;
  };

  void set(const Variant& variant, CaseDocument& document, Faults& faults) const {
    for (const Override& override : variant.set) {
      try {
        document.set(override.pointer, with_absolute_paths(document_, override),
                     std::string(kOfLadder) + override.place);
      } catch (const InputError& error) {
        faults.add(error);
      }
    }
  }

  [[nodiscard]] std::string words_of(const DesignPoint& point) const {
    std::string words = point.rung > 0 ? design_.ladder.rungs[point.rung - 1].name : "";
    for (std::size_t f = 0; f < point.values.size(); ++f)
      words += fmt::format("{}{} = {}", words.empty() ? "" : ", ", design_.factors[f].name, point.values[f]);
    return words;
  }

  /// Pointer to the first set of frictions that gives a factor the value that a message shows.
  [[nodiscard]] std::string place_of_friction(const Factor& factor, const std::string& value) const {
    const Ladder& ladder = design_.ladder;
    const auto name = std::ranges::find(ladder.friction_names, factor.name) - ladder.friction_names.begin();
    const auto set = std::ranges::find_if(ladder.frictions, [&](const std::vector<double>& values) {
      return shown(as_json(factor, values[static_cast<std::size_t>(name)])) == value;
    });
    if (set == ladder.frictions.end()) return "/chart/frictions";
    return pointer_to(fmt::format("/chart/frictions/{}", set - ladder.frictions.begin()), factor.name);
  }

  /// A fault of a value that the design has set is the design's own.
  [[nodiscard]] std::pair<Fault, bool> placed(Fault fault) const {
    if (fault.file.starts_with(kOfLadder)) {
      const std::string place = fault.file.substr(kOfLadder.size());
      // The last part of the place is the pointer that was set; the fault may lie deeper.
      const std::string pointer = pointer_parts(place)->back();
      fault.pointer =
          place + (fault.pointer.starts_with(pointer) ? fault.pointer.substr(pointer.size()) : "");
      fault.file = document_.source(place);
      return {fault, true};
    }
    if (fault.file != kOfDesign) return {fault, false};
    for (const Factor& factor : design_.factors) {
      if (factor.pointer != fault.pointer) continue;
      if (design_.kind == DesignKind::chart) {
        fault.file = document_.source("/chart/frictions");
        fault.pointer = place_of_friction(factor, fault.value);
      } else if (design_.kind == DesignKind::table) {
        fault.file = document_.resolve("/sweep/table", design_.table_file).string();
        fault.pointer = "column " + factor.name;
      } else {
        fault.pointer = pointer_to("/sweep/factors", factor.name);
        fault.file = document_.source(fault.pointer);
      }
      return {fault, true};
    }
    fault.file = document_.source(fault.pointer);
    return {fault, false};
  }

  void note(const std::pair<Fault, bool>& placed, const std::string& words) {
    const auto& [fault, of_factor] = placed;
    // Every value of a factor that is at fault is named; of a value that follows from others one will do.
    const auto [place, is_new] = index_.emplace(
        std::tuple(fault.file, fault.pointer, fault.rule, of_factor ? fault.value : ""), noted_.size());
    if (is_new) noted_.push_back({fault, of_factor, words, 0});
    ++noted_[place->second].points;
  }

  const CaseDocument& document_;
  const Design& design_;
  ShapeCache shapes_;
  std::vector<Noted> noted_;
  std::map<std::tuple<std::string, std::string, std::string, std::string>, std::size_t> index_;
  int points_ = 0;
};

/// Something to check the rest of the case with when the design itself is not sound: its first levels, then
/// every other level and every rung with them.
std::vector<DesignPoint> samples_of(const Design& design) {
  std::vector<std::vector<double>> levels(design.factors.size());
  for (std::size_t f = 0; f < levels.size(); ++f) {
    levels[f] = design.factors[f].levels;
    for (const auto& row : design.rows)
      if (f < row.values.size()) levels[f].push_back(row.values[f]);
    for (const auto& set : design.ladder.frictions)
      if (f < set.size()) levels[f].push_back(set[f]);
    if (levels[f].empty()) levels[f].push_back(std::nan(""));
  }
  DesignPoint first;
  for (const std::vector<double>& values : levels) first.values.push_back(values.front());
  std::vector<DesignPoint> samples = {first};
  for (std::size_t f = 0; f < levels.size(); ++f)
    for (std::size_t level = 1; level < levels[f].size(); ++level) {
      samples.push_back(first);
      samples.back().values[f] = levels[f][level];
    }
  for (std::size_t rung = 1; rung <= design.ladder.rungs.size(); ++rung) {
    samples.push_back(first);
    samples.back().rung = rung;
  }
  return samples;
}

}  // namespace

FactorValues Plan::factors_of(std::size_t point) const {
  FactorValues values;
  for (std::size_t f = 0; f < design.factors.size(); ++f)
    values[design.factors[f].name] = points[point].values[f];
  return values;
}

std::string Plan::variant_of(std::size_t point) const {
  if (design.kind != DesignKind::chart) return {};
  const std::size_t rung = points[point].rung;
  return rung == 0 ? kReference : design.ladder.rungs[rung - 1].name;
}

Plan make_plan(const CaseDocument& document) {
  Faults faults;
  Plan plan;
  plan.design = read_design(document, faults);
  ScenesOfPoints scenes(document, plan.design);
  if (!faults.empty()) {
    for (const DesignPoint& sample : samples_of(plan.design)) scenes.at(sample);
    scenes.add_to(faults);
    faults.throw_if_any();
  }
  const std::vector<DesignPoint> points = points_of(plan.design);
  for (const DesignPoint& point : points) plan.points.push_back({point.values, scenes.at(point), point.rung});
  scenes.add_to(faults);
  faults.throw_if_any();

  std::set<std::string> keys;
  for (std::size_t p = 0; p < points.size(); ++p) {
    for (const int replicate : points[p].replicates) {
      const std::uint64_t seed = seed_of(plan.design, points[p].values, replicate);
      const std::vector<std::string> names = run_keys(plan.points[p].scene, seed);
      // Two points can be the same test, where a factor changes nothing; it is made once.
      if (keys.insert(names.front()).second)
        plan.runs.push_back({p, replicate, seed, names.front(), {names.begin() + 1, names.end()}});
    }
  }
  return plan;
}

Shard parse_shard(const std::string& text) {
  const auto slash = text.find('/');
  const auto number = [](const char* first, const char* last) {
    int value = 0;
    const auto [end, error] = std::from_chars(first, last, value);
    return error == std::errc{} && end == last ? value : 0;
  };
  Shard shard{0, 0};
  if (slash != std::string::npos) {
    shard.index = number(text.data(), text.data() + slash);
    shard.count = number(text.data() + slash + 1, text.data() + text.size());
  }
  if (shard.index < 1 || shard.index > shard.count)
    throw InputError({"--shard", "", text, "must be I/N with 1 <= I <= N, such as 2/4"});
  return shard;
}

std::vector<std::size_t> runs_of_shard(const Plan& plan, const Shard& shard) {
  std::vector<std::pair<std::uint64_t, std::size_t>> shuffled;
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    const PlannedRun& run = plan.runs[i];
    const std::uint64_t point = hash_of_point(plan.design, plan.points[run.point].values) +
                                mix64(static_cast<std::uint64_t>(plan.points[run.point].rung));
    shuffled.emplace_back(mix64(point + static_cast<std::uint64_t>(run.replicate)), i);
  }
  std::sort(shuffled.begin(), shuffled.end());
  std::vector<std::size_t> mine;
  for (auto i = static_cast<std::size_t>(shard.index - 1); i < shuffled.size();
       i += static_cast<std::size_t>(shard.count))
    mine.push_back(shuffled[i].second);
  std::sort(mine.begin(), mine.end());
  return mine;
}

}  // namespace repose::sweep
