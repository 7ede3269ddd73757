// The unit of a number is part of its key ("mass_kg", "damping_N_s_per_m"), so the key alone tells the symbol to print
// and the factor to SI. No table of keys and units exists that could disagree with the files.
#pragma once

#include <string>
#include <string_view>

namespace hamilcar {

struct KeyUnit {
    std::string_view stem;  // the key without its unit: "damping"
    std::string symbol;     // "N s/m"; empty where dimensionless
    double to_si = 1;       // factor from the written number: pi / 180 for degrees
};

KeyUnit unit_of_key(std::string_view key);

// The text followed by the unit of that key in brackets, if it has one.
std::string with_unit(const std::string& text, std::string_view key);

}  // namespace hamilcar
