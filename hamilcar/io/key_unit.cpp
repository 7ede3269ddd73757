// Reads a key from its end as long as the words are units: "N_m_s_per_rad" is N m s/rad, "per_s" is 1/s, "m2" is m^2.
#include "hamilcar/io/key_unit.hpp"

#include <array>

#include "hamilcar/base/units.hpp"

namespace hamilcar::io {

namespace {

struct UnitWord {
    std::string_view word, symbol;
    double to_si = 1;
};

constexpr std::array unit_words{
    UnitWord{"m", "m"},
    UnitWord{"m2", "m^2"},
    UnitWord{"m3", "m^3"},
    UnitWord{"kg", "kg"},
    UnitWord{"s", "s"},
    UnitWord{"s2", "s^2"},
    UnitWord{"N", "N"},
    UnitWord{"Pa", "Pa"},
    UnitWord{"W", "W"},
    UnitWord{"rad", "rad"},
    UnitWord{"per", "/"},
    UnitWord{"revolution", "revolution"},
    UnitWord{"percent", "%", units::percent},
    UnitWord{"deg", "deg", units::degree},
    UnitWord{"rpm", "rpm", units::rpm},
};

const UnitWord* find_unit_word(std::string_view word) {
    for (const UnitWord& known : unit_words) {
        if (known.word == word) return &known;
    }
    return nullptr;
}

}  // namespace

KeyUnit unit_of_key(std::string_view key) {
    KeyUnit unit{.stem = key, .symbol = {}};
    // The first word is always a name, so the search ends before it.
    for (auto bar = key.rfind('_'); bar != std::string_view::npos && bar > 0; bar = unit.stem.rfind('_')) {
        const UnitWord* known = find_unit_word(unit.stem.substr(bar + 1));
        if (!known) break;
        const bool spaced = known->symbol != "/" && !unit.symbol.empty() && unit.symbol.front() != '/';
        unit.symbol = std::string(known->symbol) + (spaced ? " " : "") + unit.symbol;
        unit.to_si *= known->to_si;
        unit.stem = unit.stem.substr(0, bar);
    }
    if (unit.symbol.starts_with('/')) unit.symbol.insert(0, "1");
    return unit;
}

std::string with_unit(const std::string& text, std::string_view key) {
    const std::string symbol = unit_of_key(key).symbol;
    return symbol.empty() ? text : text + " [" + symbol + "]";
}

}  // namespace hamilcar::io
