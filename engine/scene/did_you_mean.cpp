#include "engine/scene/did_you_mean.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace repose {

namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Levenshtein distance: insertions, deletions and replacements from a to b.
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

std::string_view closest(std::string_view name, const std::vector<std::string_view>& candidates) {
  constexpr std::size_t kShortestPrefix = 3;
  const std::string wanted = lower(name);
  std::string_view best;
  std::string_view prefix;
  std::size_t fewest = std::max<std::size_t>(1, wanted.size() / 3) + 1;
  for (const std::string_view candidate : candidates) {
    const std::string other = lower(candidate);
    if (const std::size_t distance = edits(wanted, other); distance < fewest) {
      fewest = distance;
      best = candidate;
    }
    const bool long_enough = std::min(wanted.size(), other.size()) >= kShortestPrefix;
    if (prefix.empty() && long_enough && (other.starts_with(wanted) || wanted.starts_with(other)))
      prefix = candidate;
  }
  return best.empty() ? prefix : best;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& candidates) {
  const std::string_view found = closest(name, candidates);
  return found.empty() ? std::string() : "; did you mean \"" + std::string(found) + "\"?";
}

}  // namespace repose
