// Arrays of records that grow from small memory into large pages and back keep their records and alignment.

#include "engine/base/record_vector.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace repose::test {
namespace {

struct alignas(64) Record {
  std::size_t number = 0;
};

TEST(RecordVector, KeepsItsRecordsWhileItGrowsIntoLargePages) {
  constexpr std::size_t kMany = 100'000;  // 6.4 MB, beyond kLarge
  RecordVector<Record> records;
  for (std::size_t k = 0; k < kMany; ++k) {
    records.push_back({k});
    ASSERT_EQ(reinterpret_cast<std::uintptr_t>(records.data()) % alignof(Record), 0U);
  }
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(records.data()) % RecordAllocator<Record>::kPage, 0U);
  for (std::size_t k = 0; k < kMany; ++k) ASSERT_EQ(records[k].number, k);
  records.resize(10);
  records.shrink_to_fit();
  const RecordVector<Record> copy = records;
  for (std::size_t k = 0; k < 10; ++k) EXPECT_EQ(copy[k].number, k);
}

}  // namespace
}  // namespace repose::test
