// A sine along the road, of constant or swept frequency, with the right track lagging the left one, for ride tests. The
// spatial frequency of a sweep is linear in x, so its phase is quadratic.
#pragma once

#include "hamilcar/road/obstacle.hpp"

namespace hamilcar {

struct Wave {
    static constexpr double blend = 0.5;    // the lag grows from zero at y = blend to its full value at -blend [m]
    double start = 0, length = everywhere;  // [m]
    double amplitude = 0;                   // [m]
    double first = 1, last = 1;             // wavelengths, over which it fades in and out [m]
    double chirp = 0;                       // half the change of the spatial frequency along x [1/m^2]
    double lag = 0;                         // of the right track [rad]

    Wave() = default;
    explicit Wave(const WaveDescription& d)
        : start(d.start), amplitude(d.amplitude), first(d.wavelength), last(d.wavelength), lag(d.right_phase) {
        if (d.length <= 0) return;
        length = d.length;
        if (d.last_wavelength > 0) last = d.last_wavelength;
        chirp = (1 / last - 1 / first) / (2 * length);
    }

    template <class N>
    N height(const N& x, const N& y) const {
        const N s = x - N(start);
        if (!(value_of(s) > 0 && value_of(s) < length)) return N(0);
        N phase = N(2 * std::numbers::pi) * s * (N(1 / first) + N(chirp) * s);
        if (lag != 0) phase -= N(lag) * smooth_step(N((N(blend) - y) * N(0.5 / blend)));
        N fade = smooth_step(N(s * N(1 / first)));
        // Not for an endless wave: infinities would raise floating-point flags.
        if (length - value_of(s) < last) fade *= smooth_step(N((N(length) - s) * N(1 / last)));
        return N(amplitude) * fade * sincos(phase).sine;
    }
    double max_height() const { return std::abs(amplitude); }  // [m]
};

}  // namespace hamilcar
