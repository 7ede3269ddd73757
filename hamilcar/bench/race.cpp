#include "hamilcar/bench/race.hpp"

#include <algorithm>
#include <chrono>

namespace hamilcar {

namespace {

double seconds_for(const Contestant& contestant, long times) {
    const auto began = std::chrono::steady_clock::now();
    contestant.run(times);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

// How often a contestant fits into a turn.
long times_in(double turn, const Contestant& contestant) {
    long times = 1;
    double taken = seconds_for(contestant, times);
    while (taken < 0.1 * turn && times < (1L << 40)) {
        times *= 4;
        taken = seconds_for(contestant, times);
    }
    return std::max(1L, static_cast<long>(static_cast<double>(times) * turn / std::max(taken, 1e-9)));
}

}  // namespace

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double RaceResult::time(std::size_t contestant) const {
    return median(times_[contestant]);
}

double RaceResult::ratio(std::size_t slow, std::size_t fast) const {
    std::vector<double> ratios;
    for (std::size_t round = 0; round < times_[slow].size(); ++round) {
        ratios.push_back(times_[slow][round] / times_[fast][round]);
    }
    return median(std::move(ratios));
}

RaceResult race(const std::vector<Contestant>& contestants, double turn, int rounds) {
    std::vector<long> times;
    for (const Contestant& contestant : contestants) times.push_back(times_in(turn, contestant));
    std::vector<std::vector<double>> taken(contestants.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < contestants.size(); ++i) {
            taken[i].push_back(seconds_for(contestants[i], times[i]) / static_cast<double>(times[i]));
        }
    }
    return RaceResult(std::move(taken));
}

}  // namespace hamilcar
