#include "hamilcar/bench/step_jitter.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

#include "hamilcar/bench/interleave.hpp"

namespace hamilcar {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t block = 1000;  // steps
constexpr int replays = 4;

double seconds(Clock::duration d) {
    return std::chrono::duration<double>(d).count();
}

// Times a block of steps, one by one.
void time_block(Simulation& simulation, float* times) {
    auto before = Clock::now();
    for (std::size_t i = 0; i < block; ++i) {
        simulation.advance();
        const auto now = Clock::now();
        times[i] = static_cast<float>(seconds(now - before));
        before = now;
    }
}

double quantile(std::vector<float>& times, double share) {
    const auto place = times.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(times.size() - 1));
    std::nth_element(times.begin(), place, times.end());
    return static_cast<double>(*place);
}

// Reads the clock until that long has passed, again and again.
std::vector<float> idle_times(std::size_t count, double duration) {
    std::vector<float> times(count);
    auto before = Clock::now();
    for (float& time : times) {
        auto now = before;
        while (seconds(now - before) < duration) now = Clock::now();
        time = static_cast<float>(seconds(now - before));
        before = now;
    }
    return times;
}

double time_of_a_reading() {
    std::vector<double> readings(1001);
    auto before = Clock::now();
    for (double& reading : readings) {
        const auto now = Clock::now();
        reading = seconds(now - before);
        before = now;
    }
    return median(std::move(readings));
}

}  // namespace

StepJitter step_jitter(Simulation& simulation, long steps) {
    const std::size_t blocks = std::max<std::size_t>(1, static_cast<std::size_t>(steps) / block);
    std::vector<float> first(blocks * block), best(blocks * block), again(block);
    Snapshot start;
    for (std::size_t b = 0; b < blocks; ++b) {
        float* own = best.data() + b * block;
        simulation.save(start);
        time_block(simulation, own);
        std::copy_n(own, block, first.data() + b * block);
        for (int i = 1; i < replays; ++i) {
            simulation.restore(start);
            time_block(simulation, again.data());
            for (std::size_t k = 0; k < block; ++k) own[k] = std::min(own[k], again[k]);
        }
    }
    const double middle = quantile(first, 0.5);
    std::vector<float> nothing = idle_times(first.size(), middle);
    return {.median = middle,
            .late = quantile(first, 0.9999),
            .late_alone = quantile(best, 0.9999),
            .late_idle = quantile(nothing, 0.9999),
            .clock = time_of_a_reading()};
}

}  // namespace hamilcar
