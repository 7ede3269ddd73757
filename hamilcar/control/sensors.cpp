#include "hamilcar/control/sensors.hpp"

#include <algorithm>
#include <cmath>

namespace hamilcar {

namespace {

// SplitMix64 (Steele, Lea and Flood 2014): mixes a counter into an even distribution.
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
}

// Mean 0, standard deviation 1.
double noise(std::uint64_t seed, std::uint64_t sensor, std::uint64_t sample) {
    constexpr int terms = 12;
    double sum = -0.5 * terms;
    std::uint64_t state = mixed(mixed(mixed(seed) ^ sensor) ^ sample);
    for (int i = 0; i < terms; ++i) {
        state = mixed(state);
        sum += static_cast<double>(state >> 11) * 0x1p-53;
    }
    return sum;
}

}  // namespace

Sensors::Sensors(const std::vector<Group>& groups, std::uint64_t seed, double step) : seed_(seed) {
    for (const Group& group : groups) {
        const SensorDescription& sensor = group.sensor;
        Channels one{.group = group, .interval = 1, .delay = 0, .memory = memory_, .shows_all = false};
        if (sensor.interval > 0) one.interval = std::max(1L, std::lround(sensor.interval / step));
        constexpr double rounding = 1e-9;  // of a delay that is a whole number of intervals
        one.delay =
            static_cast<std::size_t>(std::ceil(sensor.delay / (static_cast<double>(one.interval) * step) - rounding));
        const bool samples = one.interval > 1 || one.delay > 0;
        one.shows_all = !samples && sensor.noise == 0 && sensor.resolution == 0;
        looks_always_ = looks_always_ || samples;
        size_ = std::max(size_, group.first + group.count);
        memory_ += group.count * (one.delay + 1);
        channels_.push_back(one);
    }
}

double Sensors::shown_value(const Channels& channels, std::size_t number, double sample, long sample_number) const {
    const SensorDescription& sensor = channels.group.sensor;
    if (sensor.noise > 0) {
        sample += sensor.noise * noise(seed_, channels.group.first + number, static_cast<std::uint64_t>(sample_number));
    }
    return sensor.resolution > 0 ? sensor.resolution * std::round(sample / sensor.resolution) : sample;
}

void Sensors::look(long step, std::span<const double> measured, std::span<double> memory,
                   std::span<double> shown) const {
    for (const Channels& one : channels_) {
        if (one.shows_all) {
            std::ranges::copy(measured.subspan(one.group.first, one.group.count), &shown[one.group.first]);
            continue;
        }
        const long sample = step / one.interval, ring = static_cast<long>(one.delay) + 1;
        for (std::size_t i = 0; i < one.group.count; ++i) {
            double* samples = &memory[one.memory + i * static_cast<std::size_t>(ring)];
            const double now = measured[one.group.first + i];
            if (step == 0) std::fill_n(samples, ring, now);  // as if it had always been so
            if (step % one.interval == 0) samples[sample % ring] = now;
            const long old = std::max(0L, sample - static_cast<long>(one.delay));
            shown[one.group.first + i] = shown_value(one, i, samples[old % ring], old);
        }
    }
}

}  // namespace hamilcar
