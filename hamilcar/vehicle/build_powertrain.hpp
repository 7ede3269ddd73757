// From the description of the powertrain to its constants: the torsional stiffness of the shafts in each gear, reflected to
// the rotors.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/driveline/powertrain.hpp"
#include "hamilcar/math/convert.hpp"

namespace hamilcar {

namespace detail {

inline constexpr double unlimited_torque = 1e9;  // capacity of a clutch that never slips [N m]

// Inertia and torsional compliance reflected to an output, with the wheels off the ground.
struct ReflectedLoad {
    double inertia, compliance;  // [kg m^2], [rad/(N m)]
};

inline ReflectedLoad reflected_load(const VehicleDescription& d, const std::vector<double>& wheel_inertia,
                                    const DifferentialDescription& differential);

inline ReflectedLoad reflected_load(const VehicleDescription& d, const std::vector<double>& wheel_inertia,
                                    const DifferentialDescription::Output& output) {
    if (output.wheel) return {wheel_inertia[output.number], 0};
    return reflected_load(d, wheel_inertia, d.differentials[output.number]);
}

// With both outputs at the same speed inertias and stiffnesses add.
inline ReflectedLoad reflected_load(const VehicleDescription& d, const std::vector<double>& wheel_inertia,
                                    const DifferentialDescription& differential) {
    ReflectedLoad sum{0, 0};
    double stiffness = 0;
    for (const auto& output : differential.outputs) {
        const ReflectedLoad one = reflected_load(d, wheel_inertia, output);
        sum.inertia += one.inertia;
        stiffness += 1 / (1 / differential.shaft_stiffness + one.compliance);
    }
    const double squared = differential.ratio * differential.ratio;
    return {sum.inertia / squared, squared / stiffness};
}

inline double reduced(double a, double b) {
    return a * b / (a + b);
}

template <class T>
Differential<T> make_differential(const VehicleDescription& d, const std::vector<double>& wheel_inertia,
                                  const DifferentialDescription& one, std::vector<int>& driven) {
    const ReflectedLoad a = reflected_load(d, wheel_inertia, one.outputs[0]),
                        b = reflected_load(d, wheel_inertia, one.outputs[1]);
    const double compliance = 2 / one.shaft_stiffness + a.compliance + b.compliance;
    const double damping = 2 * one.damping_ratio * std::sqrt(reduced(a.inertia, b.inertia) / compliance);
    const double preload = one.kind == DifferentialKind::locked ? unlimited_torque : one.preload;
    Differential<T> out{.ratio = T(one.ratio),
                        .share = T(one.share),
                        .preload = T(preload),
                        .locking_drive = T(one.locking_drive),
                        .locking_coast = T(one.locking_coast),
                        .viscosity = T(one.viscosity),
                        .stiffness = T(1 / compliance),
                        .damping = T(damping),
                        .compliance = T(compliance)};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto& output = one.outputs[i];
        if (!output.wheel) {
            out.outputs[i] = -1 - static_cast<int>(output.number);
            continue;
        }
        out.outputs[i] = static_cast<int>(driven.size());
        driven.push_back(static_cast<int>(output.number));
    }
    return out;
}

template <class T>
Gears<T> make_gears(const PowerUnitDescription& unit, const ReflectedLoad& behind) {
    Gears<T> gears;
    std::vector<double> ratios{-unit.gearbox.reverse_ratio, 0};
    ratios.insert(ratios.end(), unit.gearbox.ratios.begin(), unit.gearbox.ratios.end());
    for (const double ratio : ratios) {
        const double squared = ratio * ratio;
        const double stiffness = 1 / (1 / unit.stiffness + squared * behind.compliance);
        const double inertia = squared > 0 ? reduced(unit.inertia, behind.inertia / squared) : unit.inertia;
        gears.ratio.push_back(T(ratio));
        gears.stiffness.push_back(T(stiffness));
        gears.damping.push_back(T(2 * unit.damping_ratio * std::sqrt(stiffness * inertia)));
        gears.viscosity.push_back(T(squared > 0 ? Gears<T>::loss_rate * behind.inertia / squared : 0));
        gears.connected.push_back(T(ratio != 0 ? 1 : 0));
    }
    return gears;
}

template <class T>
Converter<T> make_converter(const ConverterDescription& d) {
    return {Curve<T>(d.speed_ratio, d.torque_ratio), Curve<T>(d.speed_ratio, d.capacity), T(1), T(0)};
}

template <class T>
PowerUnit<T> make_unit(const VehicleDescription& d, const std::vector<double>& wheel_inertia,
                       const PowerUnitDescription& unit) {
    const ReflectedLoad behind = reflected_load(d, wheel_inertia, d.differentials[unit.output]);
    PowerUnit<T> out{.source = std::visit([](const auto& source) { return make_source<T>(source); }, unit.source),
                     .inertia = T(unit.inertia),
                     .inverse_inertia = T(1 / unit.inertia),
                     .axis = as<T>(vec3(unit.axis).normalized()),
                     .response_rate = T(unit.response_time > 0 ? 1 / unit.response_time : 0),
                     .capacity = T(0),
                     .converter = make_converter<T>({{0, 1}, {1, 1}, {0, 0}}),
                     .gears = make_gears<T>(unit, behind),
                     .loss_share = T(1 - unit.gearbox.efficiency),
                     .output = static_cast<int>(unit.output),
                     .command = -1};
    out.converter.present = T(0);
    if (const auto* clutch = std::get_if<ClutchDescription>(&unit.coupling)) {
        out.capacity = T(clutch->capacity > 0 ? clutch->capacity : unlimited_torque);
    } else {
        const auto& converter = std::get<ConverterDescription>(unit.coupling);
        out.converter = make_converter<T>(converter);
        out.capacity = T(converter.lockup_capacity);
        constexpr double min_speed = 1.5;  // of the turbine for lockup, times the idle speed
        if (const auto* engine = std::get_if<EngineDescription>(&unit.source)) {
            out.converter.lockup_min_speed = T(min_speed * engine->idle_speed);
        }
    }
    return out;
}

}  // namespace detail

// `wheel_inertia`: about the spin axis, of all wheels [kg m^2].
template <class T>
Powertrain<T> make_powertrain(const VehicleDescription& d) {
    std::vector<double> wheel_inertia;
    for_each_wheel(d, [&](const auto& wheel, std::size_t) { wheel_inertia.push_back(wheel.wheel.spin_inertia); });
    Powertrain<T> out;
    if (d.power_units.empty()) return out;
    for (const DifferentialDescription& differential : d.differentials) {
        out.differentials.push_back(detail::make_differential<T>(d, wheel_inertia, differential, out.wheels));
    }
    for (const PowerUnitDescription& unit : d.power_units) {
        out.units.push_back(detail::make_unit<T>(d, wheel_inertia, unit));
    }
    return out;
}

// Subtracts a rotor's spin inertia: J - I e e^T.
template <class T>
void subtract_rotor(const Vec3<T>& e, const T& I, Symmetric3<T>& J) {
    J.xx -= I * e[0] * e[0], J.yy -= I * e[1] * e[1], J.zz -= I * e[2] * e[2];
    J.xy -= I * e[0] * e[1], J.yz -= I * e[1] * e[2], J.xz -= I * e[0] * e[2];
}

}  // namespace hamilcar
