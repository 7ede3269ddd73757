// The constants of a car: a hub (the chassis) and its spokes, each a suspension with what hangs on it. Built once from a
// description, never changed by a step.
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "hamilcar/driveline/powertrain.hpp"
#include "hamilcar/force/aerodynamics.hpp"
#include "hamilcar/force/hull.hpp"
#include "hamilcar/suspension/list.hpp"
#include "hamilcar/tire/list.hpp"
#include "hamilcar/vehicle/composed.hpp"
#include "hamilcar/vehicle/layout.hpp"
#include "hamilcar/vehicle/row.hpp"

namespace hamilcar {

template <class T>
struct Spoke {
    Suspension<T> suspension;
    RigidBody<T> carrier;
    Wheel<T> wheel;
    Spring<T> spring;
    Damper<T> damper;
    Stop<T> bump, rebound;
    Tire<T> tire;
    Brake<T> brake;
    T drive_share;                 // of the drive torque [1]
    T inverse_design_determinant;  // 1 / det Phi_w at design, the measure of the linkage's mobility
    static constexpr auto members() {
        using S = Spoke;
        return std::tuple(&S::suspension, &S::carrier, &S::wheel, &S::spring, &S::damper, &S::bump, &S::rebound,
                          &S::tire, &S::brake, &S::drive_share, &S::inverse_design_determinant);
    }
};

template <class T>
struct AntiRollBar {
    int left, right;  // spokes, or wheels of composed ones
    T rate;           // [N/m] of wheel travel difference
    static constexpr auto members() { return std::tuple(&AntiRollBar::left, &AntiRollBar::right, &AntiRollBar::rate); }
};

template <class T>
struct Vehicle {
    RigidBody<T> chassis;
    SpatialInertia<T> chassis_inertia;  // about the vehicle origin
    std::vector<Spoke<T>> spokes;
    std::vector<AntiRollBar<T>> anti_roll_bars;
    std::vector<ComposedSpoke<T>> composed;
    std::vector<AntiRollBar<T>> composed_bars;
    std::vector<Trailer<T>> trailers;
    Aerodynamics<T> aerodynamics;
    Hull<T> hull;
    Powertrain<T> powertrain;
    T gravity;     // [m/s^2]
    T total_mass;  // of everything [kg]
    int state_size;
    static constexpr auto members() {
        using V = Vehicle;
        return std::tuple(&V::chassis, &V::chassis_inertia, &V::spokes, &V::anti_roll_bars, &V::composed,
                          &V::composed_bars, &V::trailers, &V::aerodynamics, &V::hull, &V::powertrain, &V::gravity,
                          &V::total_mass, &V::state_size, &V::places);
    }
    std::vector<int> places;  // of the spokes in rows of two
    // The same spokes abreast, and pairs of composed ones, where T has a number for that.
    std::vector<Row<Spoke<Abreast<T>>>> rows;
    std::vector<ComposedPair<Abreast<T>>> pairs;

    Vehicle() = default;
    explicit Vehicle(const VehicleDescription& description);
    bool has_composed() const { return !composed.empty() || !trailers.empty(); }
    int spoke_count() const { return static_cast<int>(spokes.size()); }

    void add_composed(const VehicleDescription& description);
    void add_powertrain(const VehicleDescription& description);

    // Calls f(row, its number) for the spokes one by one (S = T) or abreast (S = Abreast<T>).
    template <class S, class F>
    void for_each_row(F&& f) const {
        if constexpr (std::is_same_v<S, T>) {
            for (int i = 0; i < spoke_count(); ++i) {
                const auto place = static_cast<std::size_t>(i);
                f(Row<const Spoke<T>&>{spokes[place], {i, i}, 1, places[place]}, i);
            }
        } else {
            for (std::size_t i = 0; i < rows.size(); ++i) {
                f(Row<const Spoke<S>&>{rows[i].spokes, rows[i].index, rows[i].count, 0}, static_cast<int>(i));
            }
        }
    }
    // Calls alone(number) for each composed spoke, or abreast(pair, its number) for two.
    template <class Alone, class Two>
    void for_each_composed(const Alone& alone, const Two& abreast) const {
        std::size_t next_pair = 0;
        for (std::size_t s = 0; s < composed.size(); ++s) {
            if constexpr (!std::is_same_v<Abreast<T>, T>) {
                if (next_pair < pairs.size() && pairs[next_pair].first == static_cast<int>(s)) {
                    abreast(pairs[next_pair], next_pair);
                    ++next_pair, ++s;
                    continue;
                }
            }
            alone(s);
        }
    }
};

// Where a wheel of composed suspensions is, by its number among them: suspension and place there.
template <class T>
std::array<std::size_t, 2> composed_wheel(const Vehicle<T>& vehicle, int number) {
    std::size_t s = 0;
    while (s + 1 < vehicle.composed.size() && vehicle.composed[s + 1].first_wheel <= number) ++s;
    return {s, static_cast<std::size_t>(number - vehicle.composed[s].first_wheel)};
}

}  // namespace hamilcar

#include "hamilcar/vehicle/build.hpp"
