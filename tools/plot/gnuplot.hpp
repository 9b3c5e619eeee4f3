#pragma once

#include <string>

namespace repose {

/// A string as gnuplot reads it in single quotes.
std::string gnuplot_quoted(const std::string& text);

/// Runs a gnuplot script and waits for it. Throws std::runtime_error with gnuplot's message if it is missing
/// or fails.
void run_gnuplot(const std::string& script);

}  // namespace repose
