#pragma once

#include <string>

namespace repose::fit {

/// A closed interval.
struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// The factors of the predictive equation, all dimensionless.
struct Factors {
  double e = 0.0;     ///< restitution between particles
  double mu_s = 0.0;  ///< static (sliding) friction μs between particles
  double mu_r = 0.0;  ///< rolling friction μr between particles
};

/// One row of a table of responses: a simulated (or otherwise known) angle of repose and its factors.
struct Observation {
  double e = 0.0;
  double mu_s = 0.0;
  double mu_r = 0.0;
  double angle = 0.0;           ///< α [deg], the unit that the equation is written in
  int replicate = 0;            ///< number of the repeat at the same factors
  double standard_error = 0.0;  ///< of the angle as it was read [deg], 0 if unknown; shown, not a weight
  std::string label = {};       ///< how messages name the row ("run 12", "line 4"), may be empty
  bool cheap = false;           ///< of a cheaper test than the one that the law is for (two_fidelities.hpp)
  std::string exclusion = {};   ///< why the caller keeps it out of a fit ("no heap"), empty if usable
};

inline Factors factors_of(const Observation& row) { return {row.e, row.mu_s, row.mu_r}; }

}  // namespace repose::fit
