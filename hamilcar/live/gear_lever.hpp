// Gear and clutch actuation of a car with power units, according to the user's selector, gear and pedals.
//
//     drive ────► a suitable gear (driver/shifting.hpp) ────┐
//     manual ───► the requested gear ───────────────────────┼─► a change of gear ─► gear, clutch, and the throttle's share
//     reverse, neutral ─────────────────────────────────────┘
//
// A gear change operates lever, clutch and throttle as a driver would, or as an automatic gearbox does. In every gear the clutch
// slips automatically where the engine would stall; the pedal opens it farther. The direction changes only near standstill: until
// then the gearbox stays in neutral.
#pragma once

#include "hamilcar/driver/shifting.hpp"
#include "hamilcar/live/controls.hpp"

namespace hamilcar::live {

class GearLever {
public:
    // `shaft_ratio`: turns of the first power unit's gearbox per turn of the driven wheels, in first gear [1].
    GearLever(const DrivenCar& car, double shaft_ratio, double step);

    // Decides for the coming `steps`. `throttle`: pedal. The first decision takes effect at once.
    void decide(const Controls& controls, double throttle, const Observation& observation, int steps);

    // For one step: -1 reverse, 0 neutral, 1 ...; both pedals as applied to the car [1].
    struct Position {
        double gear = 0, clutch = 0, throttle = 0;
    };
    Position next(double clutch, double throttle);
    void reset() { now_ = {}; }

private:
    int wanted_gear(const Controls& controls, const Observation& observation, double throttle) const;
    int suitable_gear(const Observation& observation, double throttle) const;
    void change_to(int gear);

    DrivenCar car_;
    double shaft_ratio_, step_;    // [1], [s]
    Shifting automatic_, manual_;  // chooses gears, or engages the requested one

    struct Now {
        bool begun = false;
        ShiftMemory memory{.phase = ShiftMemory::Phase::driving};
        Shifting::Decision decision;
        int steps_left = 0;  // of the decision interval
        Position at;         // clutch without the user's pedal
    };
    Now now_;
};

}  // namespace hamilcar::live
