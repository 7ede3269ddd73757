// A driver's observation of a state.
#pragma once

#include "hamilcar/block/momenta.hpp"
#include "hamilcar/driver/observation.hpp"

namespace hamilcar {

// Without allocation; evaluates the Velocity block once.
Observation observe(const Model<double>& model, const State<double>& state, const Input<double>& input);

// Initial speed of a rotor [rad/s]: that of the shaft it is coupled to; for an engine at least the idle speed.
double initial_speed(const PowerUnit<double>& unit, double gear, double clutch, double shaft);

// Sets the rotor speeds that match the present speed, gear and clutch, at a start or at a driver's first decision.
void set_rotors(const Model<double>& model, const Input<double>& input, State<double>& state);

}  // namespace hamilcar
