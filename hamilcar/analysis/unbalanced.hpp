// What the applied forces leave of the rates of momentum of a suspension: by d'Alembert's principle what its joints and its rack
// give. Along any motion xi of its frames against the chassis, joints held or not,
//     F = sum xi.(h' + v_chassis x* h - Qhat) - sum F_axial dl                              // h' as seen from the chassis
// with Qhat as in (71) and dl the change of the lines that springs, dampers, stops and bars act along.
#pragma once

#include "hamilcar/block/momenta.hpp"

namespace hamilcar {

// One instant with its neighbors on both sides: h' is a difference along the state's own path, with an error of some 1e-7 N. Two
// Velocity blocks; refers to its arguments. `momenta` with a full account.
class Unbalanced {
public:
    Unbalanced(const Model<double>& model, const State<double>& state, const Input<double>& input,
               const Velocity<double>& velocity, const Momenta<double>& momenta);

    // Of a suspension along the motions in `moved`, whose frames stand as the state says: own.x about the anchor, motion.x about
    // the chassis origin, and X, the rates of the coordinates [N, or N m].
    double along(std::size_t suspension, const LinkagePosition<double>& moved) const;

    // A suspension's linkage where the state says, moved by the rack at such a rate [m/s].
    LinkagePosition<double> position(std::size_t suspension, double rack_rate) const;

    const Vehicle<double>& vehicle() const { return vehicle_; }

private:
    // What a chassis lends its suspensions.
    struct ChassisMotion {
        Vec3<double> gravity;    // [m/s^2]
        Spatial<double> motion;  // v_chassis
    };
    ChassisMotion chassis_of(int unit) const;
    double of_bodies(std::size_t s, const LinkagePosition<double>& moved, const ChassisMotion& chassis) const;
    double of_wheel(std::size_t s, std::size_t i, const LinkagePosition<double>& moved,
                    const ChassisMotion& chassis) const;
    double of_shaft(std::size_t s, const LinkagePosition<double>& moved) const;
    // h' + v_chassis x* h
    template <class Momentum>
    Spatial<double> rate_of(const ChassisMotion& chassis, const Momentum& momentum) const;

    const Vehicle<double>& vehicle_;
    const State<double>& state_;
    double rack_;  // [m]
    const Velocity<double>& velocity_;
    const Momenta<double>& momenta_;
    Velocity<double> before_, after_;
};

}  // namespace hamilcar
