// One table per quantity, a line per unit with every spelling met in the files of Adams, MF-Tyre and their kin. Case
// does not count, as in those programs.
#include "hamilcar/io/property_units.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <span>
#include <string>

#include <fmt/format.h>

#include "hamilcar/io/spelling.hpp"

namespace hamilcar::io {

namespace {

struct Unit {
    std::string_view spellings;  // between blanks; the first is the one a message shows
    double to_si = 1, offset = 0;
};

constexpr double pound = 0.45359237, inch = 0.0254, foot = 0.3048;                // [kg], [m], [m], exact by definition
constexpr double kilogram_force = 9.80665, pound_force = pound * kilogram_force;  // [N], likewise
constexpr double psi = pound_force / (inch * inch);                               // [Pa]

constexpr std::array length_units{
    Unit{"meter m meters metre metres"},
    Unit{"mm millimeter millimeters millimetre millimetres", 1e-3},
    Unit{"cm centimeter centimeters centimetre centimetres", 1e-2},
    Unit{"km kilometer kilometers kilometre kilometres", 1e3},
    Unit{"inch in inches", inch},
    Unit{"foot ft feet", foot},
    Unit{"yard yd yards", 3 * foot},
    Unit{"mile mi miles", 5280 * foot},
};
constexpr std::array force_units{
    Unit{"newton n newtons"},
    Unit{"kN knewton kilonewton kilonewtons", 1e3},
    Unit{"dyne dyn dynes", 1e-5},
    Unit{"pound_force lbf lb pound pounds", pound_force},
    Unit{"kpound_force kip klbf", 1e3 * pound_force},
    Unit{"ounce_force ozf", pound_force / 16},
    Unit{"kg_force kgf kilogram_force kp", kilogram_force},
};
constexpr std::array angle_units{
    Unit{"radian rad radians"},
    Unit{"degree deg degrees", std::numbers::pi / 180},
};
constexpr std::array mass_units{
    Unit{"kg kilogram kilograms"},          Unit{"gram g grams", 1e-3},
    Unit{"tonne t tonnes metric_ton", 1e3}, Unit{"pound_mass lbm lb pound pounds", pound},
    Unit{"kpound_mass klbm", 1e3 * pound},  Unit{"slug slugs", pound_force / foot},  // a pound-force gives it 1 ft/s^2
    Unit{"ounce_mass ozm", pound / 16},
};
constexpr std::array time_units{
    Unit{"second s sec seconds"},
    Unit{"millisecond ms milli msec milliseconds", 1e-3},
    Unit{"minute min minutes", 60},
    Unit{"hour h hr hours", 3600},
};
constexpr std::array pressure_units{
    Unit{"pascal pa pascals"},
    Unit{"kPa kpascal kilopascal", 1e3},
    Unit{"MPa mpascal megapascal", 1e6},
    Unit{"bar bars", 1e5},
    Unit{"psi", psi},
    Unit{"ksi", 1e3 * psi},
    Unit{"atm atmosphere", 101325},
};
constexpr std::array temperature_units{
    Unit{"kelvin k"},
    Unit{"celsius c degc deg_c", 1, 273.15},
    Unit{"fahrenheit f degf deg_f", 5.0 / 9, 459.67 * 5 / 9},
    Unit{"rankine r", 5.0 / 9},
};

bool same_word(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (lower(a[i]) != lower(b[i])) return false;
    }
    return true;
}

bool is_called(const Unit& unit, std::string_view name) {
    for (std::string_view rest = unit.spellings; !rest.empty();) {
        const std::string_view spelling = rest.substr(0, rest.find(' '));
        if (same_word(spelling, name)) return true;
        rest.remove_prefix(std::min(spelling.size() + 1, rest.size()));
    }
    return false;
}

// The unit that `[UNITS]` gives for this quantity. Null if it gives none.
const Unit* unit_of(const PropertyFile& file, std::string_view quantity, std::span<const Unit> known) {
    const PropertyEntry* entry = file.find("UNITS", quantity);
    if (!entry) return nullptr;
    std::vector<std::string_view> names;
    for (const Unit& unit : known) {
        if (is_called(unit, entry->text)) return &unit;
        names.push_back(unit.spellings.substr(0, unit.spellings.find(' ')));
    }
    const std::string written = entry->text.empty() ? "nothing" : shown_in_message(entry->text);
    fail_in_property_file(file.path, entry->line,
                          fmt::format("{} in [UNITS] is {}: expected {}", quantity, written, quoted_list(names)));
}

}  // namespace

PropertyUnits units_of(const PropertyFile& file) {
    PropertyUnits units;
    const auto take = [&](std::string_view quantity, std::span<const Unit> known, double& to_si) {
        if (const Unit* unit = unit_of(file, quantity, known)) {
            to_si = unit->to_si;
        } else {
            units.absent.push_back(quantity);
        }
    };
    take("LENGTH", length_units, units.length);
    take("FORCE", force_units, units.force);
    take("ANGLE", angle_units, units.angle);
    take("MASS", mass_units, units.mass);
    take("TIME", time_units, units.time);
    if (const Unit* unit = unit_of(file, "PRESSURE", pressure_units)) units.pressure = unit->to_si;
    if (const Unit* unit = unit_of(file, "TEMPERATURE", temperature_units)) {
        units.temperature = unit->to_si;
        units.temperature_offset = unit->offset;
    }
    return units;
}

}  // namespace hamilcar::io
