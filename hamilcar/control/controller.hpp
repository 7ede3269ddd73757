// What a controller is: at every decision it is shown measurements, and it changes commands.
//
//     sensors ─► Measured ─► decide ─► Commands ─► actuators          every 1 / rate seconds; commands are held in between
//
// A controller is constant: what it remembers are plain numbers, as many as it asks for, which snapshots, checkpoints and batches
// keep for it. It allocates nothing and throws nothing while it decides. A kind of controller is a `ControllerKind`
// (control/kinds.hpp), whether it comes with Hamilcar or from a user: a vehicle file names it all the same.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/vehicle/command_layout.hpp"

namespace hamilcar {

// What a controller may know of its car, determined once.
struct ControlledWheel {
    std::string name;
    int unit = 0;             // 0: the motor vehicle, else a trailer
    double x = 0, y = 0;      // of its center, from the center of mass of its unit's chassis: forward, to the left [m]
    double radius = 0;        // of rolling [m]
    double spin_inertia = 0;  // [kg m^2]
    bool steered = false;     // by the steering wheel
    bool driven = false;      // by a power unit
    double brake_torque = 0;  // at `full_pressure`; 0: no brake [N m]
    double damper_soft = 1, damper_firm = 1;  // shares of its damper's force, alike where it is not adjustable [1]
    double static_load = 0;                   // at rest on level ground [N]
};

struct ControlledBar {
    std::size_t left = 0, right = 0;  // wheels
    double max_force = 0;             // on each of them at a command of 1; 0: it is not active [N]
};

struct ControlledUnit {
    std::string name;
    std::vector<std::size_t> wheels;  // that it drives
    double ratio = 0;         // of the torque of all of them over that of a motor, in its only or its first gear [1]
    double motor_torque = 0;  // the largest of a motor; 0: an engine [N m]
};

// An axle whose rack an actuator moves.
struct ControlledSteer {
    std::string axle;
    double angle = 0;  // of its wheels at a command of 1, near straight ahead, to the left positive [rad]
    double x = 0;      // of the axle, from the center of mass of the chassis, forward [m]
};

struct ControlledCar {
    double mass = 0;              // of everything [kg]
    double yaw_inertia = 0;       // of the motor vehicle about its center of mass, estimated [kg m^2]
    double wheelbase = 1;         // [m]
    double center_behind = 0;     // of the chassis's center of mass behind the steered axle [m]
    double wheels_per_angle = 0;  // turn of the steered wheels per turn of the steering wheel; 0: no steering [1]
    double full_pressure = 0;     // of the brakes at full pedal; 0: no brake system [Pa]
    std::vector<ControlledWheel> wheels;  // in the vehicle's order
    std::vector<ControlledBar> bars;      // anti-roll bars
    std::vector<ControlledUnit> units;    // power units
    std::vector<ControlledSteer> steers;  // axles with an actuator for their rack
};

// As sensors show it; what the car lacks is zero.
struct Measured {
    double time = 0;                       // of the decision [s]
    double interval = 0;                   // since the controller's last decision [s]
    double steering_wheel = 0;             // angle, to the left positive [rad]
    double brake = 0, throttle = 0;        // pedals, 0 to 1
    double gear = 0;                       // -1 reverse, 0 neutral
    std::array<double, 3> angular_rate{};  // of the motor vehicle's chassis, its axes: roll, pitch, yaw [rad/s]
    // What an accelerometer at the center of mass of all that moves shows: contact and air forces over mass, chassis axes;
    // on level ground (0, 0, g) at rest [m/s^2].
    std::array<double, 3> acceleration{};
    double control_pressure = 0;             // of the master cylinder or the foot valve [Pa]
    std::span<const double> wheel_speed;     // of each against its carrier; rolling forward positive [rad/s]
    std::span<const double> brake_pressure;  // at each wheel [Pa]
    std::span<const double> travel;          // of each wheel's center against design, up positive [m]
    std::span<const double> travel_speed;    // likewise [m/s]
    std::span<const double> rotor_speed;     // of each power unit [rad/s]
};

// A wheel's valves.
struct BrakeValves {
    double &inlet, &outlet, &pump;

    void rest() const { inlet = 1, outlet = 0, pump = 0; }                       // pressure as the pedal says
    void hold() const { inlet = 0, outlet = 0, pump = 0; }                       // it stays
    void release() const { inlet = 0, outlet = 1, pump = 0; }                    // it falls
    void build(double share = 1) const { inlet = 0, outlet = 0, pump = share; }  // it rises by the pump
};

// Commands of one car, by what they are for. Every decision begins with those of the last one; the controllers of a car decide in
// the order of its file, so a later one sees what an earlier one wants.
class Commands {
public:
    Commands(const CommandLayout& layout, std::span<double> values) : layout_(&layout), values_(values) {}

    bool has_valves(std::size_t wheel) const { return layout_->brake(wheel) >= 0; }
    BrakeValves valves(std::size_t wheel) const {
        double* at = &values_[static_cast<std::size_t>(layout_->brake(wheel))];
        return {at[BrakeCommand::inlet], at[BrakeCommand::outlet], at[BrakeCommand::pump]};
    }
    // Limits of a power unit's throttle.
    double& max_throttle(std::size_t unit) const { return at(layout_->unit(unit) + UnitCommand::max_throttle); }
    double& min_throttle(std::size_t unit) const { return at(layout_->unit(unit) + UnitCommand::min_throttle); }
    // Of a motor: torque besides what the pedal asks for, -1 to 1 of its largest; how much the brake pedal may ask of it, 0 to 1.
    double& added_torque(std::size_t unit) const { return at(layout_->unit(unit) + UnitCommand::added_torque); }
    double& max_regeneration(std::size_t unit) const { return at(layout_->unit(unit) + UnitCommand::max_regeneration); }
    // Of an axle with an actuator for its rack, by its number in ControlledCar: -1 to 1 of the rack's travel.
    double& axle_steer(std::size_t steer) const { return at(layout_->axle_steer(steer)); }
    // Of a wheel's adjustable damper, 0 soft to 1 firm.
    bool has_damper(std::size_t wheel) const { return layout_->damper(wheel) >= 0; }
    double& damper(std::size_t wheel) const { return at(layout_->damper(wheel)); }
    // Of an active anti-roll bar, by its number in ControlledCar: -1 to 1, positive pushes the left wheel down.
    bool has_bar(std::size_t bar) const { return layout_->bar(bar) >= 0; }
    double& bar(std::size_t bar) const { return at(layout_->bar(bar)); }
    // Any, by its index in the layout.
    double& at(int index) const { return values_[static_cast<std::size_t>(index)]; }

private:
    const CommandLayout* layout_;
    std::span<double> values_;
};

class Controller {
public:
    Controller() = default;
    Controller(const Controller&) = delete;
    Controller& operator=(const Controller&) = delete;
    virtual ~Controller() = default;
    // How many numbers it remembers; they begin as zeros.
    virtual std::size_t memory_size() const = 0;
    virtual void decide(const Measured& measured, std::span<double> memory, const Commands& commands) const = 0;
    // Whether it intervenes, for a lamp and a line over time: 0 no, 1 fully.
    virtual double activity(std::span<const double> memory) const = 0;
};

// The settings of one controller, each by its key.
class ControllerSettings {
public:
    ControllerSettings(const struct ControllerKind& kind, const ControllerDescription& description);
    double operator[](std::string_view key) const;  // SI; the kind has such a key

private:
    std::vector<std::pair<std::string_view, double>> values_;
};

// A key of a vehicle file. Its unit is part of it, as everywhere in files: "threshold_deg" is an angle, and `fallback`, `min` and
// `max` are in degrees then; the controller gets radians.
struct ControllerKey {
    std::string_view key, meaning;
    double fallback, min, max;
};

struct ControllerKind {
    std::string_view keyword;  // "abs"
    std::string_view meaning;  // one phrase
    std::vector<ControllerKey> keys;
    // What the car lacks for it, as "expected ..." would go on; empty: nothing.
    std::string (*lacks)(const VehicleDescription& vehicle);
    std::unique_ptr<const Controller> (*make)(const ControllerSettings& settings, const ControlledCar& car);
};

}  // namespace hamilcar
