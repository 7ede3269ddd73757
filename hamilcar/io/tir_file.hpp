// A tire property file (`.tir`) of the Magic Formula: MF-Tyre 5.0 to 6.2 and the Adams dialects PAC2002 and MF_05
// (docs/files/tire.md). Nothing in it is passed over in silence: what is unknown, unused or filled in is listed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamilcar/description/tire.hpp"
#include "hamilcar/io/property_file.hpp"

namespace hamilcar::io {

struct TirFile {
    MagicFormulaDescription tire;  // its remarks: "file:line: key 'ABC' in [SECTION] is not known and not used"
    std::string format;            // "MF-Tyre 6.1 (FITTYP 61)"
};

// What a vehicle's file says otherwise, in SI: a set is often used on another size.
struct TirOverrides {
    std::optional<double> radius, rolling_radius;                // [m]
    std::optional<double> vertical_stiffness, vertical_damping;  // [N/m, N s/m]; linear, without the file's growth
    std::optional<double> pressure;                              // [Pa]
};

// Whether a tire can roll so: the effective radius lies between half the unloaded one and twice it. Where a vehicle's file
// overrides either, who reads that file asks, so that its key is named.
inline bool possible_rolling_radius(const CasingDescription& casing) {
    return casing.rolling_radius > 0.5 * casing.radius && casing.rolling_radius < 2 * casing.radius;
}

// Throws Error: input_output if it cannot be read, bad_file for what a tire cannot do without.
TirFile read_tir(const std::string& path, const TirOverrides& overrides = {});
TirFile tir_from(const PropertyFile& file, const TirOverrides& overrides = {});

}  // namespace hamilcar::io
