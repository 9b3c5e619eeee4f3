#pragma once

#include "tools/program/command.hpp"

namespace repose::program {

// One function a verb: adds it to the program with its options; the verb's file holds what it does.
void add_calibrate(CLI::App& app, Action& chosen);
void add_simulate(CLI::App& app, Action& chosen);
void add_sweep(CLI::App& app, Action& chosen);
void add_status(CLI::App& app, Action& chosen);
void add_export(CLI::App& app, Action& chosen);
void add_merge(CLI::App& app, Action& chosen);
void add_chart(CLI::App& app, Action& chosen);
void add_fit(CLI::App& app, Action& chosen);
void add_invert(CLI::App& app, Action& chosen);
void add_report(CLI::App& app, Action& chosen);
void add_stability(CLI::App& app, Action& chosen);

}  // namespace repose::program
