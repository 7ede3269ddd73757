// A direction that somebody might take for a ratio: its length says nothing, so it has to be one.
#pragma once

#include <cmath>

#include "hamilcar/io/number_text.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

inline std::array<double, 3> unit_direction(const TableReader& table, std::string_view key,
                                            const std::array<double, 3>& otherwise) {
    const std::array<double, 3> direction = table.direction(key, otherwise);
    if (table.is_recording() || !table.has(key)) return direction;
    constexpr double off = 0.01;  // what typing with two digits leaves
    const std::array<double, 3> written = table.array<3>(key);
    const double length = std::hypot(written[0], written[1], written[2]);
    table.expect(
        std::abs(length - 1) <= off, key,
        "a unit vector, since it is a direction and no ratio (here its length is " + number_text(length) + ")");
    return direction;
}

}  // namespace hamilcar::io
