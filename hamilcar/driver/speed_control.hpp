// Holds a speed with the pedals: wanted acceleration ahead of time, a proportional and an integral answer to the speed that is
// missing, and the pedal that gives the force.
//
//     a = clamp(v_w' + k_p (v_w - v), largest acceleration) + k_i integral(v_w - v) + resistance / m
//
// The integral stands still while a pedal is at its stop, the acceleration at its bound, or a shift interrupts the force. Between
// the least that the power units push and the first touch of the brake lies a dead band, so that the feet do not fight.
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
    double straining = 0;            // for how long all that there is has not sufficed [s]
    double watched_from = 0;         // speed at the start of the present two seconds of it [m/s]
    double watched = 0;              // how much of them is over [s]
    bool out_of_reach = false;       // it did not help: the speed hardly rose
    double wanted = 0, reached = 0;  // when that was found, or now [m/s]
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
    Pedals press(const Senses& senses, double force, SpeedMemory& memory) const;
    static void watch(double speed, double wanted, bool strained, double interval, SpeedMemory& memory);

    Signal speed_;
    DrivenCar car_;
    bool may_brake_;
    double largest_acceleration_;
};

}  // namespace hamilcar
