#pragma once

#include "tools/program/command.hpp"

namespace repose::program {

// The verbs of particle shapes, added to the program like those of verbs.hpp.
void add_shape(CLI::App& app, Action& chosen);
void add_clump(CLI::App& app, Action& chosen);

}  // namespace repose::program
