#include "engine/base/input_error.hpp"

#include <gtest/gtest.h>

namespace repose {
namespace {

TEST(Fault, IsOneLineOfFilePointerValueAndRule) {
  EXPECT_EQ((Fault{"cases/a.json", "/particles/density_kg_m3", "-1", "must be > 0"}.text()),
            "cases/a.json: /particles/density_kg_m3 = -1: must be > 0");
}

TEST(Fault, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ((Fault{"a.json", "/schema", "", "is missing"}.text()), "a.json: /schema: is missing");
  EXPECT_EQ((Fault{"a.json", "", "", "cannot be opened"}.text()), "a.json: cannot be opened");
  EXPECT_EQ((Fault{"a.json", "", "[1]", "must be an object"}.text()), "a.json: [1]: must be an object");
}

TEST(InputError, HoldsALineForEveryFault) {
  const InputError error({{"a.json", "/x", "1", "must be > 1"}, {"b.csv", "line 2", "", "is short"}});
  EXPECT_STREQ(error.what(), "a.json: /x = 1: must be > 1\nb.csv: line 2: is short");
  EXPECT_EQ(error.faults().size(), 2U);
}

TEST(Faults, ThrowOnlyWhereThereAreAny) {
  Faults faults;
  EXPECT_TRUE(faults.empty());
  EXPECT_NO_THROW(faults.throw_if_any());
  faults.add("a.json", "/x", "", "is missing");
  faults.add(InputError({{"c.json", "/y", "", "is missing"}, {"c.json", "/z", "", "is missing"}}));
  ASSERT_EQ(faults.list().size(), 3U);
  EXPECT_EQ(faults.list()[2].pointer, "/z");
  EXPECT_THROW(faults.throw_if_any(), InputError);
}

}  // namespace
}  // namespace repose
