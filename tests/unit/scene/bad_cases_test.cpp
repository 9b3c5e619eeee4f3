#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "unit/scene/good_case.hpp"

namespace repose::test {
namespace {

struct BadCase {
  const char* name;
  const char* patch;  ///< JSON Merge Patch on the good case
  std::vector<std::string> messages;
};

void PrintTo(const BadCase& bad, std::ostream* stream) { *stream << bad.name; }

const BadCase kBadCases[] = {
    // The document as a whole
    {"SchemaMissing", R"({"schema": null})", {"case.json: /schema: is missing"}},
    {"SchemaOfAnotherVersion", R"({"schema": 2})", {"case.json: /schema = 2: must be 1"}},
    {"SchemaAsText", R"({"schema": "1"})", {"case.json: /schema = \"1\": must be a whole number"}},
    {"TitleNotText", R"({"title": 5})", {"case.json: /title = 5: must be a text"}},
    {"UnknownSection",
     R"({"gravity": 9.81})",
     {"case.json: /gravity = 9.81: is not known; a case takes $schema, schema, title, base, particles, "
      "walls, "
      "contact, test, numerics, measure, sweep, chart"}},
    {"SectionMisspelt",
     R"({"numeric": {"time_step_fraction": 0.2}})",
     {"case.json: /numeric = {\"time_step_fraction\":0.2}: is not known; did you mean \"numerics\"?"}},
    {"SectionsMissing",
     R"({"particles": null, "walls": null, "contact": null, "test": null})",
     {"case.json: /particles: is missing", "case.json: /walls: is missing", "case.json: /contact: is missing",
      "case.json: /test: is missing"}},
    {"SectionNotAnObject", R"({"walls": [1]})", {"case.json: /walls = [1]: must be an object"}},

    // Materials
    {"DensityNegative",
     R"({"particles": {"density_kg_m3": -1}})",
     {"case.json: /particles/density_kg_m3 = -1: must be > 0"}},
    {"DensityZero",
     R"({"walls": {"density_kg_m3": 0}})",
     {"case.json: /walls/density_kg_m3 = 0: must be > 0"}},
    {"DensityMissing",
     R"({"particles": {"density_kg_m3": null}})",
     {"case.json: /particles/density_kg_m3: is missing"}},
    {"DensityAsText",
     R"({"particles": {"density_kg_m3": "heavy"}})",
     {"case.json: /particles/density_kg_m3 = \"heavy\": must be a number"}},
    {"DensityMisspelt",
     R"({"particles": {"density_kg_m3": null, "densty_kg_m3": 2500}})",
     {"case.json: /particles/densty_kg_m3 = 2500: is not known; did you mean \"density_kg_m3\"?",
      "case.json: /particles/density_kg_m3: is missing"}},
    {"UnitLeftOut",
     R"({"walls": {"shear_modulus_Pa": null, "shear_modulus": 2e7}})",
     {"case.json: /walls/shear_modulus = 20000000.0: is not known; did you mean \"shear_modulus_Pa\"?",
      "case.json: /walls/shear_modulus_Pa: is missing"}},
    {"ShearModulusZero",
     R"({"walls": {"shear_modulus_Pa": 0.0}})",
     {"case.json: /walls/shear_modulus_Pa = 0.0: must be > 0"}},
    {"PoissonRatioIncompressible",
     R"({"particles": {"poisson_ratio": 0.5}})",
     {"case.json: /particles/poisson_ratio = 0.5: must be >= 0 and < 0.5"}},
    {"PoissonRatioNegative",
     R"({"walls": {"poisson_ratio": -0.1}})",
     {"case.json: /walls/poisson_ratio = -0.1: must be >= 0 and < 0.5"}},

    // Shapes
    {"ShapesMissing", R"({"particles": {"shapes": null}})", {"case.json: /particles/shapes: is missing"}},
    {"ShapesEmpty",
     R"({"particles": {"shapes": []}})",
     {"case.json: /particles/shapes = []: must be a list of at least 1 entry"}},
    {"ShapesNotAList",
     R"({"particles": {"shapes": {"sphere": true}}})",
     {"case.json: /particles/shapes = {\"sphere\":true}: must be a list of at least 1 entry"}},
    {"ShapeNotAnObject",
     R"({"particles": {"shapes": ["sphere"]}})",
     {"case.json: /particles/shapes/0 = \"sphere\": must be an object"}},
    {"ShapeWithoutAKind",
     R"({"particles": {"shapes": [{}]}})",
     {"case.json: /particles/shapes/0 = {}: must give one of sphere, clump or mesh"}},
    {"ShapeOfTwoKinds",
     R"({"particles": {"shapes": [{"sphere": true, "clump": "a.json"}]}})",
     {"case.json: /particles/shapes/0 = {\"sphere\":true,\"clump\":\"a.json\"}: must give one of sphere, "
      "clump or "
      "mesh"}},
    {"SphereNotTrue",
     R"({"particles": {"shapes": [{"sphere": 7.5}]}})",
     {"case.json: /particles/shapes/0/sphere = 7.5: must be true"}},
    {"ShapeOfUnknownKey",
     R"({"particles": {"shapes": [{"sphere": true, "radius_mm": 3}]}})",
     {"case.json: /particles/shapes/0/radius_mm = 3: is not known; /particles/shapes/* takes sphere, "
      "diameter_mm, "
      "clump, mesh, spheres, unit"}},
    {"UnitOfASphere",
     R"({"particles": {"shapes": [{"sphere": true, "unit": "mm"}]}})",
     {"case.json: /particles/shapes/0/unit = \"mm\": goes with mesh only"}},
    {"UnitThatIsNone",
     R"({"particles": {"shapes": [{"mesh": "README.md", "spheres": 8, "unit": "furlong"}]}})",
     {"case.json: /particles/shapes/0/unit = \"furlong\": must be m, cm, mm, um or in"}},
    {"SphereWithoutASize",
     R"({"particles": {"size_classes": null}})",
     {"case.json: /particles/shapes/0/diameter_mm: is missing: a sphere needs it where there are no "
      "size_classes"}},
    {"SphereSizedTwice",
     R"({"particles": {"shapes": [{"sphere": true, "diameter_mm": 8}]}})",
     {"case.json: /particles/shapes/0/diameter_mm = 8: excludes size_classes, which give the sizes: remove "
      "one of "
      "the two"}},
    {"SphereOfNegativeDiameter",
     R"({"particles": {"size_classes": null, "shapes": [{"sphere": true, "diameter_mm": -8}]}})",
     {"case.json: /particles/shapes/0/diameter_mm = -8: must be > 0"}},
    {"ClumpFileMissing",
     R"({"particles": {"shapes": [{"sphere": true}, {"clump": "no/such.json"}]}})",
     {"case.json: /particles/shapes/1/clump = \"no/such.json\": cannot be opened: no/such.json"}},
    {"ClumpFileNotText",
     R"({"particles": {"shapes": [{"clump": 13}]}})",
     {"case.json: /particles/shapes/0/clump = 13: must be a text"}},
    {"ClumpWithADiameter",
     R"({"particles": {"shapes": [{"clump": "cases/shapes/particle_13.json", "diameter_mm": 8}]}})",
     {"case.json: /particles/shapes/0/diameter_mm = 8: goes with sphere only"}},
    {"ClumpWithANumberOfSpheres",
     R"({"particles": {"shapes": [{"clump": "cases/shapes/particle_13.json", "spheres": 8}]}})",
     {"case.json: /particles/shapes/0/spheres = 8: goes with mesh only"}},
    {"MeshFileMissing",
     R"({"particles": {"shapes": [{"mesh": "no/such.stl", "spheres": 8}]}})",
     {"case.json: /particles/shapes/0/mesh = \"no/such.stl\": cannot be opened: no/such.stl"}},
    {"MeshWithoutANumberOfSpheres",
     R"({"particles": {"shapes": [{"mesh": "README.md"}]}})",
     {"case.json: /particles/shapes/0/spheres: is missing: a mesh needs it"}},
    {"MeshWithNoSpheres",
     R"({"particles": {"shapes": [{"mesh": "README.md", "spheres": 0}]}})",
     {"case.json: /particles/shapes/0/spheres = 0: must be between 1 and 300"}},
    {"MeshWithHalfASphere",
     R"({"particles": {"shapes": [{"mesh": "README.md", "spheres": 8.5}]}})",
     {"case.json: /particles/shapes/0/spheres = 8.5: must be a whole number"}},

    // Size classes
    {"ClassesEmpty",
     R"({"particles": {"size_classes": []}})",
     {"case.json: /particles/size_classes = []: must be a list of at least 1 entry"}},
    {"ClassWithoutASize",
     R"({"particles": {"size_classes": [{"percent": 100}]}})",
     {"case.json: /particles/size_classes/0 = {\"percent\":100}: must give either volume_mm3 or "
      "diameter_mm"}},
    {"ClassOfTwoSizes",
     R"({"particles": {"size_classes": [{"volume_mm3": [1, 2], "diameter_mm": 3, "percent": 100}]}})",
     {"case.json: /particles/size_classes/0 = {\"volume_mm3\":[1,2],\"diameter_mm\":3,\"percent\":100}: must "
      "give "
      "either volume_mm3 or diameter_mm"}},
    {"ClassWithoutAShare",
     R"({"particles": {"size_classes": [{"volume_mm3": [100, 200]}]}})",
     {"case.json: /particles/size_classes/0 = {\"volume_mm3\":[100,200]}: must give either percent or "
      "mass_percent"}},
    {"ClassOfVolumeByMass",
     R"({"particles": {"size_classes": [{"volume_mm3": [100, 200], "mass_percent": 100}]}})",
     {"case.json: /particles/size_classes/0/mass_percent = 100: goes with diameter_mm only; the share of a "
      "range of "
      "volumes is percent"}},
    {"ClassesOfVolumeAndDiameter",
     R"({"particles": {"size_classes": [{"volume_mm3": [1, 2], "percent": 50},
                                        {"diameter_mm": 3, "percent": 50}]}})",
     {"case.json: /particles/size_classes = "
      "[{\"volume_mm3\":[1,2],\"percent\":50},{\"diameter_mm\":3,\"percent…: volume_mm3 and diameter_mm "
      "cannot be "
      "mixed"}},
    {"SharesByNumberAndByMass",
     R"({"particles": {"size_classes": [{"diameter_mm": 3, "percent": 50},
                                        {"diameter_mm": 4, "mass_percent": 50}]}})",
     {"case.json: /particles/size_classes = "
      "[{\"diameter_mm\":3,\"percent\":50},{\"diameter_mm\":4,\"mass_perce…: percent and mass_percent cannot "
      "be "
      "mixed"}},
    {"ClassUpsideDown",
     R"({"particles": {"size_classes": [{"volume_mm3": [200, 100], "percent": 100}]}})",
     {"case.json: /particles/size_classes/0/volume_mm3 = [200,100]: the smaller volume must come first"}},
    {"ClassOfThreeVolumes",
     R"({"particles": {"size_classes": [{"volume_mm3": [100, 200, 300], "percent": 100}]}})",
     {"case.json: /particles/size_classes/0/volume_mm3 = [100,200,300]: must be a list of 2 entries"}},
    {"ClassOfZeroVolume",
     R"({"particles": {"size_classes": [{"volume_mm3": [0, 200], "percent": 100}]}})",
     {"case.json: /particles/size_classes/0/volume_mm3/0 = 0: must be > 0"}},
    {"ShareAboveTheWhole",
     R"({"particles": {"size_classes": [{"volume_mm3": [100, 200], "percent": 101}]}})",
     {"case.json: /particles/size_classes/0/percent = 101: must be between 0 and 100"}},
    {"SharesTooSmall",
     R"({"particles": {"size_classes": [{"volume_mm3": [1, 2], "percent": 60},
                                        {"volume_mm3": [2, 3], "percent": 39.89}]}})",
     {"case.json: /particles/size_classes = "
      "[{\"volume_mm3\":[1,2],\"percent\":60},{\"volume_mm3\":[2,3],\"perc…: the percentages must sum to 100 "
      "within "
      "0.1, not to 99.89"}},
    {"SharesTooLarge",
     R"({"particles": {"size_classes": [{"diameter_mm": 7, "mass_percent": 60},
                                        {"diameter_mm": 8, "mass_percent": 41}]}})",
     {"case.json: /particles/size_classes = "
      "[{\"diameter_mm\":7,\"mass_percent\":60},{\"diameter_mm\":8,\"mass_…: the percentages must sum to 100 "
      "within "
      "0.1, not to 101"}},
    {"DiameterOfAClump",
     R"({"particles": {"shapes": [{"clump": "cases/shapes/particle_13.json"}],
                       "size_classes": [{"diameter_mm": 7, "percent": 100}]}})",
     {"case.json: /particles/size_classes/0/diameter_mm = 7: sizes spheres only: give volume_mm3 for other "
      "shapes"}},

    // Mass
    {"MassNegative",
     R"({"particles": {"total_mass_kg": -3}})",
     {"case.json: /particles/total_mass_kg = -3: must be > 0"}},
    {"MassBelowOneParticle",
     R"({"particles": {"size_classes": null, "shapes": [{"sphere": true, "diameter_mm": 10}],
                       "total_mass_kg": 0.001}})",
     {"case.json: /particles/total_mass_kg = 0.001: must be at least the mass of one particle, 0.00131 kg"}},
    {"MassInAnotherUnit",
     R"({"particles": {"size_classes": null, "shapes": [{"sphere": true, "diameter_mm": 1}],
                       "total_mass_kg": 1500}})",
     {"case.json: /particles/total_mass_kg = 1500: makes 1.15e+09 particles of 1.31e-06 kg; at most 1e+07 "
      "can be "
      "simulated"}},

    // Contact
    {"RestitutionAboveOne",
     R"({"contact": {"particle_particle": {"restitution": 1.2}}})",
     {"case.json: /contact/particle_particle/restitution = 1.2: must be between 0 and 1"}},
    {"RestitutionNegative",
     R"({"contact": {"particle_wall": {"restitution": -0.1}}})",
     {"case.json: /contact/particle_wall/restitution = -0.1: must be between 0 and 1"}},
    {"FrictionNegative",
     R"({"contact": {"particle_particle": {"static_friction": -0.5, "rolling_friction": -0.1}}})",
     {"case.json: /contact/particle_particle/static_friction = -0.5: must be >= 0",
      "case.json: /contact/particle_particle/rolling_friction = -0.1: must be >= 0"}},
    {"FrictionMissing",
     R"({"contact": {"particle_wall": {"static_friction": null}}})",
     {"case.json: /contact/particle_wall/static_friction: is missing"}},
    {"FrictionABoolean",
     R"({"contact": {"particle_wall": {"static_friction": true}}})",
     {"case.json: /contact/particle_wall/static_friction = true: must be a number"}},
    {"WallContactMissing",
     R"({"contact": {"particle_wall": null}})",
     {"case.json: /contact/particle_wall: is missing"}},
    {"RollingModelMisspelt",
     R"({"contact": {"rolling_model": "type_A_relativ"}})",
     {"case.json: /contact/rolling_model = \"type_A_relativ\": must be one of \"type_a\", "
      "\"type_a_relative\", "
      "\"type_c\", \"type_c_undamped\"; did you mean \"type_a_relative\"?"}},
    {"RollingModelUnknown",
     R"({"contact": {"rolling_model": "epsd2"}})",
     {"case.json: /contact/rolling_model = \"epsd2\": must be one of \"type_a\", \"type_a_relative\", "
      "\"type_c\", "
      "\"type_c_undamped\""}},
    {"HistoryUnknown",
     R"({"contact": {"tangential_history": "off"}})",
     {"case.json: /contact/tangential_history = \"off\": must be one of \"force\", \"displacement\""}},
    {"DampingNotText",
     R"({"contact": {"normal_damping": 1}})",
     {"case.json: /contact/normal_damping = 1: must be one of \"with_tail\", \"clamped\""}},
    {"RollingDampingNegative",
     R"({"contact": {"rolling_damping_ratio": -0.3}})",
     {"case.json: /contact/rolling_damping_ratio = -0.3: must be >= 0"}},
    {"RollingTorqueUnknown",
     R"({"contact": {"rolling_torque": "none"}})",
     {"case.json: /contact/rolling_torque = \"none\": must be one of \"limited\", \"unlimited\""}},
    {"SpheresTooSmallForSinglePrecision",
     R"({"numerics": {"arithmetic": "mixed"},
         "particles": {"size_classes": [{"volume_mm3": [0.003, 200], "percent": 100}]}})",
     {"case.json: /numerics/arithmetic = \"mixed\": needs spheres of 0.1 mm radius at least; "
      "the smallest has 0.0895 mm"}},
    {"IntegratorUnknown",
     R"({"numerics": {"integrator": "euler"}})",
     {"case.json: /numerics/integrator = \"euler\": must be one of \"symplectic_euler\", "
      "\"velocity_verlet\", \"explicit_euler\""}},

    // Test
    {"ParticlesWithoutMass",
     R"({"particles": {"density_kg_m3": 1e-320}})",
     {"case.json: /particles/density_kg_m3 = 1e-320: makes particles of 0 kg"}},
    {"KindMissing", R"({"test": {"kind": null}})", {"case.json: /test/kind: is missing"}},
    {"KindUnknown",
     R"({"test": {"kind": "rotating_drum"}})",
     {"case.json: /test/kind = \"rotating_drum\": must be one of \"split_cylinder\", \"lifted_cylinder\""}},
    {"CylinderMissing", R"({"test": {"cylinder": null}})", {"case.json: /test/cylinder: is missing"}},
    {"CylinderHeightMissing",
     R"({"test": {"cylinder": {"height_mm": null}}})",
     {"case.json: /test/cylinder/height_mm: is missing"}},
    {"CylinderWiderThanTheBase",
     R"({"test": {"cylinder": {"diameter_mm": 200}}})",
     {"case.json: /test/cylinder/diameter_mm = 200: must stand on the base, whose diameter_mm is 195"}},
    {"CylinderNarrowerThanAParticle",
     R"({"test": {"cylinder": {"diameter_mm": 9}}})",
     {"case.json: /test/cylinder/diameter_mm = 9: must hold the largest particle, which spans 9.14 mm"}},
    {"CylinderOfTwoParticles",
     R"({"test": {"cylinder": {"diameter_mm": 20}}})",
     {"case.json: /test/cylinder/diameter_mm = 20: must be at least 3 times the largest particle's diameter, "
      "9.14 "
      "mm"}},
    {"CylinderLowerThanAParticle",
     R"({"test": {"cylinder": {"height_mm": 5}}})",
     {"case.json: /test/cylinder/height_mm = 5: must hold the largest particle, which spans 9.14 mm"}},
    {"BaseOfZeroDiameter",
     R"({"test": {"base": {"diameter_mm": 0}}})",
     {"case.json: /test/base/diameter_mm = 0: must be > 0"}},
    {"BaseOfNegativeHeight",
     R"({"test": {"base": {"height_mm": -50}}})",
     {"case.json: /test/base/height_mm = -50: must be > 0"}},
    {"FillingUnknown",
     R"({"test": {"filling": "pakcing"}})",
     {"case.json: /test/filling = \"pakcing\": must be one of \"pour\", \"rain\", \"packing\"; did you mean "
      "\"packing\"?"}},
    {"OpeningUnknown",
     R"({"test": {"opening": "instantly"}})",
     {"case.json: /test/opening = \"instantly\": must be one of \"moved\", \"instant\"; did you mean "
      "\"instant\"?"}},
    {"CoarseGrainingBelowOne",
     R"({"particles": {"coarse_graining": 0.5}})",
     {"case.json: /particles/coarse_graining = 0.5: must be >= 1"}},
    {"CoarseGrainingBeyondTheCylinder",
     R"({"particles": {"coarse_graining": 5}})",
     {"case.json: /test/cylinder/diameter_mm = 100: must be at least 3 times the largest particle's "
      "diameter, "
      "45.7 mm"}},
    {"RestAngleChangeZero",
     R"({"numerics": {"rest_angle_change_deg": 0}})",
     {"case.json: /numerics/rest_angle_change_deg = 0: must be > 0"}},
    {"PourRateZero",
     R"({"test": {"pour_rate_kg_s": 0}})",
     {"case.json: /test/pour_rate_kg_s = 0: must be > 0"}},
    {"PourSpeedUpwards",
     R"({"test": {"pour_speed_m_s": -1}})",
     {"case.json: /test/pour_speed_m_s = -1: must be >= 0"}},
    {"OpeningSpeedNegative",
     R"({"test": {"opening_speed_m_s": -1}})",
     {"case.json: /test/opening_speed_m_s = -1: must be > 0"}},
    {"KeyOfAnotherSection",
     R"({"test": {"restitution": 0.5}})",
     {"case.json: /test/restitution = 0.5: is not known; /test takes kind, base, cylinder, filling, "
      "pour_rate_kg_s, pour_speed_m_s, opening, opening_speed_m_s, shared_columns"}},
    {"SharedColumnsWithoutNumber",
     R"({"test": {"shared_columns": {"static_friction": -1}}})",
     {"case.json: /test/shared_columns/static_friction = -1: must be >= 0",
      "case.json: /test/shared_columns/count: is missing"}},
    {"SharedColumnsBeyondTheirNumber",
     R"({"test": {"shared_columns": {"count": 101, "restitution": 1.5}}})",
     {"case.json: /test/shared_columns/count = 101: must be between 1 and 100",
      "case.json: /test/shared_columns/restitution = 1.5: must be between 0 and 1"}},

    // Numerics and measurement
    {"TimeStepZero",
     R"({"numerics": {"time_step_fraction": 0}})",
     {"case.json: /numerics/time_step_fraction = 0: must be > 0"}},
    {"TimeStepOfAWord",
     R"({"numerics": {"time_step_fraction": "automatic"}})",
     {"case.json: /numerics/time_step_fraction = \"automatic\": must be a number or \"auto\""}},
    {"TimeStepGivenTwice",
     R"({"numerics": {"time_step_s": 1e-5}})",
     {"case.json: /numerics/time_step_s = 1e-05: excludes /numerics/time_step_fraction: give one of the "
      "two"}},
    {"StiffnessScaleZero",
     R"({"numerics": {"stiffness_scale": 0}})",
     {"case.json: /numerics/stiffness_scale = 0: must be > 0"}},
    {"RestNeverReached",
     R"({"numerics": {"settle_energy_ratio": 0, "rest_energy_ratio": -1}})",
     {"case.json: /numerics/settle_energy_ratio = 0: must be > 0",
      "case.json: /numerics/rest_energy_ratio = -1: must be > 0"}},
    {"TimeLimitZero",
     R"({"numerics": {"stage_time_limit_s": 0}})",
     {"case.json: /numerics/stage_time_limit_s = 0: must be > 0"}},
    {"NumericsNotAnObject", R"({"numerics": 0.3})", {"case.json: /numerics = 0.3: must be an object"}},
    {"WindowUpsideDown",
     R"({"measure": {"window": [0.8, 0.2]}})",
     {"case.json: /measure/window = [0.8,0.2]: the lower end must be below the upper end"}},
    {"WindowEmpty",
     R"({"measure": {"window": [0.5, 0.5]}})",
     {"case.json: /measure/window = [0.5,0.5]: the lower end must be below the upper end"}},
    {"WindowBeyondTheHeap",
     R"({"measure": {"window": [0.2, 1.5]}})",
     {"case.json: /measure/window/1 = 1.5: must be between 0 and 1"}},
    {"WindowOfOneEnd",
     R"({"measure": {"window": [0.2]}})",
     {"case.json: /measure/window = [0.2]: must be a list of 2 entries"}},
};

class BadCases : public testing::TestWithParam<BadCase> {};

TEST_P(BadCases, AreNamedWithFilePointerValueAndRule) {
  EXPECT_EQ(faults_of(patched(GetParam().patch)), GetParam().messages);
}

INSTANTIATE_TEST_SUITE_P(SceneReader, BadCases, testing::ValuesIn(kBadCases),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(SceneReader, NamesEveryFaultOfACaseAtOnce) {
  const CaseDocument document = patched(R"({
    "schema": 3,
    "particles": {"density_kg_m3": -1, "poisson_ratio": 0.7, "total_mass_kg": null,
                  "shapes": [{"clump": "no/such.json"}, {"sphere": true, "radius_mm": 4}]},
    "walls": null,
    "contact": {"particle_particle": {"restitution": 2}, "rolling_model": 7},
    "test": {"cylinder": {"diameter_mm": 400}, "speed": 1},
    "measure": {"window": [0.9, 0.1]}
  })");
  std::vector<std::string> pointers;
  Faults faults;
  read_scene(document, faults);
  for (const Fault& fault : faults.list()) pointers.push_back(fault.pointer);
  std::ranges::sort(pointers);
  const std::vector<std::string> expected = {"/contact/particle_particle/restitution",
                                             "/contact/rolling_model",
                                             "/measure/window",
                                             "/particles/density_kg_m3",
                                             "/particles/poisson_ratio",
                                             "/particles/shapes/0/clump",
                                             "/particles/shapes/1/radius_mm",
                                             "/particles/total_mass_kg",
                                             "/schema",
                                             "/test/cylinder/diameter_mm",
                                             "/test/speed",
                                             "/walls"};
  EXPECT_EQ(pointers, expected);
}

TEST(SceneReader, ThrowsAllFaultsAsOneErrorWithALineEach) {
  const std::string message =
      message_of([] { read_scene(patched(R"({"schema": null, "walls": {"density_kg_m3": 0}})")); });
  EXPECT_EQ(message,
            "case.json: /walls/density_kg_m3 = 0: must be > 0\n"
            "case.json: /schema: is missing");
}

TEST(SceneReader, RefusesNumbersThatAreNotFinite) {
  for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    CaseDocument document = patched("{}");
    document.set("/particles/density_kg_m3", value, "factor");
    EXPECT_EQ(faults_of(document), std::vector<std::string>{"factor: /particles/density_kg_m3 = " +
                                                            std::string(std::isnan(value) ? "nan"
                                                                        : value > 0       ? "inf"
                                                                                          : "-inf") +
                                                            ": must be a finite number"});
  }
}

}  // namespace
}  // namespace repose::test
