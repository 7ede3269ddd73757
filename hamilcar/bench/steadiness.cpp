#include "hamilcar/bench/steadiness.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

#include "hamilcar/bench/race.hpp"

namespace hamilcar {

Steadiness steadiness(Simulation& simulation, long steps) {
    using Clock = std::chrono::steady_clock;
    const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
    std::vector<float> times(static_cast<std::size_t>(steps));  // written once before, so that no page is new
    auto before = Clock::now();
    for (float& time : times) {
        simulation.advance();
        const auto now = Clock::now();
        time = static_cast<float>(seconds(now - before));
        before = now;
    }
    std::vector<double> readings(1001);
    for (double& reading : readings) {
        const auto now = Clock::now();
        reading = seconds(now - before);
        before = now;
    }
    const auto at = [&](double share) {
        const auto place = times.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(times.size() - 1));
        std::nth_element(times.begin(), place, times.end());
        return static_cast<double>(*place);
    };
    return {.median = at(0.5), .late = at(0.9999), .clock = median(readings)};
}

}  // namespace hamilcar
