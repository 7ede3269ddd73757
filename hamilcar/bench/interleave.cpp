#include "hamilcar/bench/interleave.hpp"

#include <algorithm>
#include <chrono>

namespace hamilcar {

namespace {

double seconds_for(const BenchmarkCase& one, long times) {
    const auto began = std::chrono::steady_clock::now();
    one.run(times);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

// How often a case fits into a turn.
long times_in(double turn, const BenchmarkCase& one) {
    long times = 1;
    double taken = seconds_for(one, times);
    while (taken < 0.1 * turn && times < (1L << 40)) {
        times *= 4;
        taken = seconds_for(one, times);
    }
    return std::max(1L, static_cast<long>(static_cast<double>(times) * turn / std::max(taken, 1e-9)));
}

}  // namespace

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double InterleavedTimes::time(std::size_t case_index) const {
    return median(times_[case_index]);
}

double InterleavedTimes::ratio(std::size_t slow, std::size_t fast) const {
    std::vector<double> ratios;
    for (std::size_t round = 0; round < times_[slow].size(); ++round) {
        ratios.push_back(times_[slow][round] / times_[fast][round]);
    }
    return median(std::move(ratios));
}

InterleavedTimes interleave(const std::vector<BenchmarkCase>& cases, double turn, int rounds) {
    std::vector<long> times;
    for (const BenchmarkCase& one : cases) times.push_back(times_in(turn, one));
    std::vector<std::vector<double>> taken(cases.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < cases.size(); ++i) {
            taken[i].push_back(seconds_for(cases[i], times[i]) / static_cast<double>(times[i]));
        }
    }
    return InterleavedTimes(std::move(taken));
}

}  // namespace hamilcar
