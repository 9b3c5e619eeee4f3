#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "chart/chart.hpp"

namespace repose::chart {

/// One line a rung; the columns are described in chart/README.md. Cells of what is not known are empty.
std::string chart_csv(const Chart& chart);

/// All that a chart holds; numbers that are not known are null.
nlohmann::ordered_json to_json(const Chart& chart);
nlohmann::ordered_json to_json(const Comparison& rung, const sweep::Variant& variant);

}  // namespace repose::chart
