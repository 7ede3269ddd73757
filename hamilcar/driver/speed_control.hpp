// Holds a speed with the pedals: wanted acceleration ahead of time, a proportional and an integral answer to the speed that is
// missing, and the pedal that gives the force.
//
//     a = clamp(v_w' + k_p (v_w - v), largest acceleration) + k_i integral(v_w - v) + resistance / m
//
// The integral stands still while a pedal is at its stop, the acceleration at its bound, or a shift interrupts the force and
// the foot is not on the brake. Between the least that the power units push and the first touch of the brake lies a dead band,
// so that the feet do not fight. Who is to stand and nearly does, or rolls backward, holds the brake, and presses it harder as
// long as the car moves.
#pragma once

#include <optional>
#include <string>

#include "hamilcar/description/driver.hpp"
#include "hamilcar/driver/senses.hpp"
#include "hamilcar/math/signal.hpp"

namespace hamilcar {

// All that later decisions depend on.
struct SpeedMemory {
    double integral = 0;             // [m/s^2]
    bool braking = false;            // the foot is on the brake
    double hold = 0;                 // that keeps the car where it is; 0: it is driven [1]
    double interrupted = 0;          // for how long no force was to be had [s]
    double straining = 0;            // for how long all that there is has not sufficed [s]
    double watched_from = 0;         // speed at the start of the present two seconds of it [m/s]
    double watched = 0;              // how much of them is over [s]
    bool out_of_reach = false;       // it did not help: the speed hardly rose
    double wanted = 0, reached = 0;  // what is missed, and the highest speed meanwhile [m/s]
};

class SpeedControl {
public:
    SpeedControl(const SpeedControlDescription& description, const DrivenCar& car);

    // What the feet want to do.
    struct Pedals {
        double throttle = 0, brake = 0;  // [1]
        double drive_torque = 0;         // at all wheels together, of a car without power units [N m]
    };
    // `interrupted`: the driveline is open, and force is not to be had.
    Pedals decide(const Senses& senses, bool interrupted, double interval, SpeedMemory& memory) const;
    // What was out of reach, with what was reached.
    static std::optional<std::string> complaint(const SpeedMemory& memory);

private:
    // Wheel force with the pedal released and pressed [N].
    struct Reach {
        double least, most;
    };
    Reach reach(const Senses& senses) const;
    Pedals press(const Reach& reach, double force, SpeedMemory& memory) const;
    // Whether the car is to stay where it is; the brake's command is then in the memory.
    bool hold(double speed, double wanted, double pressed, double interval, SpeedMemory& memory) const;
    static void watch(double speed, double wanted, bool strained, double interval, SpeedMemory& memory);

    Signal speed_;
    DrivenCar car_;
    bool may_brake_;
    double largest_acceleration_;
};

}  // namespace hamilcar
