#pragma once

#include <string>

#include "chart/chart.hpp"

namespace repose::program {

/// The table of a chart, the most expensive rung first, with what did not complete below it.
std::string in_words(const chart::Chart& chart);

/// "0.31° ± 0.22° (below 0.68° with 95 % confidence), 41 times cheaper".
std::string in_words(const chart::Comparison& rung);

/// What there is to know about a chart whose reference did not complete.
std::string reference_failed(const chart::Chart& chart);

}  // namespace repose::program
