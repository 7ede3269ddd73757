// A quantity over time as a person writes it down.
#pragma once

#include <vector>

namespace hamilcar {

enum class Interpolation { smooth, linear };  // monotone cubic (continuous rate) or straight lines

// An input over time; constant before the first and after the last point. Times strictly increase.
struct SignalDescription {
    std::vector<double> time;   // [s]
    std::vector<double> value;  // unit of the input
    Interpolation interpolation = Interpolation::smooth;
};

}  // namespace hamilcar
