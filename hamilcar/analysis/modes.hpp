// Eigenmodes of a linear model, with names that engineers use.
#pragma once

#include <complex>

#include "hamilcar/analysis/linear_model.hpp"

namespace hamilcar {

struct Mode {
    std::complex<double> eigenvalue;                    // [1/s]
    double frequency;                                   // |eigenvalue| / 2 pi, of one that oscillates [Hz]; else 0
    double damping_ratio;                               // -Re / |eigenvalue|; 1 and -1 for real ones [1]
    std::string name;                                   // "heave", "rear wheel hop", "weave", ...
    std::vector<std::pair<std::string, double>> shape;  // what moves most, largest first, relative to it
};

// Of a conjugate pair the one with positive imaginary part. Oscillations first, by frequency, then the others, slowest first.
// Real modes of the tires' deflections, the wheels' spin and brake wind-up that decay fast are listed with the rest.
std::vector<Mode> modes(const LinearModel& model, const VehicleDescription& vehicle);

}  // namespace hamilcar
