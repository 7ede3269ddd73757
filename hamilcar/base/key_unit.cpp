// Reads a key from its end as long as the words are units: "N_m_s_per_rad" is N m s/rad, "per_s" is 1/s, "m2" is m^2. Until "per" is
// met, the words are those of the denominator.
#include "hamilcar/base/key_unit.hpp"

#include <array>

#include "hamilcar/base/units.hpp"

namespace hamilcar {

namespace {

struct UnitWord {
    std::string_view word, symbol;
    double to_si = 1;
};

constexpr std::array unit_words{
    UnitWord{"m", "m"},
    UnitWord{"mm", "mm", 1e-3},
    UnitWord{"m2", "m^2"},
    UnitWord{"m3", "m^3"},
    UnitWord{"cm3", "cm^3", 1e-6},
    UnitWord{"kg", "kg"},
    UnitWord{"s", "s"},
    UnitWord{"s2", "s^2"},
    UnitWord{"N", "N"},
    UnitWord{"Pa", "Pa"},
    UnitWord{"bar", "bar", 1e5},
    UnitWord{"J", "J"},
    UnitWord{"K", "K"},
    UnitWord{"degC", "degC"},  // a temperature on that scale stays on it
    UnitWord{"W", "W"},
    UnitWord{"hz", "Hz"},
    UnitWord{"V", "V"},
    UnitWord{"Ah", "A h", 3600},
    UnitWord{"ohm", "ohm"},
    UnitWord{"rad", "rad"},
    UnitWord{"per", "/"},
    UnitWord{"revolution", "revolution"},
    UnitWord{"percent", "%", units::percent},
    UnitWord{"deg", "deg", units::degree},
    UnitWord{"rpm", "rpm", units::rpm},
};

constexpr std::string_view a_bar_of_steel = "anti_roll_bar";  // a table, which has no unit

const UnitWord* find_unit_word(std::string_view word) {
    for (const UnitWord& known : unit_words) {
        if (known.word == word) return &known;
    }
    return nullptr;
}

}  // namespace

KeyUnit unit_of_key(std::string_view key) {
    KeyUnit unit{.stem = key, .symbol = {}};
    if (key == a_bar_of_steel) return unit;
    // The first word is always a name, so the search ends before it.
    for (auto bar = key.rfind('_'); bar != std::string_view::npos && bar > 0; bar = unit.stem.rfind('_')) {
        const UnitWord* known = find_unit_word(unit.stem.substr(bar + 1));
        if (!known) break;
        if (known->symbol == "/") {
            const bool several = unit.symbol.find(' ') != std::string::npos;
            unit.symbol = several ? "/(" + unit.symbol + ")" : "/" + unit.symbol;
            unit.to_si = 1 / unit.to_si;
        } else {
            const bool spaced = !unit.symbol.empty() && unit.symbol.front() != '/';
            unit.symbol = std::string(known->symbol) + (spaced ? " " : "") + unit.symbol;
            unit.to_si *= known->to_si;
        }
        unit.stem = unit.stem.substr(0, bar);
    }
    if (unit.symbol.starts_with('/')) unit.symbol.insert(0, "1");
    return unit;
}

std::string with_unit(const std::string& text, std::string_view key) {
    const std::string symbol = unit_of_key(key).symbol;
    return symbol.empty() ? text : text + " [" + symbol + "]";
}

}  // namespace hamilcar
