// A few of the cases that tools/hostile runs by the hundred.

#include <gtest/gtest.h>

#include "stability/hostile/sample/hostile_sample.hpp"

namespace repose::hostile {
namespace {

TEST(HostileSample, EveryCaseEndsWithASoundHeapOrANamedOutcome) {
  SampleOptions options;
  options.cases = 40;
  options.reruns = 0;
  const SampleReport report = run_sample(options);
  for (const SampleFault& fault : report.faults)
    ADD_FAILURE() << "case " << fault.index << ": " << fault.text << " (tools/hostile --show " << fault.index
                  << ")";
  EXPECT_GE(report.outcomes.size(), 3u) << "a sample of many outcomes";
  EXPECT_GT(report.outcomes.at("completed")[0], 0) << "of nearly sensible cases";
}

}  // namespace
}  // namespace repose::hostile
