// A quantity over time as a person writes it down.
#pragma once

#include <vector>

namespace hamilcar {

// Monotone cubic (continuous rate), the same with a continuous acceleration too, straight lines, or each value until the next one.
enum class Interpolation { smooth, smoother, linear, steps };

// An input over time; constant before the first and after the last point. Times strictly increase.
struct SignalDescription {
    std::vector<double> time;   // [s]
    std::vector<double> value;  // unit of the input
    Interpolation interpolation = Interpolation::smooth;
};

}  // namespace hamilcar
