// Gears and clutch of a car with power units, as the person at the wheel wants them.
//
//     drive ────► the gear that fits (driver/shifting.hpp) ─┐
//     manual ───► the gear that is wanted ──────────────────┼─► a change of gear ─► gear, clutch, and the throttle's share
//     reverse, neutral ─────────────────────────────────────┘
//
// A change works lever, clutch and throttle as a driver would, or as an automatic gearbox does. In every gear the clutch slips by
// itself where the engine would stall; a foot on its pedal opens it farther. Ahead and back go in at a standstill alone: until
// then the lever stays in neutral.
#pragma once

#include "hamilcar/driver/shifting.hpp"
#include "hamilcar/live/controls.hpp"

namespace hamilcar::live {

class GearLever {
public:
    // `shaft_ratio`: turns of the first power unit's gearbox per turn of the driven wheels, in first gear [1].
    GearLever(const DrivenCar& car, double shaft_ratio, double step);

    // Decides for the coming `steps`. `throttle`: pedal. The first decision is carried out at once.
    void look(const Controls& held, double throttle, const Senses& senses, int steps);

    // For one step: -1 reverse, 0 neutral, 1 ...; both pedals as the car is to feel them [1].
    struct Position {
        double gear = 0, clutch = 0, throttle = 0;
    };
    Position next(double clutch, double throttle);
    void let_go() { now_ = {}; }

private:
    int wanted_gear(const Controls& held, const Senses& senses, double throttle) const;
    int fitting_gear(const Senses& senses, double throttle) const;
    void change_to(int gear);

    DrivenCar car_;
    double shaft_ratio_, step_;    // [1], [s]
    Shifting choosing_, keeping_;  // gears by itself, or those it is told

    struct Now {
        bool begun = false;
        ShiftMemory memory{.phase = ShiftMemory::Phase::driving};
        Shifting::Decision decision;
        int steps_left = 0;  // of the interval that was decided on
        Position at;         // clutch without the foot on its pedal
    };
    Now now_;
};

}  // namespace hamilcar::live
