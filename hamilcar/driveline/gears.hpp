// What depends on the gear: ratios with the torsion that is seen through them, and the shafts behind a gearbox with an inertia.
#pragma once

#include <tuple>
#include <vector>

#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

// Of values by gear, from reverse (gear -1) on: 0 is reverse, 1 neutral, 2 first. Interpolated between two gears.
template <class T>
T at_gear(const std::vector<T>& values, const T& gear) {
    const T position = clamp(T(gear + T(1)), T(0), T(static_cast<double>(values.size() - 1)));
    T out = values[0];
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
        out += (values[i + 1] - values[i]) * clamp(T(position - T(static_cast<double>(i))), T(0), T(1));
    }
    return out;
}

template <class T>
struct Gears {
    static constexpr double loss_rate = 100;  // maximum rate at which friction stops the parts behind the gearbox [1/s]
    std::vector<T> ratio, stiffness, damping;
    std::vector<T> viscosity;  // of the friction near zero input speed [N m s/rad]
    std::vector<T> connected;  // 1; 0 in neutral and for gears that do not exist
    static constexpr auto members() {
        return std::tuple(&Gears::ratio, &Gears::stiffness, &Gears::damping, &Gears::viscosity, &Gears::connected);
    }

    struct Engaged {
        T ratio, stiffness, damping;
        T viscosity, connected;
    };
    Engaged at(const T& gear) const {
        return {at_gear(ratio, gear), at_gear(stiffness, gear), at_gear(damping, gear), at_gear(viscosity, gear),
                at_gear(connected, gear)};
    }
};

// The shafts behind a gearbox whose input has an inertia of its own: a spring with play between the gearbox and what it drives, both
// seen from the gearbox's input.
template <class T>
struct Shafts {
    static constexpr double return_rate = 100;  // of the wind-up in neutral [1/s]
    int present = 0;
    T inertia{0}, inverse_inertia{0};   // of the gearbox, at its input [kg m^2]
    std::vector<T> stiffness, damping;  // by gear
    std::vector<T> half_play;           // by gear [rad]
    static constexpr auto members() {
        using S = Shafts;
        return std::tuple(&S::present, &S::inertia, &S::inverse_inertia, &S::stiffness, &S::damping, &S::half_play);
    }

    bool exist() const { return present != 0; }

    struct Output {
        T torque, windup_rate;
    };
    // `slip`: speed of the gearbox's input over what the shafts drive, as seen from there. Teeth and joints push but do not pull: within
    // the play there is no torque, and damping never turns its sign.
    Output evaluate(const T& gear, const T& connected, const T& slip, const T& windup) const {
        const T play = at_gear(half_play, gear);
        const T twist = windup - clamp(windup, T(-play), play);
        const T rate = connected * slip - (T(1) - connected) * T(return_rate) * windup;
        const T spring = at_gear(stiffness, gear) * twist, both = spring + at_gear(damping, gear) * rate;
        const T pushed = select(twist > T(0), max(both, T(0)), select(twist < T(0), min(both, T(0)), T(0)));
        return {connected * select(play > T(0), pushed, both), rate};
    }
};

}  // namespace hamilcar
