#include <fmt/format.h>

#include "fit/fit_json.hpp"
#include "tools/program/fit_words.hpp"
#include "tools/program/response_source.hpp"
#include "tools/program/verbs.hpp"

namespace repose::program {

namespace {

struct FitOptions {
  CommonOptions common;
  std::string source;
  std::string cheap;
  std::string loss = name_of(fit::Loss::least_squares);
};

int fit_verb(const FitOptions& options) {
  const fit::PowerLaw law = fitted_law_of(options.source, fit::loss_named(options.loss), options.cheap);
  if (options.common.json)
    print_json(fit::to_json(law));
  else
    fmt::print("{}", in_words(law));
  return kDone;
}

}  // namespace

void add_fit(CLI::App& app, Action& chosen) {
  CLI::App* verb = nullptr;
  auto& options = add_verb(app, chosen, "fit", "The equation alpha = C e^a mu_r^b mu_s^c", fit_verb, verb);
  verb->add_option("SOURCE", options.source,
                   "A sweep's folder, or a CSV with the columns e_pp,mu_s,mu_r,angle_deg (and fidelity: "
                   "cheap or reference)")
      ->required();
  verb->add_option(
      "--cheap", options.cheap,
      "A second source, of the same points or others by a cheaper test: both are fitted together, and the "
      "equation is that of SOURCE");
  verb->add_option("--loss", options.loss, "What becomes smallest: the squared errors or the worst one")
      ->check(CLI::IsMember({name_of(fit::Loss::least_squares), name_of(fit::Loss::minimax)}))
      ->capture_default_str();
}

}  // namespace repose::program
