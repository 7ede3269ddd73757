// The one map of a state: what each of its numbers is and where it stands. A vehicle takes its offsets from here, and everything
// that speaks of the numbers takes their names.
//
//   chassis     position r, orientation, momentum, work
//   suspension  independent V, dependent W, momenta P_V, then wheel by wheel: spin momentum, brake wind-up, u and v of each tire
//   trailer     hitch angles, their momenta
//   powertrain  of each power unit the rotor's momentum, wind-up, throttle and the converter's torque, and where its gearbox has an
//               inertia the momentum of that and the wind-up of the shafts; the wind-up of each differential; of a battery
//               charge and voltage; the energy supplied
//   brakes      where there is a brake system: the control pressure of each unit; pressure and temperature of each brake
//   steering    where the rack moves on its own: rack and its momentum, steering wheel and its momentum, wind-up of the dry friction of
//               both, force of the assist
//   actuators   of adjustable dampers and active bars, where controllers command them: what each has come to
//   axle steer  of each axle that an actuator steers: where its rack stands, as a share of its travel, and how fast that changes
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hamilcar/description/vehicle.hpp"

namespace hamilcar {

enum class StateKind {
    position,
    orientation,
    momentum,
    angular_momentum,
    work,
    independent,
    dependent,
    suspension_momentum,
    spin_momentum,
    brake_windup,
    tire_deflection,
    hitch_angle,
    hitch_momentum,
    rotor_momentum,
    clutch_windup,
    throttle,
    converter_torque,
    gearbox_momentum,
    shafts_windup,
    differential_windup,
    battery_charge,
    battery_voltage,
    energy_supplied,
    control_pressure,
    brake_pressure,
    brake_temperature,
    rack_displacement,
    rack_momentum,
    steering_wheel_angle,
    steering_wheel_momentum,
    steering_windup,
    assist_force,
    actuator,
    axle_steer,
    axle_steer_rate,
};

// What holds for all numbers of a kind.
struct StateKindInfo {
    StateKind kind;
    const char* symbol;   // in the equations, "-" where they have none
    const char* unit;     // "rad, m": by the coordinate that it belongs to
    const char* block;    // that gives its rate
    const char* meaning;  // one phrase
};
// Whether its rate is a force or a moment.
bool is_momentum(StateKind kind);
// In the order of StateKind.
std::span<const StateKindInfo> state_kinds();

struct StateNumber {
    StateKind kind;
    std::string name;  // "front_left.spin_momentum"
};

class StateLayout {
public:
    explicit StateLayout(const VehicleDescription& description);

    // Where a suspension's numbers begin, how many they are, and where those of its wheels begin, counted from there.
    struct SuspensionPlaces {
        int offset, size;
        std::vector<int> wheels;
    };
    // Where the numbers of each power unit begin; those of the differentials, those of the battery, and the last.
    struct PowertrainPlaces {
        std::vector<int> units;
        int differentials, battery, supplied;
    };

    int size() const { return static_cast<int>(numbers_.size()); }
    const std::vector<StateNumber>& numbers() const { return numbers_; }
    const SuspensionPlaces& suspension(std::size_t i) const { return suspensions_[i]; }
    int trailer(std::size_t i) const { return trailers_[i]; }
    const PowertrainPlaces& powertrain() const { return powertrain_; }
    int steering() const { return steering_; }    // of the rack's displacement
    int actuators() const { return actuators_; }  // of the first one
    int axle_steer(std::size_t i) const { return axle_steers_ + 2 * static_cast<int>(i); }
    int brakes() const { return brakes_; }  // of the first control pressure

private:
    void add(StateKind kind, const std::string& name) { numbers_.push_back({kind, name}); }
    void add_chassis();
    void add_suspension(const SuspensionDescription& suspension);
    void add_wheel(const SuspensionWheelDescription& wheel);
    void add_trailer(const TrailerDescription& trailer);
    void add_powertrain(const VehicleDescription& description);
    void add_brakes(const VehicleDescription& description);
    void add_steering(const SteeringDescription& steering);
    void add_actuators(const VehicleDescription& description);

    std::vector<StateNumber> numbers_;
    std::vector<SuspensionPlaces> suspensions_;
    std::vector<int> trailers_;
    PowertrainPlaces powertrain_{};
    int brakes_ = 0, steering_ = 0, actuators_ = 0, axle_steers_ = 0;
};

}  // namespace hamilcar
