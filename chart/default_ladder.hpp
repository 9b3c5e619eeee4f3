#pragma once

#include "engine/scene/case_document.hpp"
#include "sweep/ladder.hpp"

namespace repose::chart {

/// The case as a sweep makes a chart of it: /sweep is the design "chart", and what /chart leaves out is
/// filled in.
///
/// - frictions: three pairs (μs, μr) over the article's ranges;
/// - rungs: longer steps, softer contacts, less mass, rain and packing, shared columns, looser rest, an end
///   once the angle stands still, faster and instant opening, mixed arithmetic, larger particles, fewer
///   spheres a clump, one shape, one size, spheres: each as far as the case, with what its reference and its
///   working point set, has it and would still be sound.
CaseDocument with_chart(const CaseDocument& document);

/// The same with more rungs at the end of the ladder: what they set themselves.
CaseDocument with_rungs(const CaseDocument& chart, const std::vector<sweep::Variant>& rungs);

}  // namespace repose::chart
