#include "chart/choice.hpp"

#include <algorithm>
#include <stdexcept>

namespace repose::chart {

namespace {

bool leads_to_or_below(const std::string& pointer, const std::string& other) {
  return other.starts_with(pointer) && (other.size() == pointer.size() || other[pointer.size()] == '/');
}

Differences sum_of(Differences sum, const Differences& more) {
  for (std::size_t set = 0; set < sum.size(); ++set)
    for (std::size_t run = 0; run < sum[set].size(); ++run) sum[set][run] += more[set][run];
  return sum;
}

class Search {
 public:
  Search(double limit, const std::vector<Candidate>& candidates) : limit_(limit), candidates_(candidates) {
    for (const Candidate& a : candidates) {
      std::vector<bool>& row = excluded_.emplace_back();
      for (const Candidate& b : candidates) row.push_back(exclude_each_other(a, b));
    }
  }

  std::vector<Combination> run() {
    if (candidates_.empty()) return {};
    Differences none = candidates_.front().angle;
    for (std::vector<double>& set : none) std::ranges::fill(set, 0.0);
    extend({}, 0, none);
    std::ranges::stable_sort(found_, {}, &Combination::cost_ratio);
    return std::move(found_);
  }

 private:
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
      next.cost_ratio *= candidates_[k].cost_ratio;
      const Differences with = sum_of(sum, candidates_[k].angle);
      next.predicted = judge(with);
      if (next.predicted.bound_95 < limit_) found_.push_back(next);
      extend(next, k + 1, with);
    }
  }

  double limit_;
  const std::vector<Candidate>& candidates_;
  std::vector<std::vector<bool>> excluded_;
  std::vector<Combination> found_;
  std::size_t looked_at_ = 0;
};

}  // namespace

std::string name_of(const Combination& combination, const std::vector<Candidate>& candidates) {
  std::string name;
  for (const std::size_t rung : combination.rungs)
    name += (name.empty() ? "" : " + ") + candidates[rung].name;
  return name;
}

bool exclude_each_other(const Candidate& a, const Candidate& b) {
  for (const std::string& one : a.pointers)
    for (const std::string& other : b.pointers)
      if (leads_to_or_below(one, other) || leads_to_or_below(other, one)) return true;
  return false;
}

std::vector<Combination> combinations_within(double limit, const std::vector<Candidate>& candidates) {
  return Search(limit, candidates).run();
}

std::size_t next_after(const std::vector<Combination>& combinations, double cost_ratio) {
  const auto next =
      std::ranges::lower_bound(combinations, kDearer * cost_ratio, {}, &Combination::cost_ratio);
  return static_cast<std::size_t>(next - combinations.begin());
}

}  // namespace repose::chart
