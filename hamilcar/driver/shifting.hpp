// Gears and clutch of the first power unit, as a driver works a manual gearbox, or as an automatic one works itself.
//
// Manual: while the gearbox turns slower than the engine may, the clutch slips, engaged the more the faster the rotor turns; by
// that the engine neither stalls nor races, whatever the clutch holds. To change gear the foot leaves the throttle, presses the
// clutch, moves the lever, matches the rotor's speed and releases, all within the gearbox's shift time. Automatic: the
// gear goes evenly from the old number to the new one, and the core goes from ratio to ratio.
//
// A gear is left at speeds of the rotor between those for the closed and the open throttle. None is taken that would be left
// again at once: the downshift of a gear lies below where the upshift into it lands.
#pragma once

#include "hamilcar/description/driver.hpp"
#include "hamilcar/driver/senses.hpp"

namespace hamilcar {

// All that later decisions depend on.
struct ShiftMemory {
    enum class Phase { unbegun, driving, launching, changing };
    Phase phase = Phase::unbegun;
    int gear = 0, next = 0;  // that is in; that is coming while changing
    double clock = 0;        // since the change began, or since it ended [s]
    double throttle = 0;     // smoothed, that shift points go by [1]
};

class Shifting {
public:
    // Throws std::invalid_argument for a gear that does not exist.
    Shifting(const ShiftingDescription& description, const DrivenCar& car);

    bool acts() const { return car_.gears > 0; }
    bool works_clutch() const { return acts() && car_.has_clutch; }
    // Whether it takes the throttle away at times.
    bool cuts_throttle() const { return acts() && !fixed_ && !ramps_; }

    // Whether the driveline is open or slips, so that force is not to be had.
    bool interrupts(const ShiftMemory& memory) const {
        const bool lever = memory.phase == ShiftMemory::Phase::changing && !ramps_;
        return works_clutch() && (lever || memory.phase == ShiftMemory::Phase::launching);
    }

    // For the coming interval, at its end.
    struct Decision {
        double gear = 0;  // steps to it at once, unless it goes evenly
        bool evenly = false;
        double clutch = 0;          // pedal [1]
        double throttle_share = 1;  // of what is wanted, that the foot may give [1]
        double least_throttle = 0;  // to match the rotor's speed [1]
    };
    // `throttle`: wanted now. A first decision takes the fitting gear at once; where no gear is in yet, the first one.
    Decision decide(const Senses& senses, double throttle, double interval, ShiftMemory& memory) const;

private:
    double ratio(int gear) const;
    double upshift_speed(double throttle) const;
    double downshift_speed(int gear, double throttle) const;
    double launch_clutch(double rotor, double throttle) const;
    int fitting_gear(const UnitSense& unit, double ground, const ShiftMemory& memory) const;
    int lower_gear(double shaft, double throttle, int from, int gear) const;
    void begin(const Senses& senses, double throttle, ShiftMemory& memory) const;
    void settle(const UnitSense& unit, ShiftMemory& memory) const;
    Decision change(const UnitSense& unit, double interval, ShiftMemory& memory) const;
    Decision hold(const UnitSense& unit, ShiftMemory& memory) const;

    DrivenCar car_;
    bool fixed_ = false, ramps_ = false;
    int first_ = 1;  // lowest gear that is chosen, or the fixed one
};

}  // namespace hamilcar
