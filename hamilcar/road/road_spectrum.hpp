// Roughness of a profile by ISO 8608: its one-sided displacement spectrum, smoothed in bands, the straight line fitted to it
// in logarithms, and the class letter. Spatial frequencies n in cycles per meter, spectra G_d in m^3.
//
// Welch's method: segments that overlap by three quarters, each detrended, with a Hann window. At that overlap the squared
// windows add up to a constant, so that every part of the profile has the same weight except near its ends.
#pragma once

#include <cstddef>
#include <vector>

namespace hamilcar {

// From ISO 8608: G_d(n) = G_d(n0) (n/n0)^-2, the geometric mean of a class four times that of the one before it,
// its limits half and double; lines are fitted over n from 2^-6.5 to 2^1.5.
inline constexpr double reference_frequency = 0.1;                           // n0 [1/m]
inline constexpr double lowest_frequency = 0.011, highest_frequency = 2.83;  // [1/m]

// G_d(n0) of a class, 'A' to 'H': the geometric mean of its limits [m^3].
double class_roughness(char road_class);
// The class whose limits contain G_d(n0); 'A' for anything smoother, 'H' for anything rougher.
char class_of(double roughness);

struct Spectrum {
    double resolution = 0;        // [1/m]
    std::vector<double> density;  // at multiples of the resolution, from 0 on [m^3]
};
// Of a profile sampled every `spacing` [m], in segments of `segment` samples, which is a power of two.
Spectrum spectrum(const std::vector<double>& profile, double spacing, std::size_t segment);

// A band of the smoothed spectrum: the mean density between its limits.
struct Band {
    double low, high;  // [1/m]
    double density;    // [m^3]
    double center() const;
};
// All bands of 1/`per_octave` octave within the limits. For an odd number 1 cycle per meter is the center of a band, for an even
// one a limit, so that twelfths subdivide thirds.
std::vector<Band> smoothed(const Spectrum& spectrum, int per_octave, double low, double high);
// As in the standard: octaves up to the center 2^-5, third octaves to 2^-2, then twelfths. Bands that the segments are too short
// to resolve are omitted.
std::vector<Band> smoothed(const Spectrum& spectrum);

struct Roughness {
    double at_reference;  // G_d(n0) [m^3]
    double waviness;      // w of G_d(n) = G_d(n0) (n/n0)^-w; 2 in all classes
};
// Least squares of the logarithms.
Roughness fitted(const std::vector<Band>& bands);

// The class of a profile sampled every `spacing` [m]: at most 0.17, over 400 or better 1000 m.
char classify(const std::vector<double>& profile, double spacing);

}  // namespace hamilcar
