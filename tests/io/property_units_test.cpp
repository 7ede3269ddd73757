// The units of a property file become factors to SI.
#include "hamilcar/io/property_units.hpp"

#include <numbers>

#include "tests/io/files.hpp"

namespace hamilcar::io {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

PropertyUnits units_in(const std::string& lines) {
    return units_of(parse_property_file("[UNITS]\n" + lines, "a.tir"));
}

TEST(PropertyUnits, OfAnSiFileAreOne) {
    const PropertyUnits units =
        units_in("LENGTH = 'meter'\nFORCE = 'newton'\nANGLE = 'radians'\nMASS = 'kg'\nTIME = 'second'\n");
    for (const double factor : {units.length, units.force, units.angle, units.mass, units.time, units.pressure}) {
        EXPECT_EQ(factor, 1.0);
    }
    EXPECT_THAT(units.absent, IsEmpty());
}

TEST(PropertyUnits, ThatAreAbsentAreSiAndSaid) {
    const PropertyUnits units = units_in("length = MM\nTIME = 'sec'\nFORCE =\n");
    EXPECT_EQ(units.length, 1e-3);
    EXPECT_EQ(units.force, 1.0);
    EXPECT_THAT(units.absent, ElementsAre("FORCE", "ANGLE", "MASS"));
    const PropertyFile without = parse_property_file("[MODEL]\nFITTYP = 61\n", "a.tir");
    EXPECT_THAT(units_of(without).absent, ElementsAre("LENGTH", "FORCE", "ANGLE", "MASS", "TIME"));
}

TEST(PropertyUnits, AreNotTheMassOfAnotherSection) {
    const PropertyFile file = parse_property_file("[INERTIA]\nMASS = 9.3\n[UNITS]\nMASS = 'gram'\n", "a.tir");
    EXPECT_EQ(units_of(file).mass, 1e-3);
    const PropertyFile without = parse_property_file("[VEHICLE]\nMASS = 9.3\n", "a.tir");
    EXPECT_EQ(units_of(without).mass, 1.0);
}

TEST(PropertyUnits, AreKnownInAllTheirSpellings) {
    for (const char* name : {"meter", "Meters", "m", "METRE"}) {
        EXPECT_EQ(units_in(std::string("LENGTH = ") + name).length, 1.0) << name;
    }
    const auto expect_length = [](const char* name, double factor) {
        EXPECT_DOUBLE_EQ(units_in(std::string("LENGTH = ") + name).length, factor) << name;
    };
    expect_length("millimeter", 1e-3);
    expect_length("cm", 1e-2);
    expect_length("km", 1e3);
    expect_length("IN", 0.0254);
    expect_length("foot", 0.3048);
    expect_length("yard", 0.9144);
    expect_length("mile", 1609.344);
    const auto expect_force = [](const char* name, double factor) {
        EXPECT_DOUBLE_EQ(units_in(std::string("FORCE = ") + name).force, factor) << name;
    };
    expect_force("N", 1);
    expect_force("kN", 1e3);
    expect_force("knewton", 1e3);
    expect_force("dyne", 1e-5);
    expect_force("lbf", 4.4482216152605);
    expect_force("pound_force", 4.4482216152605);
    expect_force("kpound_force", 4448.2216152605);
    expect_force("ounce_force", 0.27801385095378125);
    expect_force("kg_force", 9.80665);
    const auto expect_mass = [](const char* name, double factor) {
        EXPECT_NEAR(units_in(std::string("MASS = ") + name).mass, factor, 1e-9 * factor) << name;
    };
    expect_mass("gram", 1e-3);
    expect_mass("tonne", 1e3);
    expect_mass("pound_mass", 0.45359237);
    expect_mass("kpound_mass", 453.59237);
    expect_mass("slug", 14.593902937);  // 0.45359237 * 9.80665 / 0.3048
    expect_mass("ounce_mass", 0.028349523125);
    EXPECT_DOUBLE_EQ(units_in("ANGLE = 'deg'").angle, std::numbers::pi / 180);
    EXPECT_DOUBLE_EQ(units_in("ANGLE = 'degree'").angle, std::numbers::pi / 180);
    EXPECT_EQ(units_in("ANGLE = 'rad'").angle, 1.0);
    EXPECT_EQ(units_in("TIME = 's'").time, 1.0);
    EXPECT_EQ(units_in("TIME = 'millisecond'").time, 1e-3);
    EXPECT_EQ(units_in("TIME = 'milli'").time, 1e-3);
    EXPECT_EQ(units_in("TIME = 'min'").time, 60.0);
    EXPECT_EQ(units_in("TIME = 'hour'").time, 3600.0);
}

TEST(PropertyUnits, OfPressureAndTemperature) {
    EXPECT_EQ(units_in("PRESSURE = 'kPa'").pressure, 1e3);
    EXPECT_EQ(units_in("PRESSURE = 'bar'").pressure, 1e5);
    EXPECT_NEAR(units_in("PRESSURE = 'psi'").pressure, 6894.757293, 1e-6);
    const PropertyUnits celsius = units_in("TEMPERATURE = 'celsius'");
    EXPECT_DOUBLE_EQ(20 * celsius.temperature + celsius.temperature_offset, 293.15);
    const PropertyUnits fahrenheit = units_in("TEMPERATURE = 'fahrenheit'");
    EXPECT_NEAR(212 * fahrenheit.temperature + fahrenheit.temperature_offset, 373.15, 1e-10);  // water boils
}

// Millimeters, newtons, degrees, kilograms, seconds: the usual Adams file.
TEST(PropertyUnits, GiveDerivedFactors) {
    const PropertyUnits units = units_in("LENGTH = mm\nFORCE = newton\nANGLE = degree\nMASS = kg\nTIME = millisecond");
    EXPECT_DOUBLE_EQ(units.velocity(), 1);                                  // 1 mm/ms = 1 m/s
    EXPECT_DOUBLE_EQ(units.stiffness(), 1000);                              // 1 N/mm
    EXPECT_DOUBLE_EQ(units.damping(), 1);                                   // 1 N ms/mm
    EXPECT_DOUBLE_EQ(units.moment(), 1e-3);                                 // 1 N mm
    EXPECT_DOUBLE_EQ(units.inertia(), 1e-6);                                // 1 kg mm^2
    EXPECT_NEAR(units.cornering_stiffness(), 57.29577951308232, 1e-12);     // 1 N/deg
    EXPECT_NEAR(units.rotational_stiffness(), 0.05729577951308232, 1e-15);  // 1 N mm/deg
    EXPECT_NEAR(units.rotational_damping(), 5.729577951308232e-5, 1e-18);   // 1 N mm ms/deg
}

TEST(PropertyUnits, ThatAreUnknownAreAMistakeWithItsLine) {
    const auto expect_mistake = [](const std::string& lines, const std::vector<std::string>& pieces) {
        expect_error([&] { units_in(lines); }, ExitCode::bad_file, pieces);
    };
    expect_mistake(
        "\nLENGTH = 'furlong'\n",
        {"a.tir:3: LENGTH in [UNITS] is 'furlong': expected 'meter', 'mm', 'cm', 'km', 'inch', 'foot', 'yard' "
         "or 'mile'"});
    expect_mistake("ANGLE = 1\n", {"a.tir:2: ANGLE in [UNITS] is '1': expected 'radian' or 'degree'"});
}

}  // namespace
}  // namespace hamilcar::io
