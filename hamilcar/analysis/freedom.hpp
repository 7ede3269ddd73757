// Counting: bodies, joints, cut constraints, coordinates and degrees of freedom of a car, and the paper's Table 2.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/vehicle/vehicle.hpp"

namespace hamilcar {

struct SuspensionStructure {
    std::string name;
    std::string suspension;                 // keyword
    std::vector<std::string> joints, cuts;  // with their kinds
    std::vector<std::string> independent, dependent;
    int cut_equations = 0;
};

struct Structure {
    std::vector<SuspensionStructure> suspensions;
    int bodies = 1;       // chassis and carriers; wheels only spin
    int coordinates = 6;  // Z, V, W
    int cut_equations = 0;
    int degrees_of_freedom = 6;  // Z and V: the size of P_a
    int hitch_freedoms = 0;      // among them, of trailers
    int wheel_spins = 0;         // on top, one momentum each
};

Structure structure(const Vehicle<double>& vehicle, const VehicleDescription& description);

// One row of the paper's Table 2: constraints removed by a joint, with Euler parameters for the bodies.
struct ConstraintRow {
    std::string what;
    int constraints;
};
// The paper's own way of counting, for a car of struts and trailing arms: seven coordinates a body, minus what each
// joint takes. `with_driver` adds the steering driver, which the paper counts although its coordinate q17 is not.
std::vector<ConstraintRow> paper_table_2(const Structure& structure, bool with_driver);

}  // namespace hamilcar
