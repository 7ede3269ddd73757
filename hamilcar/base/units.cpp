// A line per unit, grouped by quantity, the SI unit first, with every spelling met in the files of Adams, MF-Tyre and their kin.
#include "hamilcar/base/units.hpp"

#include <algorithm>
#include <array>

#include "hamilcar/base/text.hpp"

namespace hamilcar::units {

namespace {

using enum Quantity;

constexpr double pound = 0.45359237, inch = 0.0254, foot = 0.3048;                // [kg], [m], [m], exact by definition
constexpr double kilogram_force = 9.80665, pound_force = pound * kilogram_force;  // [N], likewise
constexpr double psi = pound_force / (inch * inch);                               // [Pa]

constexpr std::array table{
    Unit{length, "m", "meter m meters metre metres"},
    Unit{length, "mm", "mm millimeter millimeters millimetre millimetres", 1e-3},
    Unit{length, "cm", "cm centimeter centimeters centimetre centimetres", 1e-2},
    Unit{length, "km", "km kilometer kilometers kilometre kilometres", 1e3},
    Unit{length, "in", "inch in inches", inch},
    Unit{length, "ft", "foot ft feet", foot},
    Unit{length, "yd", "yard yd yards", 3 * foot},
    Unit{length, "mi", "mile mi miles", 5280 * foot},
    Unit{force, "N", "newton n newtons"},
    Unit{force, "kN", "kN knewton kilonewton kilonewtons", 1e3},
    Unit{force, "dyn", "dyne dyn dynes", 1e-5},
    Unit{force, "lbf", "pound_force lbf lb pound pounds", pound_force},
    Unit{force, "klbf", "kpound_force kip klbf", 1e3 * pound_force},
    Unit{force, "ozf", "ounce_force ozf", pound_force / 16},
    Unit{force, "kgf", "kg_force kgf kilogram_force kp", kilogram_force},
    Unit{angle, "rad", "radian rad radians"},
    Unit{angle, "deg", "degree deg degrees", degree},
    Unit{mass, "kg", "kg kilogram kilograms"},
    Unit{mass, "g", "gram g grams", 1e-3},
    Unit{mass, "t", "tonne t tonnes metric_ton", 1e3},
    Unit{mass, "lb", "pound_mass lbm lb pound pounds", pound},
    Unit{mass, "klb", "kpound_mass klbm", 1e3 * pound},
    Unit{mass, "slug", "slug slugs", pound_force / foot},  // a pound-force gives it 1 ft/s^2
    Unit{mass, "oz", "ounce_mass ozm", pound / 16},
    Unit{time, "s", "second s sec seconds"},
    Unit{time, "ms", "millisecond ms milli msec milliseconds", 1e-3},
    Unit{time, "min", "minute min minutes", 60},
    Unit{time, "h", "hour h hr hours", 3600},
    Unit{pressure, "Pa", "pascal pa pascals"},
    Unit{pressure, "kPa", "kPa kpascal kilopascal", 1e3},
    Unit{pressure, "MPa", "MPa mpascal megapascal", 1e6},
    Unit{pressure, "bar", "bar bars", 1e5},
    Unit{pressure, "psi", "psi", psi},
    Unit{pressure, "ksi", "ksi", 1e3 * psi},
    Unit{pressure, "atm", "atm atmosphere", 101325},
    Unit{temperature, "K", "kelvin k"},
    Unit{temperature, "", "celsius c degc deg_c", 1, 273.15},
    Unit{temperature, "", "fahrenheit f degf deg_f", 5.0 / 9, 459.67 * 5 / 9},
    Unit{temperature, "", "rankine r", 5.0 / 9},
    Unit{power, "W", "watt w watts"},
    Unit{power, "kW", "kW kilowatt kilowatts", 1e3},
};

}  // namespace

std::span<const Unit> of(Quantity quantity) {
    const auto* first = std::ranges::lower_bound(table, quantity, {}, &Unit::quantity);
    const auto* last = std::ranges::upper_bound(table, quantity, {}, &Unit::quantity);
    return {first, last};
}

const Unit* find(Quantity quantity, std::string_view spelling) {
    for (const Unit& unit : of(quantity)) {
        for (std::string_view rest = unit.spellings; !rest.empty();) {
            const std::string_view known = rest.substr(0, rest.find(' '));
            if (same_word(known, spelling)) return &unit;
            rest.remove_prefix(std::min(known.size() + 1, rest.size()));
        }
    }
    return nullptr;
}

std::optional<Product> product(std::string_view symbols) {
    if (symbols.empty() || symbols == "1" || symbols == "-") return Product{};
    if (symbols == "%") return Product{"", percent};
    if (symbols == "Nm") return Product{"N m", 1};
    Product out;
    bool divided = false;
    while (!symbols.empty()) {
        const std::size_t end = std::min(symbols.find_first_of(" /"), symbols.size());
        const auto* unit = std::ranges::find(table, symbols.substr(0, end), &Unit::symbol);
        if (unit == table.end() || unit->symbol.empty()) return std::nullopt;
        const auto si = of(unit->quantity).front().symbol;
        out.to_si = divided ? out.to_si / unit->to_si : out.to_si * unit->to_si;
        out.si.append(out.si.empty() || out.si.ends_with('/') ? "" : " ").append(si);
        const bool slash = end < symbols.size() && symbols[end] == '/';
        if (slash && divided) return std::nullopt;
        if (slash) divided = true, out.si += '/';
        symbols.remove_prefix(std::min(end + 1, symbols.size()));
    }
    return out;
}

}  // namespace hamilcar::units
