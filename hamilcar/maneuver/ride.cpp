#include "hamilcar/maneuver/ride.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/ride_weighting.hpp"

namespace hamilcar::ride {

std::span<const double> within(const Series& series, double from, double to) {
    const std::size_t first = sample_at(series, from), last = sample_at(series, to);
    return series.values.subspan(first, std::max(last, first + 1) - first);
}

Comfort felt(const Recording& recording, double from, double to) {
    // Filtered from the start, so that the filters are in motion at `from`.
    const auto weighted = [&](RideWeighting weighting, const char* channel) {
        const Series raw = recording[channel];
        const std::vector<double> all = ride_weighted(weighting, raw.values, raw.rate);
        const auto part = within({all, raw.rate, raw.start}, from, to);
        return std::vector<double>(part.begin(), part.end());
    };
    const std::vector<double> x = weighted(RideWeighting::horizontal, channel::seat_x),
                              y = weighted(RideWeighting::horizontal, channel::seat_y),
                              z = weighted(RideWeighting::vertical, channel::seat_z);
    Comfort out{.x = root_mean_square(x), .y = root_mean_square(y), .z = root_mean_square(z)};
    out.total = comfort_total(out.x, out.y, out.z);
    out.crest_z = crest_factor(z);
    out.running_z = largest_running_rms(z, recording.rate());
    out.dose_z = vibration_dose(z, recording.rate());
    return out;
}

void add_figures(TestRun& test, const Comfort& comfort) {
    test.figure("a_wx", "m/s^2", comfort.x, "r.m.s. on the seat along x, weighted with Wd");
    test.figure("a_wy", "m/s^2", comfort.y, "likewise along y");
    test.figure("a_wz", "m/s^2", comfort.z, "likewise along z, weighted with Wk");
    test.figure("a_v", "m/s^2", comfort.total, "total value, the vector sum of the three");
    test.figure("crest factor along z", "", comfort.crest_z, "largest weighted value over its r.m.s.");
    test.figure("MTVV along z", "m/s^2", comfort.running_z, "largest weighted r.m.s. over a second");
    test.figure("VDV along z", "m/s^1.75", comfort.dose_z, "fourth root of the integral of the fourth power");
}

Loads loads(const Recording& recording, const Axle& axle, double from, double to) {
    Loads worst{0, -1, 0, 0};
    for (const std::string& wheel : axle.wheels) {
        const auto load = within(recording[channel::wheel_load(wheel)], from, to);
        const double average = mean(load), deviation = root_mean_square(shifted(load, -average));
        if (deviation > worst.deviation) worst = {average, deviation, std::ranges::min(load), std::ranges::max(load)};
    }
    return worst;
}

}  // namespace hamilcar::ride
