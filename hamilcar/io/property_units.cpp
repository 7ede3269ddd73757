#include "hamilcar/io/property_units.hpp"

#include <fmt/format.h>

#include "hamilcar/base/text.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/io/spelling.hpp"

namespace hamilcar::io {

namespace {

using units::Quantity;
using units::Unit;

// The unit that `[UNITS]` gives for this quantity. Null if it gives none.
const Unit* unit_of(const PropertyFile& file, std::string_view key, Quantity quantity) {
    const PropertyEntry* entry = file.find("UNITS", key);
    if (!entry || entry->text.empty()) return nullptr;
    if (const Unit* unit = units::find(quantity, entry->text)) return unit;
    std::vector<std::string_view> names;
    for (const Unit& unit : units::of(quantity)) names.push_back(unit.name());
    fail_in_property_file(
        file.path, entry->line,
        fmt::format("{} in [UNITS] is {}: expected {}", key, quoted_text(entry->text), quoted_list(names)));
}

}  // namespace

PropertyUnits units_of(const PropertyFile& file) {
    PropertyUnits units;
    const auto take = [&](std::string_view key, Quantity quantity, double& to_si) {
        if (const Unit* unit = unit_of(file, key, quantity)) {
            to_si = unit->to_si;
        } else {
            units.absent.push_back(key);
        }
    };
    take("LENGTH", Quantity::length, units.length);
    take("FORCE", Quantity::force, units.force);
    take("ANGLE", Quantity::angle, units.angle);
    take("MASS", Quantity::mass, units.mass);
    take("TIME", Quantity::time, units.time);
    if (const Unit* unit = unit_of(file, "PRESSURE", Quantity::pressure)) units.pressure = unit->to_si;
    if (const Unit* unit = unit_of(file, "TEMPERATURE", Quantity::temperature)) {
        units.temperature = unit->to_si;
        units.temperature_offset = unit->offset;
    }
    return units;
}

}  // namespace hamilcar::io
