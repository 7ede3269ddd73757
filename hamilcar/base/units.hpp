// Units of what people and other programs write, as factors to SI, never from SI: a number times its unit is SI, a number
// in SI over the unit is what a person reads.
#pragma once

#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hamilcar::units {

inline constexpr double degree = std::numbers::pi / 180;  // [rad]
inline constexpr double rpm = std::numbers::pi / 30;      // [rad/s]
inline constexpr double kilometer_per_hour = 1 / 3.6;     // [m/s]
inline constexpr double percent = 0.01;                   // [1]

enum class Quantity { length, force, angle, mass, time, pressure, temperature, power };

struct Unit {
    Quantity quantity;
    std::string_view symbol;     // as in headings: "km"
    std::string_view spellings;  // between blanks, as in property files; the first is the one a message shows
    double to_si = 1, offset = 0;

    std::string_view name() const { return spellings.substr(0, spellings.find(' ')); }
};

// All units of a quantity.
std::span<const Unit> of(Quantity quantity);
// By any of its spellings, upper or lower case alike; null if it is none of the quantity's.
const Unit* find(Quantity quantity, std::string_view spelling);

// A product of units: "N m", "km/h", "deg/s", "%".
struct Product {
    std::string si;  // "N m", "m/s"; empty where dimensionless
    double to_si = 1;
};
std::optional<Product> product(std::string_view symbols);

}  // namespace hamilcar::units
