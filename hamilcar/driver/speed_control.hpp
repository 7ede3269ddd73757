// Holds a speed with the pedals: feedforward of the target acceleration, proportional and integral feedback of the speed error,
// and the pedal position that gives the force.
//
//     a = clamp(v_w' + k_p (v_w - v), largest acceleration) + k_i integral(v_w - v) + resistance / m
//
// The integral is frozen while a pedal is at its stop, the acceleration at its bound, or a shift interrupts the force while the
// brake is released. A dead band separates the minimum force of the power units from the onset of braking, so that the pedals
// do not chatter. If the target is a standstill and the car nearly stands, or rolls backward, the brake is held and its command
// grows as long as the car moves.
#pragma once

#include <optional>
#include <string>

#include "hamilcar/description/driver.hpp"
#include "hamilcar/driver/observation.hpp"
#include "hamilcar/math/signal.hpp"

namespace hamilcar {

// Everything that later decisions depend on.
struct SpeedMemory {
    double integral = 0;             // [m/s^2]
    bool braking = false;            // the brake is applied
    double hold = 0;                 // brake command at a standstill; 0: not holding [1]
    double interrupted = 0;          // time without drive force [s]
    double straining = 0;            // time at the limit without reaching the target [s]
    double watched_from = 0;         // speed at the start of the present two-second window [m/s]
    double watched = 0;              // time elapsed in that window [s]
    bool out_of_reach = false;       // the speed hardly rose during a window
    double wanted = 0, reached = 0;  // the missed target, and the highest speed meanwhile [m/s]
};

class SpeedControl {
public:
    SpeedControl(const SpeedControlDescription& description, const DrivenCar& car);

    // Demanded pedal positions.
    struct Pedals {
        double throttle = 0, brake = 0;  // [1]
        double drive_torque = 0;         // total of all wheels, for a car without power units [N m]
    };
    // `interrupted`: the driveline is open, so that no drive force is available.
    Pedals decide(const Observation& observation, bool interrupted, double interval, SpeedMemory& memory) const;
    // The target speed that was missed, with the speed reached.
    static std::optional<std::string> warning(const SpeedMemory& memory);

private:
    // Wheel force with the pedal released and fully pressed [N].
    struct ForceRange {
        double min, max;
    };
    ForceRange force_range(const Observation& observation) const;
    Pedals press(const ForceRange& range, double force, SpeedMemory& memory) const;
    // Whether the car is held at a standstill; the brake command is then in the memory.
    bool hold(double speed, double wanted, double pressed, double interval, SpeedMemory& memory) const;
    static void watch(double speed, double wanted, bool strained, double interval, SpeedMemory& memory);

    Signal speed_;
    DrivenCar car_;
    bool may_brake_;
    double largest_acceleration_;
};

}  // namespace hamilcar
