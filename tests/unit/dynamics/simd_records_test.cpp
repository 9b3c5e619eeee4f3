// Records in memory as vectors of fields: every path (AVX-512, AVX, plain) against element-by-element access.
// Tolerance: none, numbers are only moved or added once.

#include "engine/dynamics/simd_records.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "engine/base/random.hpp"

namespace repose {
namespace {

constexpr std::size_t kRecords = 40;

struct Table {
  alignas(64) std::array<double, 8 * kRecords> value;

  explicit Table(RandomStream& random) {
    for (double& v : value) v = random.uniform(-1.0, 1.0);
  }
};

/// Offsets of kSimdWidth records, in no order; a record may come twice if `repeated`.
LaneOffsets some_records(RandomStream& random, bool repeated) {
  LaneOffsets offset;
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane) {
    const auto draw = static_cast<std::size_t>(random.uniform(0.0, repeated ? 3.0 : 4.99));
    offset[lane] = static_cast<std::int32_t>(8 * (repeated ? draw : 5 * lane + draw));
  }
  return offset;
}

TEST(SimdRecords, LoadsEveryFieldOfEveryLane) {
  RandomStream random(1, 0);
  const Table table(random);
  for (int trial = 0; trial < 100; ++trial) {
    const LaneOffsets at = some_records(random, trial % 2 == 0);
    const Fields8 eight = load_fields8(table.value.data(), at.data());
    const Fields4 four = load_fields4(table.value.data(), at.data());
    for (std::size_t lane = 0; lane < kSimdWidth; ++lane) {
      const auto first = static_cast<std::size_t>(at[lane]);
      for (std::size_t f = 0; f < 8; ++f) EXPECT_EQ(eight[f][lane], table.value[first + f]);
      for (std::size_t f = 0; f < 4; ++f) EXPECT_EQ(four[f][lane], table.value[first + f]);
    }
  }
}

TEST(SimdRecords, StoresOnlyTheFieldsAndLanesThatAreMeant) {
  RandomStream random(2, 0);
  const Table source(random);
  for (std::size_t lanes = 1; lanes <= kSimdWidth; ++lanes) {
    const LaneOffsets from = some_records(random, false), to = some_records(random, false);
    Table four(random);
    Table expected = four;
    store_fields4(load_fields4(source.value.data(), from.data()), four.value.data(), to.data(), lanes);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      for (std::size_t f = 0; f < 4; ++f)
        expected.value[static_cast<std::size_t>(to[lane]) + f] =
            source.value[static_cast<std::size_t>(from[lane]) + f];
    EXPECT_EQ(four.value, expected.value) << lanes << " lanes";

    Table eight(random);
    expected = eight;
    store_fields8(load_fields8(source.value.data(), from.data()), eight.value.data(), to.data());
    for (std::size_t lane = 0; lane < kSimdWidth; ++lane)
      for (std::size_t f = 0; f < 8; ++f)
        expected.value[static_cast<std::size_t>(to[lane]) + f] =
            source.value[static_cast<std::size_t>(from[lane]) + f];
    EXPECT_EQ(eight.value, expected.value);
  }
}

TEST(SimdRecords, AddsLaneAfterLaneWhereLanesShareARecord) {
  RandomStream random(3, 0);
  const Table source(random);
  for (std::size_t lanes = 1; lanes <= kSimdWidth; ++lanes) {
    const LaneOffsets from = some_records(random, false);
    const LaneOffsets at_a = some_records(random, true), at_b = some_records(random, true);
    const Fields8 fields = load_fields8(source.value.data(), from.data());
    Table sums(random);
    Table expected = sums;
    add_fields8(fields, at_a.data(), fields, at_b.data(), sums.value.data(), lanes);
    add_fields8(fields, at_a.data(), sums.value.data(), lanes);
    const auto add = [&](const LaneOffsets& at, std::size_t lane) {
      for (std::size_t f = 0; f < 8; ++f)
        expected.value[static_cast<std::size_t>(at[lane]) + f] +=
            source.value[static_cast<std::size_t>(from[lane]) + f];
    };
    for (std::size_t lane = 0; lane < lanes; ++lane) add(at_a, lane), add(at_b, lane);
    for (std::size_t lane = 0; lane < lanes; ++lane) add(at_a, lane);
    EXPECT_EQ(sums.value, expected.value) << lanes << " lanes";
  }
}

TEST(SimdRecords, KeepsTheLanesWhoseBitIsSetInOrder) {
  const std::array<std::int32_t, 8> from{11, -7, 5, 0, 3, 1 << 30, -1, 8};
  for (unsigned bits = 0; bits < 256; ++bits) {
    const KeptLanes kept(bits);
    std::array<std::int32_t, 8> lanes{}, multiples{};
    kept.copy(from.data(), lanes.data());
    kept.copy_multiples(4, 1000, multiples.data());
    std::size_t k = 0;
    for (std::size_t lane = 0; lane < 8; ++lane) {
      if ((bits >> lane & 1U) == 0) continue;
      EXPECT_EQ(lanes[k], from[lane]) << bits;
      EXPECT_EQ(multiples[k], 4 * (1000 + static_cast<std::int32_t>(lane))) << bits;
      ++k;
    }
  }
}

TEST(SimdRecords, ComparesLaneByLaneAndNoNumberIsLess) {
  RandomStream random(4, 0);
  for (int trial = 0; trial < 200; ++trial) {
    SimdReal a([&](auto) { return std::round(random.uniform(-2.0, 2.0)); });
    SimdReal b([&](auto) { return std::round(random.uniform(-2.0, 2.0)); });
    if (trial % 4 == 0) a[0] = std::nan("");
    unsigned expected = 0;
    for (std::size_t lane = 0; lane < kSimdWidth; ++lane)
      if (a[lane] < b[lane]) expected |= 1U << lane;
    EXPECT_EQ(less_bits(a, b), expected);
  }
}

}  // namespace
}  // namespace repose
