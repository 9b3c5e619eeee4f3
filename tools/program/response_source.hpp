#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fit/power_law.hpp"
#include "sweep/study.hpp"

namespace repose::program {

/// What the study of a folder says about α(e, μs, μr): every run that the design has, those that did not
/// complete with the reason why a fit leaves them out.
struct StudyResponses {
  std::vector<fit::Observation> table;
  std::vector<std::string> remarks;  ///< what a reader of the equation has to know, in sentences
};

/// A run as a fit takes it.
fit::Observation observation_of(const sweep::StoredRun& run);

StudyResponses read_responses(const sweep::Study& study);
/// The equation of a study's responses, with their remarks. Throws fit::Unusable.
fit::PowerLaw fit_of(const StudyResponses& responses, fit::Loss loss);

/// The equation that a source gives: a sweep's folder or a CSV (response_csv.hpp), fitted now, or a saved fit
/// (a JSON file), as it was fitted then. Throws InputError and fit::Unusable.
fit::PowerLaw law_of(const std::filesystem::path& source, fit::Loss loss);

/// The same, but a saved fit is a fault: there is nothing to be fitted.
/// @param cheap  a source of the same kind, whose runs are of a cheaper test (fit/two_fidelities.hpp); empty:
/// none
fit::PowerLaw fitted_law_of(const std::filesystem::path& source, fit::Loss loss,
                            const std::filesystem::path& cheap = {});

}  // namespace repose::program
