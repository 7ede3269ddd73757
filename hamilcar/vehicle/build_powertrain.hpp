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
                                    const DrivenPart& output) {
    if (output.wheel) return {wheel_inertia[output.number], 0};
    return reflected_load(d, wheel_inertia, d.differentials[output.number]);
}

// With both outputs at the same speed inertias and stiffnesses add.
inline ReflectedLoad reflected_load(const VehicleDescription& d, const std::vector<double>& wheel_inertia,
                                    const DifferentialDescription& differential) {
    ReflectedLoad sum{0, 0};
    double stiffness = 0;
    for (const DrivenPart& output : differential.outputs) {
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

// Of a driven wheel, which it adds to the list, or -1 - that of a differential.
inline int output_index(const DrivenPart& output, std::vector<int>& driven) {
    if (!output.wheel) return -1 - static_cast<int>(output.number);
    driven.push_back(static_cast<int>(output.number));
    return static_cast<int>(driven.size()) - 1;
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
    for (std::size_t i = 0; i < 2; ++i) out.outputs[i] = output_index(one.outputs[i], driven);
    out.shaft_axis = as<T>(vec3(one.shaft_axis).normalized());
    return out;
}

// From reverse on: reverse, neutral, first.
inline std::vector<double> signed_ratios(const GearboxDescription& gearbox) {
    std::vector<double> ratios{-gearbox.reverse_ratio, 0};
    ratios.insert(ratios.end(), gearbox.ratios.begin(), gearbox.ratios.end());
    return ratios;
}

// The spring at the clutch: all torsion up to the wheels, or with shafts of their own up to the gearbox alone.
template <class T>
Gears<T> make_gears(const PowerUnitDescription& unit, const ReflectedLoad& behind) {
    Gears<T> gears;
    const ShaftsDescription& shafts = unit.shafts;
    for (const double ratio : signed_ratios(unit.gearbox)) {
        const double squared = ratio * ratio;
        const double stiffness =
            shafts.exists ? unit.stiffness : 1 / (1 / unit.stiffness + squared * behind.compliance);
        const double load = shafts.exists ? shafts.gearbox_inertia : squared > 0 ? behind.inertia / squared : 0;
        const double inertia = load > 0 ? reduced(unit.inertia, load) : unit.inertia;
        gears.ratio.push_back(T(ratio));
        gears.stiffness.push_back(T(stiffness));
        gears.damping.push_back(T(2 * unit.damping_ratio * std::sqrt(stiffness * inertia)));
        gears.viscosity.push_back(T(squared > 0 ? Gears<T>::loss_rate * load : 0));
        gears.connected.push_back(T(ratio != 0 ? 1 : 0));
    }
    return gears;
}

template <class T>
Shafts<T> make_shafts(const PowerUnitDescription& unit, const ReflectedLoad& behind) {
    Shafts<T> out;
    const ShaftsDescription& d = unit.shafts;
    if (!d.exists) return out;
    out.present = 1, out.inertia = T(d.gearbox_inertia), out.inverse_inertia = T(1 / d.gearbox_inertia);
    const double compliance = 1 / d.stiffness + behind.compliance;
    for (const double ratio : signed_ratios(unit.gearbox)) {
        const double squared = std::max(ratio * ratio, 1e-6);
        const double stiffness = 1 / (squared * compliance);
        const double inertia = reduced(d.gearbox_inertia, behind.inertia / squared);
        out.stiffness.push_back(T(ratio != 0 ? stiffness : 0));
        out.damping.push_back(T(ratio != 0 ? 2 * d.damping_ratio * std::sqrt(stiffness * inertia) : 0));
        out.half_play.push_back(T(std::abs(ratio) * d.backlash / 2));
    }
    return out;
}

template <class T>
Converter<T> make_converter(const ConverterDescription& d) {
    return {Curve<T>(d.speed_ratio, d.torque_ratio), Curve<T>(d.speed_ratio, d.capacity), T(1), T(0)};
}

template <class T>
PowerUnit<T> make_unit(const VehicleDescription& d, const std::vector<double>& wheel_inertia,
                       const PowerUnitDescription& unit, std::vector<int>& driven) {
    const ReflectedLoad behind = reflected_load(d, wheel_inertia, unit.output);
    PowerUnit<T> out{.source = std::visit([](const auto& source) { return make_source<T>(source); }, unit.source),
                     .inertia = T(unit.inertia),
                     .inverse_inertia = T(1 / unit.inertia),
                     .axis = as<T>(vec3(unit.axis).normalized()),
                     .response_rate = T(unit.response_time > 0 ? 1 / unit.response_time : 0),
                     .capacity = T(0),
                     .converter = make_converter<T>({{0, 1}, {1, 1}, {0, 0}}),
                     .gears = make_gears<T>(unit, behind),
                     .shafts = make_shafts<T>(unit, behind),
                     .loss_share = T(1 - unit.gearbox.efficiency),
                     .output = output_index(unit.output, driven),
                     .rotor_is_free = unit.in_wheel ? 0 : 1,
                     .command = -1,
                     .place = 0};
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

template <class T>
Battery<T> make_battery(const BatteryDescription& d) {
    Battery<T> out;
    if (!d.exists) return out;
    out.present = 1;
    out.inverse_capacity = T(1 / d.capacity), out.resistance = T(d.resistance);
    out.open_voltage = Curve<T>(d.charge, d.voltage);
    out.max_discharge = T(d.max_discharge), out.max_charge = T(d.max_charge);
    out.auxiliary_power = T(d.auxiliary_power), out.initial_charge = T(d.initial_charge);
    return out;
}

}  // namespace detail

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
        out.units.push_back(detail::make_unit<T>(d, wheel_inertia, unit, out.wheels));
        const auto* motor = std::get_if<MotorDescription>(&unit.source);
        if (motor && motor->brake_regeneration > 0) out.regenerates = 1;
        if (motor && !motor->torque.level.empty()) {
            out.supply_voltage = max(out.supply_voltage, T(motor->torque.level.back()));
        }
    }
    out.battery = detail::make_battery<T>(d.battery);
    return out;
}

// Subtracts a rotor's spin inertia: J - I e e^T.
template <class T>
void subtract_rotor(const Vec3<T>& e, const T& I, Symmetric3<T>& J) {
    J.xx -= I * e[0] * e[0], J.yy -= I * e[1] * e[1], J.zz -= I * e[2] * e[2];
    J.xy -= I * e[0] * e[1], J.yz -= I * e[1] * e[2], J.xz -= I * e[0] * e[2];
}

}  // namespace hamilcar
