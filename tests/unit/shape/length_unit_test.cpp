#include "engine/shape/length_unit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace repose {
namespace {

using ::testing::HasSubstr;

/// Metres of the unit that a header names; 0 where it names none, −1 where it is a fault.
double unit_of(const std::string& header) {
  Faults faults;
  const auto unit = named_unit(header, "a.stl", faults);
  return !faults.empty() ? -1.0 : unit ? unit->metres : 0.0;
}

std::string fault_of(const std::string& header) {
  Faults faults;
  named_unit(header, "a.stl", faults);
  return faults.empty() ? "" : faults.list().front().text();
}

TEST(LengthUnit, IsKnownByItsUsualWords) {
  for (const char* word : {"mm", "millimeter", "millimeters", "millimetre", "millimetres"})
    EXPECT_EQ(length_unit(word)->metres, 1e-3) << word;
  for (const char* word : {"cm", "centimeters", "centimetre"})
    EXPECT_EQ(length_unit(word)->metres, 1e-2) << word;
  for (const char* word : {"m", "meter", "metres"}) EXPECT_EQ(length_unit(word)->metres, 1.0) << word;
  for (const char* word : {"um", "\xC2\xB5m", "\xCE\xBCm", "\xB5m", "micron", "microns", "micrometers"})
    EXPECT_EQ(length_unit(word)->metres, 1e-6) << word;
  for (const char* word : {"in", "inch", "inches"}) EXPECT_EQ(length_unit(word)->metres, 0.0254) << word;
  for (const char* word : {"", "mmm", "parsec", "ft", "1"}) EXPECT_FALSE(length_unit(word)) << word;
}

TEST(LengthUnit, IsFoundHoweverItIsWritten) {
  for (const char* header :
       {"solid x units=mm", "units=MM", "unit = mm", "unit:mm", "# File units = millimeters", "units=\"mm\"",
        "unit: 'millimetres'.", "stone, units=mm, scanned", "file_units=mm", "[units = mm]",
        "two units; units=mm"})
    EXPECT_EQ(unit_of(header), 1e-3) << header;
  EXPECT_EQ(unit_of(std::string("units=micron\0\0\0", 15)), 1e-6);
}

TEST(LengthUnit, IsNotFoundInOtherWords) {
  for (const char* header :
       {"", "united=mm", "in units of mm", "5 units", "unitsmm", "subunit=x", "munits=5"})
    EXPECT_EQ(unit_of(header), 0.0) << header;
}

TEST(LengthUnit, ThatIsNotKnownIsAFault) {
  EXPECT_THAT(fault_of("units=furlongs"),
              HasSubstr("a.stl: header = unit 'furlongs': is no unit that is known: m, cm, mm, um, in"));
  EXPECT_EQ(unit_of("units="), -1.0);
  EXPECT_EQ(unit_of("unit: 0.001"), -1.0);
  EXPECT_THAT(fault_of("units=mm\n# units=cm"), HasSubstr("units mm and cm: must name one unit"));
}

}  // namespace
}  // namespace repose
