// What sensors show of what is measured: sampled, late, rounded and with noise, as the vehicle file says.
//
// A sensor samples every `interval` and shows each sample `delay` later, which is rounded up to whole intervals. Noise is a sum of twelve
// evenly distributed numbers (Irwin and Hall), a function of the seed, the sensor and the sample's number: the same bits everywhere,
// and no memory.
#pragma once

#include <span>
#include <vector>

#include "hamilcar/description/control.hpp"

namespace hamilcar {

class Sensors {
public:
    // A group of neighboring numbers that sensors of one sort read.
    struct Group {
        SensorDescription sensor;
        std::size_t first, count;
    };
    // `step` in seconds; intervals are multiples of it.
    Sensors(const std::vector<Group>& groups, std::uint64_t seed, double step);

    // Numbers that are measured, and those that it remembers.
    std::size_t size() const { return size_; }
    std::size_t memory_size() const { return memory_; }
    // Whether it has to look at every step; otherwise at decisions alone.
    bool looks_always() const { return looks_always_; }
    // At a step's number: takes what is measured, and writes what is shown. Without allocation.
    void look(long step, std::span<const double> measured, std::span<double> memory, std::span<double> shown) const;

private:
    struct Channels {
        Group group;
        long interval;       // [steps]
        std::size_t delay;   // [samples]
        std::size_t memory;  // where its ring of samples begins: `delay` + 1 of each number
        bool shows_all;      // it samples every step, and shows that at once as it is
    };
    double shown_value(const Channels& channels, std::size_t number, double sample, long sample_number) const;

    std::vector<Channels> channels_;
    std::uint64_t seed_;
    std::size_t size_ = 0, memory_ = 0;
    bool looks_always_ = false;
};

}  // namespace hamilcar
