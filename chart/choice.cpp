#include "chart/choice.hpp"

#include <algorithm>
#include <stdexcept>

#include "engine/base/json_file.hpp"
#include "engine/scene/case_keys.hpp"
#include "sweep/ladder.hpp"

namespace repose::chart {

namespace {

/// What the next rung adds to a sum of differences: its own, less those of what it stands on.
Differences sum_of(Differences sum, const Differences& more, const Differences& ground) {
  for (std::size_t set = 0; set < sum.rows.size(); ++set)
    for (std::size_t run = 0; run < sum.rows[set].size(); ++run)
      sum.rows[set][run] += more.rows[set][run] - ground.rows[set][run];
  sum.shared = larger(sum.shared, more.shared);  // rungs that share columns share the same ones
  return sum;
}

class Search {
 public:
  Search(double limit, const std::vector<Candidate>& candidates,
         const std::optional<Candidate>& working_point)
      : limit_(limit), candidates_(candidates), has_working_point_(working_point) {
    if (working_point) {
      ground_ = *working_point;
    } else if (!candidates.empty()) {  // the reference: off by nothing, at its own cost
      ground_.angle.rows = candidates.front().angle.rows;
      for (std::vector<double>& set : ground_.angle.rows) std::ranges::fill(set, 0.0);
    }
    for (const Candidate& a : candidates) {
      std::vector<bool>& row = excluded_.emplace_back();
      for (const Candidate& b : candidates) row.push_back(exclude_each_other(a, b));
    }
  }

  std::vector<Combination> run() {
    if (ground_.angle.rows.empty()) return {};
    const Combination alone{{}, ground_.cost_ratio, judge(ground_.angle)};
    if (has_working_point_) keep(alone);
    extend(alone, 0, ground_.angle);
    std::ranges::stable_sort(found_, {}, &Combination::cost_ratio);
    return std::move(found_);
  }

 private:
  void keep(const Combination& combination) {
    if (combination.predicted.bound_95 < limit_ && combination.cost_ratio < 1.0)
      found_.push_back(combination);
  }

  void extend(const Combination& sofar, std::size_t first, const Differences& sum) {
    for (std::size_t k = first; k < candidates_.size(); ++k) {
      const bool free =
          std::ranges::none_of(sofar.rungs, [&](std::size_t rung) { return excluded_[rung][k]; });
      if (!free) continue;
      if (++looked_at_ > kMostCombinations)
        throw std::length_error("the ladder has more than " + std::to_string(kMostCombinations) +
                                " combinations of rungs: leave the poor ones out");
      Combination next = sofar;
      next.rungs.push_back(k);
      next.cost_ratio *= candidates_[k].cost_ratio / ground_.cost_ratio;
      const Differences with = sum_of(sum, candidates_[k].angle, ground_.angle);
      next.predicted = judge(with);
      keep(next);
      extend(next, k + 1, with);
    }
  }

  double limit_;
  const std::vector<Candidate>& candidates_;
  bool has_working_point_;
  Candidate ground_;  ///< what the candidates stand on
  std::vector<std::vector<bool>> excluded_;
  std::vector<Combination> found_;
  std::size_t looked_at_ = 0;
};

}  // namespace

std::string name_of(const Combination& combination, const std::vector<Candidate>& candidates) {
  if (combination.rungs.empty()) return sweep::kWorkingPoint;
  std::string name;
  for (const std::size_t rung : combination.rungs)
    name += (name.empty() ? "" : " + ") + candidates[rung].name;
  return name;
}

bool exclude_each_other(const Candidate& a, const Candidate& b) {
  for (const std::string& one : a.pointers)
    for (const std::string& other : b.pointers)
      if (is_or_is_below(one, other) || is_or_is_below(other, one) || are_rivals(one, other)) return true;
  return false;
}

std::vector<Combination> combinations_within(double limit, const std::vector<Candidate>& candidates,
                                             const std::optional<Candidate>& working_point) {
  return Search(limit, candidates, working_point).run();
}

std::size_t next_after(const std::vector<Combination>& combinations, double cost_ratio) {
  const auto next =
      std::ranges::lower_bound(combinations, kDearer * cost_ratio, {}, &Combination::cost_ratio);
  return static_cast<std::size_t>(next - combinations.begin());
}

}  // namespace repose::chart
