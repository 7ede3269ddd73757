// Reads an axle: its suspension by one of the recipes, or joint by joint.
#pragma once

#include "hamilcar/io/wheel_file.hpp"
#include "hamilcar/suspension/recipe.hpp"

namespace hamilcar::io {

// Adds the axle's suspensions, one with two wheels or one on each side, to the vehicle; `unit` is what they hang on.
void read_axle(const TableReader& axle, const NamedTires& tires, std::size_t unit, VehicleDescription& vehicle);

// Tells a recorder what keys mean, in a suspension or everywhere.
void note_meanings(const TableReader& table, const std::vector<HardpointKey>& keys, std::string_view suspension = {});

// All words that `suspension` may be.
std::vector<std::string_view> suspension_keywords();

}  // namespace hamilcar::io
