// Welch's spectrum, its bands and the class of a road.
#include "hamilcar/road/road_spectrum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "hamilcar/math/fourier.hpp"

namespace hamilcar {
namespace {

// A line of the spectrum covers half a resolution on either side; a band takes its overlap.
double mean_density(const Spectrum& spectrum, double low, double high) {
    double sum = 0;
    const double first = std::max(0.0, std::floor(low / spectrum.resolution - 0.5));
    for (auto k = static_cast<std::size_t>(first); k < spectrum.density.size(); ++k) {
        const double left = (static_cast<double>(k) - 0.5) * spectrum.resolution;
        if (left >= high) break;
        sum += spectrum.density[k] * std::max(0.0, std::min(high, left + spectrum.resolution) - std::max(low, left));
    }
    return sum / (high - low);
}

// Bands of 1/`per_octave` octave from 2^low to 2^high, as far as the spectrum extends.
void add_bands(const Spectrum& spectrum, int per_octave, double low, double high, std::vector<Band>& bands) {
    const double end = (static_cast<double>(spectrum.density.size()) - 0.5) * spectrum.resolution;
    const double shift = per_octave % 2 == 0 ? 0 : 0.5, rounding = 1e-9;  // of limits that are meant to coincide
    const int last = static_cast<int>(std::floor(high * per_octave + shift + rounding));
    for (int i = static_cast<int>(std::ceil(low * per_octave + shift - rounding)); i < last; ++i) {
        const double from = std::exp2((i - shift) / per_octave), to = std::exp2((i + 1 - shift) / per_octave);
        if (to > end) return;
        bands.push_back({from, to, mean_density(spectrum, from, to)});
    }
}

}  // namespace

double class_roughness(char road_class) {
    if (road_class < 'A' || road_class > 'H') throw std::invalid_argument("a road class is a letter from A to H");
    return std::ldexp(16e-6, 2 * (road_class - 'A'));
}

char class_of(double roughness) {
    char road_class = 'A';
    while (road_class < 'H' && roughness >= 2 * class_roughness(road_class)) ++road_class;
    return road_class;
}

double Band::center() const {
    return std::sqrt(low * high);
}

Spectrum spectrum(const std::vector<double>& profile, double spacing, std::size_t segment) {
    if (!std::has_single_bit(segment) || segment < 4 || segment > profile.size())
        throw std::length_error("the segment length must be a power of two, from 4 to the length of the profile");
    const std::vector<double> window = hann_window(segment);
    double squares = 0;
    for (const double share : window) squares += share * share;
    Spectrum out{1 / (spacing * static_cast<double>(segment)), std::vector<double>(segment / 2 + 1)};
    const std::size_t count = (profile.size() - segment) / (segment / 4) + 1;
    for (std::size_t i = 0; i < count; ++i) {
        const auto values = transformed(std::span(profile).subspan(i * (segment / 4), segment), window);
        for (std::size_t k = 0; k <= segment / 2; ++k) out.density[k] += std::norm(values[k]);
    }
    for (double& density : out.density) density *= 2 * spacing / (squares * static_cast<double>(count));
    out.density.front() /= 2;  // neither has a partner at a negative frequency
    out.density.back() /= 2;
    return out;
}

std::vector<Band> smoothed(const Spectrum& spectrum, int per_octave, double low, double high) {
    std::vector<Band> bands;
    add_bands(spectrum, per_octave, std::log2(low), std::log2(high), bands);
    return bands;
}

std::vector<Band> smoothed(const Spectrum& spectrum) {
    const double octaves = -4.5, thirds = -11.0 / 6, highest = 1.5;  // upper limits, powers of two
    std::vector<Band> bands;
    add_bands(spectrum, 1, -6.5, octaves, bands);
    add_bands(spectrum, 3, octaves, thirds, bands);
    add_bands(spectrum, 12, thirds, highest, bands);
    const double resolved =
        2 * spectrum.resolution;  // lower bands are contaminated by mean and trend through the window
    std::erase_if(bands, [&](const Band& band) { return band.low < resolved; });
    return bands;
}

Roughness fitted(const std::vector<Band>& bands) {
    double count = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const Band& band : bands) {
        if (!(band.density > 0)) continue;
        const double u = std::log(band.center() / reference_frequency), v = std::log(band.density);
        ++count, x += u, y += v, xx += u * u, xy += u * v;
    }
    if (count < 2) throw std::invalid_argument("classifying a profile requires at least two bands with roughness");
    const double slope = (count * xy - x * y) / (count * xx - x * x);
    return {std::exp((y - slope * x) / count), -slope};
}

char classify(const std::vector<double>& profile, double spacing) {
    // Long segments resolve low frequencies, many segments reduce the variance: twice the longest relevant wave is enough.
    const double enough = 2 / (spacing * lowest_frequency);
    const std::size_t longest = std::bit_floor(profile.size() / 2);
    const std::size_t segment = std::min(longest, std::bit_ceil(static_cast<std::size_t>(enough)));
    return class_of(fitted(smoothed(spectrum(profile, spacing, segment))).at_reference);
}

}  // namespace hamilcar
